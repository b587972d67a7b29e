// SPDX-License-Identifier: Apache-2.0
// Refraction as images: the same bits on both APIs, and colours that follow from the physics by simple arithmetic.
#include "tests/filament_core/engine/SkyStage.h"

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

using test::centerPixel;
using test::directionThrough;
using test::expectFurnace;
using test::expectNear;
using test::halfPixel;
using test::kDirectionSky;
using test::kNoLights;
using test::kSunOnly;
using test::kWhiteSky;
using test::MaterialStage;
using test::onBothApis;
using test::seenOnSphere;
using test::seenOnSquare;
using test::Sky;
using test::text;
using test::underSky;

constexpr std::string_view kSolid = "refractionMode : cubemap",
                           kThin = "refractionMode : cubemap, refractionType : thin";

TEST(RefractionModel, ASolidOfIndexOneShowsWhatIsBehindItAsIfItWereNotThere) {
    const Image picture =
            seenOnSphere(text(kSolid, "material.roughness = 0.7; material.reflectance = 0.0;"), kDirectionSky);
    for (uint32_t y = 8; y < 24; ++y) {
        for (uint32_t x = 8; x < 24; ++x)
            expectNear(halfPixel(picture, x, y), kDirectionSky.radiance(directionThrough(x, y, 32)), 2e-3f);
    }
}

TEST(RefractionModel, AThinLayerDoesNotBendLight) {
    const Image picture = underSky(kDirectionSky, [&](MaterialStage& stage) {
        stage.view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 });
        stage.view.size = { 32, 32 };
        stage.add(stage.material(text(kThin, "material.roughness = 0.0;"), kNoLights), { {} });
    });
    for (uint32_t at = 0; at < 32; at += 3) {
        const float4 seen = halfPixel(picture, at, 31 - at);
        const float3 straight = kDirectionSky.radiance(directionThrough(at, 31 - at, 32));
        // Reflections differ only in z, and clear glass loses nothing.
        EXPECT_NEAR(seen.x, straight.x, 3e-3f) << at;
        EXPECT_NEAR(seen.y, straight.y, 3e-3f) << at;
        EXPECT_GT(seen.z, straight.z) << at;
    }
    const float both = 2 * 0.04f / 1.04f; // both interfaces and all bounces between them
    EXPECT_NEAR(halfPixel(picture, 16, 16).z, both, 3e-3f) << "of what is behind nothing has a z";
}

TEST(RefractionModel, ABallTurnsWhatIsBehindItAround) {
    const Image picture = seenOnSphere(text(kSolid, "material.roughness = 0.0;"), kDirectionSky);
    for (const uint32_t at : { 9u, 12u, 19u, 22u }) {
        // refraction.glsl, with the sphere as the ball: in where the view meets it, out on the other side.
        const float3 origin(0, 0, 3), view = directionThrough(at, 16, 32);
        const float along = -glm::dot(origin, view);
        const float3 n = origin + view * (along - std::sqrt(along * along - 8.0f)); // |origin|^2 - 1 = 8
        const float3 inside = glm::refract(view, n, 1 / 1.5f);
        const float3 exitNormal = n + inside * (-2 * glm::dot(n, inside));
        const float3 out = glm::refract(inside, -exitNormal, 1.5f);
        EXPECT_NEAR(halfPixel(picture, at, 16).x, kDirectionSky.radiance(out).x, 0.03f) << at; // 4 % is reflected
    }
}

