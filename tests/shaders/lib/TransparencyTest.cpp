// SPDX-License-Identifier: Apache-2.0
#include "shaders/lib/LibCpp.h"

#include "base/math/Half.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace filament_core::shader::lib {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();

TEST(TransparencySums, WeightsAreRatiosOfDistancesBetweenTheirEnds) {
    for (float nearest = 0.01f; nearest < 1e4f; nearest *= 3) {
        for (float ratio = 0.25f; ratio < 1e5f; ratio *= 1.25f) {
            const float expected = std::clamp(1 / ratio, kLeastWeight, 1.0f);
            EXPECT_NEAR(transparencyWeight(nearest * ratio, nearest), expected, 1e-6f * expected);
        }
        for (const float behind : { 0.0f, -1.0f, -nearest }) EXPECT_EQ(transparencyWeight(behind, nearest), 1);
    }
    EXPECT_EQ(transparencyWeight(1e30f, 1), kLeastWeight);
}

/// What a half float stores.
vec4 stored(vec4 value) {
    for (int i = 0; i < 4; ++i) value[i] = floatFromHalf(halfFromFloat(value[i]));
    return value;
}

vec4 meanOf(std::initializer_list<std::pair<vec4, float>> surfaces) {
    vec4 sums(0);
    float cover = 0;
    for (auto const& [color, weight] : surfaces) {
        sums = stored(sums + stored(weightedSurface(color, weight)));
        cover = stored(vec4(cover + countedAlpha(color.w) * (1 - cover))).x;
    }
    return weightedMean(sums, cover);
}

TEST(TransparencySums, OneSurfaceComesBackAtAnyWeight) {
    for (float alpha = 1.0f / 512; alpha <= 1; alpha *= 1.7f) {
        for (float weight = kLeastWeight; weight <= 1; weight *= 1.7f) {
            for (float light = 1e-3f; light < 6e4f; light *= 7) {
                const vec4 color(vec3(light) * alpha, alpha);
                const vec4 mean = meanOf({ { color, weight } });
                const float digits = 2e-3f + 0.1f * 0x1p-24f / (alpha * weight); // of what sums of alpha keep
                EXPECT_NEAR(mean.x, color.x, digits * color.x + 0x1p-24f / weight) << alpha << ' ' << weight;
                EXPECT_NEAR(mean.w, alpha, 1e-3f * alpha);
            }
        }
    }
}

TEST(TransparencySums, EqualSurfacesAreTheirColourWhateverTheirWeights) {
    const vec4 color(0.3f, 0.15f, 0.6f, 0.6f);
    const vec4 mean = meanOf({ { color, 1 }, { color, 0.01f }, { color, 0.5f } });
    const float cover = 1 - 0.4f * 0.4f * 0.4f;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], color[c] / color.w * cover, 2e-3f);
    EXPECT_NEAR(mean.w, cover, 1e-3f);
}

TEST(TransparencySums, NothingOverflowsAndNothingIsNothing) {
    for (const float light : { 65504.0f, 1e6f, 1e30f, kEndless }) {
        const vec4 bright(light, light, 0, 1);
        for (const vec4 mean : { meanOf({ { bright, 1 }, { bright, 1 }, { vec4(0, 0, 0, 1), kLeastWeight } }),
                                 meanOf({ { bright, kLeastWeight }, { vec4(0, 0, 0, 0.01f), 1 } }),
                                 meanOf({ { vec4(light, 0, 0, 0), kLeastWeight } }) }) {
            for (int c = 0; c < 4; ++c) {
                EXPECT_GE(mean[c], 0) << light;
                EXPECT_LE(mean[c], 65504) << light;
            }
        }
    }
    EXPECT_EQ(weightedMean(vec4(0), 0), vec4(0));
    EXPECT_EQ(weightedMean(vec4(kEndless, 0, 0, kEndless), 1).y, 0);
    EXPECT_EQ(countedAlpha(-1), kLeastAlpha);
    EXPECT_EQ(countedAlpha(2), 1);
    vec4 sums(0);
    for (int i = 0; i < 4096; ++i) sums = stored(sums + stored(weightedSurface(vec4(0.5f, 0.5f, 0.5f, 1), 1)));
    EXPECT_NEAR(weightedMean(sums, 1).x, 0.5f, 0.01f) << "many layers";
}

} // namespace
} // namespace filament_core::shader::lib
