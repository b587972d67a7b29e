// SPDX-License-Identifier: Apache-2.0
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace filament_core::shader::lib {
namespace {

TEST(ResolutionFilters, CatmullRomWeightsKeepParabolas) {
    for (float f = 0; f <= 1; f += 0.0625f) {
        const vec4 w = catmullRomWeights(f);
        EXPECT_NEAR(w.x + w.y + w.z + w.w, 1, 3e-7f);
        const auto parabola = [](float x) { return 2 - 3 * x + 0.7f * x * x; };
        EXPECT_NEAR(w.x * parabola(-1) + w.y * parabola(0) + w.z * parabola(1) + w.w * parabola(2), parabola(f), 2e-6f);
        const vec4 mirrored = catmullRomWeights(1 - f);
        EXPECT_NEAR(w.x, mirrored.w, 2e-7f);
        EXPECT_NEAR(w.y, mirrored.z, 2e-7f);
    }
    EXPECT_EQ(catmullRomWeights(0), vec4(0, 1, 0, 0));
}

TEST(ResolutionFilters, BoundedLightComesBack) {
    for (float light = 1e-4f; light < 6e4f; light *= 1.7f) {
        const vec3 bounded = boundedLight(vec3(light));
        EXPECT_LT(bounded.x, 1);
        EXPECT_NEAR(lightFromBounded(bounded).x, light, light * 3e-7f * (1 + light));
    }
    EXPECT_EQ(lightFromBounded(vec3(1, 2, -1)), vec3(65504, 65504, 0));
}

TEST(ResolutionFilters, MonotonyTellsEdgesFromLines) {
    EXPECT_EQ(monotony(0.2f, 0.2f, 0.8f), 1) << "beside an edge";
    EXPECT_EQ(monotony(0.2f, 0.5f, 0.8f), 1) << "a ramp";
    EXPECT_EQ(monotony(0.2f, 0.9f, 0.2f), 0) << "a line";
    EXPECT_NEAR(monotony(0.2f, 0.8f, 0.5f), 0.5f, 1e-6f);
    EXPECT_EQ(monotony(0.4f, 0.4f, 0.4f), 0);
    EXPECT_EQ(monotony(0.8f, 0.5f, 0.2f), monotony(0.2f, 0.5f, 0.8f));
}

TEST(ResolutionFilters, TheFilterIsRoundWithoutAnEdgeAndLongAlongOne) {
    EXPECT_EQ(edgeShape(1, 0, 0), vec3(1, 1, 0.5f));
    EXPECT_EQ(edgeShape(1, 0, 1), vec3(1, 0.5f, 0.5f - 0.29f));
    EXPECT_EQ(edgeShape(0, -1, 1), edgeShape(1, 0, 1));
    const float diagonal = std::sqrt(0.5f);
    EXPECT_NEAR(edgeShape(diagonal, -diagonal, 1).x, std::sqrt(2.0f), 1e-6f);
}

TEST(ResolutionFilters, TheKernelIsOneInTheMiddleAndEndsSmoothly) {
    for (const float lobe : { 0.21f, 0.3f, 0.5f }) {
        EXPECT_EQ(edgeKernel(0, lobe), 1);
        EXPECT_NEAR(edgeKernel(1, lobe), 0, 1e-6f);
        EXPECT_NEAR(edgeKernel(1 / lobe, lobe), 0, 1e-6f);
        EXPECT_NEAR(edgeKernel(1 / lobe - 1e-3f, lobe), 0, 1e-5f);
        for (float x = 0.01f; x < 1; x += 0.01f) EXPECT_GT(edgeKernel(x, lobe), 0);
        // Two polynomials are no sine: by a few thousandths, the lobe may end above 0.
        for (float x = 1.01f; x < 1 / lobe; x += 0.01f) EXPECT_LT(edgeKernel(x, lobe), x < 4 ? 1e-7f : 3e-3f);
    }
    // At the square of its argument, it is within a few per cent of Lanczos' filter of two lobes.
    for (float x = 0.1f; x < 2; x += 0.1f) {
        const float pi = 3.14159265f;
        const float exact = std::sin(pi * x) / (pi * x) * std::sin(pi * x / 2) / (pi * x / 2);
        EXPECT_NEAR(edgeKernel(x * x, 0.25f), exact, 0.055f) << x;
    }
}

TEST(ResolutionFilters, SharpeningIsTheStrongestThatStaysInRange) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> any(0, 1);
    float tightest = 1;
    for (int i = 0; i < 20000; ++i) {
        const float spread = any(random), base = any(random) * (1 - spread);
        float values[5]; // the pixel first
        for (float& value : values)
            value = i % 3 == 0 ? (any(random) < 0.5f ? base : base + spread) : base + spread * any(random);
        const float least = *std::min_element(values, values + 5), most = *std::max_element(values, values + 5);
        const float weight = sharpeningWeight(vec3(least), vec3(most));
        EXPECT_TRUE(weight <= 0 && weight >= -kMostSharpening);
        const float sharp = (values[0] + weight * (values[1] + values[2] + values[3] + values[4])) / (1 + 4 * weight);
        EXPECT_GE(sharp, -1e-5f);
        EXPECT_LE(sharp, 1 + 1e-5f);
        if (weight > -kMostSharpening) tightest = std::min({ tightest, sharp, 1 - sharp });
    }
    EXPECT_LT(tightest, 0.01f) << "no more room";
    EXPECT_EQ(sharpeningWeight(vec3(0), vec3(1)), 0);
    EXPECT_EQ(sharpeningWeight(vec3(0), vec3(0)), 0);
    EXPECT_EQ(sharpeningWeight(vec3(1), vec3(1)), 0);
    EXPECT_EQ(sharpeningWeight(vec3(0.5f), vec3(0.5f)), -kMostSharpening);
}

TEST(ResolutionFilters, TheShareOfASampleSumsToOneForAnyRamp) {
    for (const float ramp : { 0.0625f, 0.1f, 0.3f, 0.5f }) {
        double sum = 0;
        constexpr int kSteps = 4000;
        for (int i = 0; i < kSteps; ++i)
            sum += double(sampleShare((static_cast<float>(i) + 0.5f) / kSteps * 4 - 2, ramp)) * 4 / kSteps;
        EXPECT_NEAR(sum, 1, 1e-4);
        EXPECT_EQ(sampleShare(0, ramp), 1);
        EXPECT_NEAR(sampleShare(0.5f, ramp), 0.5f, 1e-6f);
        EXPECT_EQ(sampleShare(1.01f, ramp), 0);
    }
}

} // namespace
} // namespace filament_core::shader::lib
