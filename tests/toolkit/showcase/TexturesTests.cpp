// SPDX-License-Identifier: Apache-2.0
#include "toolkit/showcase/Noise.h"
#include "toolkit/showcase/Textures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace filament_core::showcase {
namespace {

float4 texel(Picture const& picture, uint32_t x, uint32_t y) {
    const std::byte* bytes = &picture.pixels[(size_t(y) * picture.size + x) * 4];
    float4 value;
    for (int c = 0; c < 4; ++c) value[c] = static_cast<float>(std::to_integer<int>(bytes[c])) / 255;
    return value;
}

TEST(Noise, IsTheSameOnePeriodFurther) {
    const int2 period{ 5, 3 };
    for (int i = 0; i < 200; ++i) {
        const float2 p{ 0.1f + 0.037f * static_cast<float>(i), 2.3f - 0.021f * static_cast<float>(i) };
        const float2 shifted = p + float2(period);
        EXPECT_NEAR(fractalNoise(p, period, 4, 9), fractalNoise(shifted, period, 4, 9), 1e-4f);
        EXPECT_NEAR(cellularNoise(p, period, 9).distance, cellularNoise(shifted, period, 9).distance, 1e-4f);
        EXPECT_NEAR(cellularNoise(p, period, 9).edgeDistance, cellularNoise(shifted, period, 9).edgeDistance, 1e-4f);
    }
}

TEST(Noise, IsContinuousAndStaysInItsRange) {
    for (int i = 0; i < 2000; ++i) {
        const float2 p{ 0.0137f * static_cast<float>(i), 1.7f };
        const float here = fractalNoise(p, { 32, 32 }, 4, 5),
                    beside = fractalNoise(p + float2(1e-3f, 0), { 32, 32 }, 4, 5);
        EXPECT_GE(here, 0.0f);
        EXPECT_LE(here, 1.0f);
        EXPECT_LT(std::abs(here - beside), 0.01f);
    }
}

TEST(Noise, AnEdgeIsAsFarFromBothItsCells) {
    // Walks until the nearest cell changes; there the edge must be close.
    const int2 period{ 8, 8 };
    int changes = 0;
    float previous = cellularNoise({ 0, 0.4f }, period, 3).random;
    for (int i = 1; i < 4000; ++i) {
        const CellularSample sample = cellularNoise({ 0.002f * static_cast<float>(i), 0.4f }, period, 3);
        if (sample.random != previous) {
            ++changes;
            EXPECT_LT(sample.edgeDistance, 0.005f);
        }
        previous = sample.random;
    }
    EXPECT_GE(changes, 6);
}

TEST(Textures, ColorsTileWithoutASeam) {
    // The step across the border is no larger than the largest step inside (bricks, chips and squares have hard edges).
    for (const TextureSet& set : { woodTextures(64), stainedGlassTextures(64) }) {
        const uint32_t last = set.color.size - 1;
        float border = 0, inside = 0;
        for (uint32_t i = 0; i <= last; ++i) {
            border = std::max(border, length(texel(set.color, i, 0) - texel(set.color, i, last)));
            for (uint32_t j = 0; j < last; ++j) {
                inside = std::max(inside, length(texel(set.color, i, j) - texel(set.color, i, j + 1)));
            }
        }
        EXPECT_LE(border, inside);
    }
}

TEST(Textures, NormalsAreUnitAndPointOutwardsOnAverage) {
    for (const TextureSet& set : { brickTextures(64), dimpleTextures(64) }) {
        float3 sum{ 0 };
        for (uint32_t y = 0; y < 64; ++y) {
            for (uint32_t x = 0; x < 64; ++x) {
                const float3 normal = float3(texel(set.normal, x, y)) * 2.0f - 1.0f;
                ASSERT_NEAR(length(normal), 1.0f, 0.02f);
                ASSERT_GT(normal.z, 0.0f);
                sum += normal;
            }
        }
        EXPECT_LT(std::abs(sum.x), 0.02f * sum.z);
        EXPECT_LT(std::abs(sum.y), 0.02f * sum.z);
    }
}

TEST(Textures, ADimpleIsAHollow) {
    // Hollows begin at rows of 1/8; left of a hollow's centre the surface falls to the right, so its normal leans
    // right.
    const TextureSet set = dimpleTextures(256);
    const uint32_t row = 16; // the middle of the first row; its first hollow is centred at column 16
    EXPECT_GT(texel(set.normal, 8, row).x, 0.55f);
    EXPECT_LT(texel(set.normal, 24, row).x, 0.45f);
    EXPECT_GT(texel(set.normal, 16, row).z, 0.99f);
    EXPECT_LT(texel(set.normal, 16, 8).y, 0.45f); // above the centre it leans down the image
    EXPECT_GT(texel(set.normal, 16, 24).y, 0.55f);
}

TEST(Textures, LatticeAndGlassHaveTheAlphaThatTheirModesNeed) {
    const TextureSet lattice = latticeTextures(128), glass = stainedGlassTextures(128);
    size_t holes = 0, clear = 0, lead = 0;
    for (uint32_t y = 0; y < 128; ++y) {
        for (uint32_t x = 0; x < 128; ++x) {
            holes += texel(lattice.color, x, y).w < 0.5f;
            clear += texel(glass.color, x, y).w < 0.6f;
            lead += texel(glass.color, x, y).w > 0.99f;
        }
    }
    EXPECT_NEAR(static_cast<double>(holes) / (128 * 128), 3.14159 * 0.38 * 0.38, 0.02); // circles of radius 0.38 cells
    EXPECT_GT(clear, 128u * 128 / 2);
    EXPECT_GT(lead, 128u * 128 / 50);
}

} // namespace
} // namespace filament_core::showcase
