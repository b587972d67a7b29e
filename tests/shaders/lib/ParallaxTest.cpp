// SPDX-License-Identifier: Apache-2.0
// parallax.glsl over a height field that is a formula, in the place of a material's texture.
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib {

namespace relief {
namespace {

/// A ramp from 1 at u = 0 to 0 at u = 1, the same for every v.
float rampHeight(vec2 uv) { return saturate(1.0f - uv.x); }

#define PARALLAX_HEIGHT(uv) rampHeight(uv)
#define OUT(type) type&
#include "shaders/lib/parallax.glsl"
#undef OUT

} // namespace
} // namespace relief

namespace {

constexpr float kScale = 0.25f;

/// The ray from uv sinks to depth t at uv - shift t; the ramp's depth there is its u.
vec3 meeting(vec2 uv, vec3 view) {
    const float slope = view.x / view.z * kScale;
    const float depth = uv.x / (1 + slope);
    return { uv.x - slope * depth, uv.y - view.y / view.z * kScale * depth, depth };
}

TEST(Parallax, OcclusionFindsWhereTheRayMeetsARamp) {
    for (const vec3 view : { vec3(0, 0, 1), glm::normalize(vec3(0.5f, 0.3f, 1)), glm::normalize(vec3(-0.9f, 0, 1)) }) {
        for (const vec2 uv : { vec2(0.1f, 0.5f), vec2(0.43f, 0.2f), vec2(0.7f, 0.7f) }) {
            const vec3 exact = meeting(uv, view), found = relief::parallaxOcclusion(uv, view, kScale, 16);
            EXPECT_LT(glm::distance(found, exact), 2e-3f) << uv.x << ' ' << view.x;
        }
    }
}

TEST(Parallax, TheSteepSearchIsAtMostOneLayerBelowIt) {
    const vec3 view = glm::normalize(vec3(0.5f, 0.3f, 1));
    for (const int layers : { 4, 16, 64 }) {
        const vec3 exact = meeting(vec2(0.43f, 0.2f), view),
                   found = relief::parallaxSteep(vec2(0.43f, 0.2f), view, kScale, layers);
        EXPECT_GE(found.z, exact.z - 1e-5f);
        EXPECT_LE(found.z, exact.z + 1.0f / static_cast<float>(layers) + 1e-5f);
    }
}

TEST(Parallax, AnOffsetIsTheWayAlongTheRay) {
    const vec3 view = glm::normalize(vec3(0.5f, 0.3f, 1));
    const vec3 sunk = view * relief::parallaxOffset(0.25f, view, 2);
    EXPECT_NEAR(sunk.z, 0.5f, 1e-6f) << "below the surface";
    EXPECT_EQ(relief::parallaxOffset(0, view, 2), 0);
    EXPECT_EQ(relief::parallaxOffset(1, vec3(1, 0, 0), 2), 32) << "along the surface";
}

TEST(Parallax, OneFetchMovesByTheDepthBelowTheEntry) {
    const vec3 view = glm::normalize(vec3(0.5f, -0.3f, 1));
    const vec2 moved = relief::parallaxPlain(vec2(0.4f, 0.5f), view, kScale);
    EXPECT_NEAR(moved.x, 0.4f - 0.5f * kScale * 0.4f, 1e-6f);
    EXPECT_NEAR(moved.y, 0.5f + 0.3f * kScale * 0.4f, 1e-6f);
}

TEST(Parallax, NothingMovesWithoutADepthOrStraightBelowTheEye) {
    const vec2 uv(0.3f, 0.6f);
    EXPECT_EQ(relief::parallaxPlain(uv, glm::normalize(vec3(1, 1, 1)), 0.0f), uv);
    EXPECT_EQ(relief::parallaxPlain(uv, vec3(0, 0, 1), kScale), uv);
    const vec3 down = relief::parallaxOcclusion(uv, vec3(0, 0, 1), kScale, 8);
    EXPECT_EQ(vec2(down.x, down.y), uv);
}

TEST(Parallax, GrazingViewsMoveAFiniteDistance) {
    const vec2 shift = relief::parallaxShift(vec3(1, 0, 0), kScale);
    EXPECT_EQ(shift, vec2(16 * kScale, 0));
}

// The ray over the ramp climbs against its slope of 1: it is blocked where it climbs less, by the difference.
TEST(Parallax, TheShadowOfARampIsTheSlopeThatTheLightLacks) {
    for (const int layers : { 2, 16, 64 }) {
        for (const float reach : { 4.0f, 1.0f, 0.5f, -0.5f, -0.99f, -1.1f, -1.2f, -1.3f, -3.0f }) {
            const vec3 light = glm::normalize(vec3(reach / kScale, 0.4f, 1));
            const float lit = relief::parallaxShadow(vec3(0.6f, 0.5f, 0.63f), light, kScale, layers, 0.25f);
            EXPECT_NEAR(lit, saturate(1 - std::max(-1 - reach, 0.0f) / 0.25f), 4e-5f) << reach << ' ' << layers;
        }
    }
    const vec3 hit(0.6f, 0.5f, 0.6f);
    EXPECT_EQ(relief::parallaxShadow(hit, glm::normalize(vec3(1, 0, -0.1f)), kScale, 16, 0.25f), 0) << "from below";
    EXPECT_EQ(relief::parallaxShadow(hit, glm::normalize(vec3(-8, 0, 1)), kScale, 16, 0), 0) << "hard";
    EXPECT_EQ(relief::parallaxShadow(vec3(0, 0.5f, 0), glm::normalize(vec3(-8, 0, 1)), kScale, 16, 0.25f), 1)
            << "on top";
    EXPECT_EQ(parallaxShadow(hit, glm::normalize(vec3(-8, 0, 1)), kScale, 16, 0.25f), 1) << "flat";
}

TEST(Parallax, WithoutHeightsTheSurfaceIsFlat) {
    EXPECT_EQ(parallaxPlain(vec2(0.2f, 0.3f), glm::normalize(vec3(1, 2, 1)), 1.0f), vec2(0.2f, 0.3f));
}

TEST(Color, TheInverseToneMapperUndoesTheFilmicOne) {
    for (const float light : { 0.0f, 0.001f, 0.03f, 0.18f, 1.0f, 4.0f, 7.0f }) {
        const vec3 back = inverseTonemap(toneMapFilmic(vec3(light)));
        EXPECT_NEAR(back.x, light, 1e-4f * (1 + light * light)) << light;
        const vec3 shown = srgbFromLinear(saturate(toneMapFilmic(vec3(light))));
        EXPECT_NEAR(inverseTonemapSRGB(shown).x, light, 2e-4f * (1 + light * light)) << light;
    }
    EXPECT_EQ(inverseTonemap(2.0f), inverseTonemap(1.0f)) << "nothing is brighter than white";
}

TEST(Color, TheTwoFormsOfTheInverseToneMapperMeetWithTheSameSlope) {
    const float joint = 0.03f / 0.59f, step = 1e-3f;
    const float below = inverseTonemap(joint - step), at = inverseTonemap(joint), above = inverseTonemap(joint + step);
    EXPECT_NEAR(at - below, above - at, 0.05f * (above - at));
}

// Of BT.601: white, black and the primaries at full range.
TEST(Color, VideoBecomesColour) {
    EXPECT_EQ(ycbcrToRgb(1.0f, vec2(0.5f)), vec3(1.0f));
    EXPECT_EQ(ycbcrToRgb(0.0f, vec2(0.5f)), vec3(0.0f));
    const vec3 red = ycbcrToRgb(0.299f, vec2(0.5f - 0.168736f, 1.0f));
    EXPECT_LT(glm::distance(red, vec3(1, 0, 0)), 1e-4f);
    const vec3 blue = ycbcrToRgb(0.114f, vec2(1.0f, 0.5f - 0.081312f));
    EXPECT_LT(glm::distance(blue, vec3(0, 0, 1)), 1e-4f);
}

} // namespace
} // namespace filament_core::shader::lib
