// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/tables/ToneTable.h"

#include "base/math/Half.h"
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <cstring>

namespace filament_core::assets {
namespace {

namespace lib = shader::lib;

float3 entry(Image const& table, uint32_t r, uint32_t g, uint32_t b) {
    uint16_t bits[3];
    std::memcpy(bits, table.data.data() + (size_t{ g } * table.width + r + size_t{ b } * table.height) * 8,
                sizeof(bits));
    return { floatFromHalf(bits[0]), floatFromHalf(bits[1]), floatFromHalf(bits[2]) };
}

TEST(ToneTable, TheAxisGoesFromBlackTo256AndBack) {
    EXPECT_EQ(lib::toneTableCoordinate(0.0f), 0.0f);
    EXPECT_EQ(lib::lightFromToneTableCoordinate(0.0f), 0.0f);
    EXPECT_EQ(lib::toneTableCoordinate(256.0f), 1.0f);
    EXPECT_EQ(lib::toneTableCoordinate(1e30f), 1.0f);
    for (const float light : { 0.001f, 0.02f, 0.18f, 1.0f, 7.5f, 200.0f })
        EXPECT_NEAR(lib::lightFromToneTableCoordinate(lib::toneTableCoordinate(light)), light, 2e-5f * light + 1e-6f);
}

TEST(ToneTable, EachEntryIsWhatTheMapperShowsOfItsLight) {
    jobs::JobSystem jobs({ .workers = 1 });
    const Image table = bakeToneTable(jobs, { .toneMapper = ToneMapper::Filmic }, 9);
    ASSERT_EQ(table.width, 81u);
    ASSERT_EQ(table.height, 9u);
    // Coordinates 0.5, 0.625 and 0.25 of 16 stops above 2^-8 are 1, 4 and 2^-4.
    const float3 light = float3(1, 4, 0.0625f) - 1.0f / 256;
    const float3 x = (light * (2.51f * light + 0.03f)) / (light * (2.43f * light + 0.59f) + 0.14f);
    const float3 shown = entry(table, 4, 5, 2);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], lib::srgbFromLinear(x[c]), 0.0006f);
    EXPECT_EQ(entry(table, 0, 0, 0), float3(0));
    EXPECT_EQ(entry(table, 8, 8, 8), float3(1));
}

TEST(ToneTable, AMapperThatHoldsItsTransferGetsNoSecondOne) {
    jobs::JobSystem jobs({ .workers = 0 });
    const float3 shown = entry(bakeToneTable(jobs, { .toneMapper = ToneMapper::Mobile }, 9), 4, 4, 4);
    const float light = 1 - 1.0f / 256;
    EXPECT_NEAR(shown.x, light / (light + 0.155f) * 1.019f, 0.0006f);
}

TEST(ToneTable, TheBitsDoNotDependOnTheWorkers) {
    jobs::JobSystem none({ .workers = 0 }), three({ .workers = 3 });
    EXPECT_EQ(bakeToneTable(none, {}, 16).data, bakeToneTable(three, {}, 16).data);
}

} // namespace
} // namespace filament_core::assets