TEST(RefractionModel, AbsorptionFollowsBeerAndLambertWithTheThickness) {
    const auto through = [](std::string_view properties, std::string const& code) {
        const float4 seen = seenOnSquare(text(properties, "material.roughness = 0.0; " + code), kWhiteSky);
        const float4 clear = seenOnSquare(text(properties, "material.roughness = 0.0;"), kWhiteSky);
        const float4 none = seenOnSquare(
                text(properties, "material.roughness = 0.0; material.baseColor.rgb = vec3(0.0);"), kWhiteSky);
        return (float3(seen) - float3(none)) / (float3(clear) - float3(none));
    };
    const float3 absorption(0.25f, 0.5f, 1);
    const std::string absorbing = "material.absorption = vec3(0.25, 0.5, 1.0);";
    for (const float thickness : { 0.5f, 1.0f, 2.0f }) {
        const float3 expected = glm::exp(-absorption * thickness);
        const float3 solid = through(kSolid, fmt::format("{} material.thickness = {:.1f};", absorbing, thickness));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(solid[c], expected[c], 3e-3f) << thickness;
    }
    const float3 share = through(kSolid, absorbing);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(share[c], 1 - absorption[c], 3e-3f) << "without a distance";
    // Thin: light reflected by the far interface has crossed the layer twice, and so on.
    const float3 thin = through(kThin, absorbing + "material.microThickness = 0.5;");
    for (int c = 0; c < 3; ++c) {
        const float f = 0.04f, t = std::exp(-absorption[c] * 0.5f), bounces = 1 / (1 - f * f * t * t);
        EXPECT_NEAR(thin[c], (1 - f) * t * (1 + f * t) * bounces, 3e-3f) << "thin";
    }
}

TEST(RefractionModel, GlassLosesAndGainsNothingInAWhiteFurnace) {
    for (const std::string_view properties : { kSolid, kThin }) {
        for (const float roughness : { 0.0f, 0.5f, 1.0f }) {
            expectFurnace(text(properties, fmt::format("material.roughness = {:.1f};", roughness)), 0.97f);
            expectFurnace(text(properties,
                               fmt::format("material.roughness = {:.1f}; material.transmission = 0.5;", roughness)),
                          0.95f);
        }
    }
}

TEST(RefractionModel, WithoutTransmissionItIsTheOpaqueMaterial) {
    const std::string code = "material.baseColor.rgb = vec3(0.2, 0.5, 0.8); material.roughness = 0.4;";
    const Image opaque = seenOnSphere(text("", code), kDirectionSky);
    for (const std::string_view properties : { kSolid, kThin }) {
        const Image closed = seenOnSphere(text(properties, code + "material.transmission = 0.0;"), kDirectionSky);
        for (uint32_t i = 0; i < 32; ++i) expectNear(halfPixel(closed, i, 16), float3(halfPixel(opaque, i, 16)), 1e-3f);
    }
}

TEST(RefractionModel, DispersionBendsBlueMoreThanGreenAndRedLess) {
    const Sky gray{ float3(0.5f), float3(0.5f) };
    const std::string code = "material.roughness = 0.0;";
    const Image without = seenOnSphere(text(kSolid, code), gray);
    const Image with = seenOnSphere(text(kSolid, code + "material.dispersion = 1.0;"), gray);
    const Image none = seenOnSphere(text(kSolid, code + "material.dispersion = 0.0;"), gray);
    EXPECT_EQ(without.pixels, none.pixels) << "neutral";
    // Directly above the middle: only y changes, and the ball inverts it.
    for (const uint32_t y : { 10u, 13u }) {
        EXPECT_EQ(halfPixel(with, 16, y).y, halfPixel(without, 16, y).y) << "green stays";
    }
    EXPECT_NE(halfPixel(with, 10, 16).x, halfPixel(without, 10, 16).x);
    EXPECT_NE(halfPixel(with, 16, 10).z, halfPixel(without, 16, 10).z);
}

TEST(RefractionModel, AThinLayerPassesALightBehindItOnAsItsMirrorImageWouldBeReflected) {
    const Image picture = onBothApis([&](MaterialStage& stage) {
        stage.view.size = { 9, 9 };
        stage.add(stage.material(text(kThin, "material.roughness = 0.5;"), kSunOnly), { {} });
        stage.scene.add(SunLight{ .directionWorld = { 0, 0, 1 },
                                  .illuminance = Lux{ 1 / stage.view.camera.exposure.factor() } });
    });
    const float alpha = 0.25f, share = 0.96f / 1.04f;
    EXPECT_NEAR(centerPixel(picture).x, share / (4 * 3.14159265f * alpha * alpha), 0.02f);
}

} // namespace
} // namespace filament_core
