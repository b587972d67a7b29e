// SPDX-License-Identifier: Apache-2.0
#include "base/math/Box.h"
#include "base/math/Frustum.h"
#include "base/math/Half.h"

#include <filament_core/Camera.h>
#include <filament_core/Color.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace filament_core {
namespace {

TEST(Half, RoundTripsEveryFiniteValue) {
    for (uint32_t bits = 0; bits < 0x10000; ++bits) {
        if ((bits & 0x7C00) == 0x7C00) continue; // infinities and NaN
        if (bits == 0x8000) continue;            // -0 keeps its sign, checked below
        ASSERT_EQ(halfFromFloat(floatFromHalf(static_cast<uint16_t>(bits))), bits);
    }
    EXPECT_EQ(halfFromFloat(-0.0f), 0x8000);
}

TEST(Half, RoundsToNearestEven) {
    EXPECT_EQ(floatFromHalf(halfFromFloat(2049.0f)), 2048.0f); // tie: even mantissa wins
    EXPECT_EQ(floatFromHalf(halfFromFloat(2051.0f)), 2052.0f);
    EXPECT_EQ(floatFromHalf(halfFromFloat(2049.1f)), 2050.0f);
}

TEST(Half, ClampsSunsInsteadOfMakingThemInfinite) {
    EXPECT_EQ(floatFromHalf(halfFromFloat(1.6e9f)), kMaxHalf);
    EXPECT_EQ(floatFromHalf(halfFromFloat(std::numeric_limits<float>::infinity())), kMaxHalf);
    EXPECT_EQ(floatFromHalf(halfFromFloat(65520.0f)), kMaxHalf);
    EXPECT_EQ(halfFromFloat(std::numeric_limits<float>::quiet_NaN()), 0);
    const float3 packed = unpackR11G11B10F(packR11G11B10F({ 1e9f, 70000.0f, 1e6f }));
    EXPECT_EQ(packed.x, kMaxFloat11);
    EXPECT_EQ(packed.y, kMaxFloat11);
    EXPECT_EQ(packed.z, kMaxFloat10);
}

TEST(PackedFloat, RoundTripsEveryFiniteValueOfEachComponent) {
    for (uint32_t bits = 0; bits < 31u << 6; ++bits) {
        ASSERT_EQ(packR11G11B10F(unpackR11G11B10F(bits)), bits);
        ASSERT_EQ(packR11G11B10F(unpackR11G11B10F(bits << 11)), bits << 11);
    }
    for (uint32_t bits = 0; bits < 31u << 5; ++bits)
        ASSERT_EQ(packR11G11B10F(unpackR11G11B10F(bits << 22)), bits << 22);
}

TEST(PackedFloat, MakesNegativesZero) { EXPECT_EQ(packR11G11B10F({ -1.0f, -1e-20f, -5.0f }), 0u); }

TEST(Exposure, MatchesTheSunny16Rule) {
    // f/16, 1/125 s, ISO 100: EV100 = log2(256 * 125) = 14.966; a white 110 000 lux sun lands at 2.86 (the talk).
    const Exposure sunny16{ 16, 1.0f / 125, 100 };
    EXPECT_NEAR(sunny16.ev100(), std::log2(32000.0f), 1e-5f);
    EXPECT_EQ(Exposure::luminance(3), 1.0f);
    EXPECT_EQ(Exposure::luminance(10), 128.0f);
    EXPECT_EQ(Exposure::illuminance(4), 40.0f);
    EXPECT_NEAR(sunny16.factor(), 2.6042e-5f, 1e-9f);
    EXPECT_NEAR(sunny16.factor() * 110'000, 2.86462f, 1e-4f);
}

TEST(Camera, PutsTheTargetInTheMiddleAndUpAtRowZero) {
    const Camera camera = Camera::lookAt({ 3, 4, 5 }, { -1, 2, 0 });
    const double4x4 viewFromWorld = glm::inverse(camera.worldFromView);
    const float4x4 clipFromView = camera.clipFromView(1.5f);
    const float4 target = clipFromView * float4(viewFromWorld * double4(-1, 2, 0, 1));
    EXPECT_NEAR(target.x / target.w, 0, 1e-6);
    EXPECT_NEAR(target.y / target.w, 0, 1e-6);
    const float4 above = clipFromView * float4(viewFromWorld * double4(-1, 2.5, 0, 1));
    EXPECT_LT(above.y / above.w, 0) << "row 0 is at y_ndc = -1";
}

TEST(Camera, ReversesDepthBetweenTheNearPlaneAndInfinity) {
    const float4x4 clip = Camera{ .lens = { 60, 0.25f } }.clipFromView(1);
    const float4 near = clip * float4(0, 0, -0.25f, 1);
    const float4 far = clip * float4(0, 0, -1e12f, 1);
    EXPECT_FLOAT_EQ(near.z / near.w, 1.0f);
    EXPECT_NEAR(far.z / far.w, 0.0f, 1e-12f);
}

TEST(Camera, LooksStraightDownWithoutFallingOver) {
    const Camera camera = Camera::lookAt({ 0, 10, 0 }, { 0, 0, 0 });
    const double3x3 rotation(camera.worldFromView);
    EXPECT_NEAR(glm::determinant(rotation), 1.0, 1e-12);
    EXPECT_NEAR(rotation[2].y, 1.0, 1e-12);
}

TEST(Camera, IsARigidFrameEvenWhenEyeAndTargetCoincide) {
    const double3x3 rotation(Camera::lookAt({ 1, 1, 1 }, { 1, 1, 1 }).worldFromView);
    EXPECT_NEAR(glm::determinant(rotation), 1.0, 1e-12);
}

Frustum testFrustum() { return frustumFromClip(Camera{ .lens = { 90, 0.1f } }.clipFromView(1)); }

TEST(Frustum, KeepsWhatIsInsideAndDropsWhatIsBehindOrBeside) {
    const Frustum frustum = testFrustum();
    const float3 half(0.1f);
    EXPECT_TRUE(intersects(frustum, { 0, 0, -5 }, half));
    EXPECT_TRUE(intersects(frustum, { 0, 0, -1e9f }, half)) << "there is no far plane";
    EXPECT_FALSE(intersects(frustum, { 0, 0, 5 }, half));
    EXPECT_FALSE(intersects(frustum, { 6, 0, -5 }, half));
    EXPECT_FALSE(intersects(frustum, { -6, 0, -5 }, half));
    EXPECT_FALSE(intersects(frustum, { 0, 6, -5 }, half));
    EXPECT_FALSE(intersects(frustum, { 0, -6, -5 }, half));
}

TEST(Frustum, KeepsABoxThatReachesInThroughAPlane) {
    const Frustum frustum = testFrustum();
    EXPECT_TRUE(intersects(frustum, { 5.05f, 0, -5 }, float3(0.1f)));
    EXPECT_TRUE(intersects(frustum, { 0, 0, 0.05f }, float3(0.2f))) << "crosses the near plane";
    EXPECT_TRUE(intersectsSphere(frustum, { 5.5f, 0, -5 }, 1.0f));
    EXPECT_FALSE(intersectsSphere(frustum, { 7.0f, 0, -5 }, 1.0f));
}

TEST(Box, GrowsToHoldARotatedBoxExactly) {
    const double c = std::cos(0.7), s = std::sin(0.7);
    const double4x4 turn(double4(c, 0, -s, 0), double4(0, 1, 0, 0), double4(s, 0, c, 0), double4(5, 6, 7, 1));
    const float3 half = transformedHalfExtent(turn, { 1, 2, 3 });
    EXPECT_NEAR(half.x, c * 1 + s * 3, 1e-6);
    EXPECT_NEAR(half.y, 2, 1e-6);
    EXPECT_NEAR(half.z, s * 1 + c * 3, 1e-6);
}

TEST(Color, ConvertsToAndFromSrgb) {
    EXPECT_NEAR(color::linearFromSrgb(float3(0.5f)).x, 0.21404f, 1e-5f);
    for (float v : { 0.0f, 0.001f, 0.0031308f, 0.02f, 0.5f, 1.0f }) {
        EXPECT_NEAR(color::linearFromSrgb(color::srgbFromLinear(float3(v))).y, v, 1e-6f);
    }
}

TEST(Color, MakesSixAndAHalfThousandKelvinWhiteAndThreeThousandWarm) {
    const float3 white = color::fromTemperature(6504);
    // A black body is a little pinker than daylight of the same temperature (D65).
    EXPECT_NEAR(white.x, 1, 0.05f);
    EXPECT_NEAR(white.y, 1, 0.03f);
    EXPECT_NEAR(white.z, 1, 0.05f);
    const float3 warm = color::fromTemperature(3000);
    EXPECT_GT(warm.x, warm.y);
    EXPECT_GT(warm.y, warm.z);
    EXPECT_NEAR(color::luminance(warm), 1, 1e-5f);
}

} // namespace
} // namespace filament_core
