// SPDX-License-Identifier: Apache-2.0
// Names and colours of debug views. That images have these colours is tested where they are drawn
// (tests/filament_core/engine).
#include <filament_core/DebugViews.h>
#include <filament_core/View.h>

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace filament_core {
namespace {

TEST(DebugViewNames, AreDistinctAndListedOnceInTheirOrder) {
    for (size_t i = 0; i < kDebugViewCount; ++i) {
        const auto view = static_cast<DebugView>(i);
        EXPECT_EQ(enumFromName<DebugView>(toString(view)), view);
    }
    EXPECT_EQ(enumFromName<DebugView>("albedo"), std::nullopt);
    EXPECT_EQ(enumFromName<DebugView>(""), std::nullopt);
}

double luminanceOf(DebugColor color) { return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]; }

TEST(DebugColors, OfMarksAreFoundAgainAndNoOthers) {
    std::set<DebugColor> colors;
    for (size_t i = 1; i < kNumericsMarks; ++i) {
        const auto mark = static_cast<NumericsMark>(i);
        EXPECT_EQ(numericsMarkOf(numericsColor(mark)), mark) << toString(mark);
        colors.insert(numericsColor(mark));
    }
    EXPECT_EQ(colors.size(), kNumericsMarks - 1);
    for (int grey = 0; grey < 256; ++grey) {
        const auto code = static_cast<uint8_t>(grey);
        EXPECT_EQ(numericsMarkOf({ code, code, code }), NumericsMark::None);
    }
    size_t known = 0;
    for (uint32_t code = 0; code < 1u << 24; ++code)
        known += numericsMarkOf({ static_cast<uint8_t>(code), static_cast<uint8_t>(code >> 8),
                                  static_cast<uint8_t>(code >> 16) })
                         .has_value();
    EXPECT_EQ(known, 256 + kNumericsMarks - 1);
}

TEST(DebugColors, OfMarksAreCounted) {
    std::vector<std::byte> pixels;
    for (size_t i = 0; i < kNumericsMarks; ++i) {
        for (size_t n = 0; n <= i; ++n) {
            for (const uint8_t code : numericsColor(static_cast<NumericsMark>(i))) pixels.push_back(std::byte{ code });
            pixels.push_back(std::byte{ 7 }); // alpha does not matter
        }
    }
    EXPECT_THAT(countNumerics(pixels), testing::ElementsAre(1, 2, 3, 4, 5, 6));
    pixels.resize(pixels.size() - 1);
    EXPECT_THAT(countNumerics(pixels), testing::ElementsAre(1, 2, 3, 4, 5, 5)) << "three bytes are no pixel";
    for (std::byte& byte : pixels) byte = std::byte{ 1 };
    pixels[0] = std::byte{ 2 };
    EXPECT_EQ(countNumerics(pixels)[0], 20u) << "other colours are no mark";
    EXPECT_THAT(countNumerics({}), testing::Each(0u));
}

TEST(DebugColors, OfRulesAreFoundAgainAndHaveNamesAndMeanings) {
    std::set<std::string> words;
    for (size_t i = 1; i < kPlausibilityRules; ++i) {
        const auto rule = static_cast<PlausibilityRule>(i);
        EXPECT_EQ(plausibilityRuleOf(plausibilityColor(rule)), rule) << toString(rule);
        words.insert({ toString(rule), meaningOf(rule) });
    }
    EXPECT_EQ(words.size(), 2 * (kPlausibilityRules - 1));
    EXPECT_STREQ(toString(PlausibilityRule::None), "none");
    EXPECT_EQ(plausibilityRuleOf({ 77, 77, 77 }), PlausibilityRule::None);
    EXPECT_EQ(plausibilityRuleOf({ 77, 77, 78 }), std::nullopt);
}

TEST(DebugColors, OfStopsGetLighterButForMiddleGrey) {
    EXPECT_EQ(luminanceColor(0), (DebugColor{ 153, 153, 153 }));
    for (const int stops : { -7, -8, -1000, std::numeric_limits<int>::min() })
        EXPECT_EQ(luminanceColor(stops), (DebugColor{ 0, 0, 0 })) << stops;
    for (const int stops : { 7, 8, 1000, std::numeric_limits<int>::max() })
        EXPECT_EQ(luminanceColor(stops), (DebugColor{ 255, 255, 255 })) << stops;
    double last = 0;
    for (int stops = -6; stops <= 7; ++stops) {
        if (stops == 0) continue;
        EXPECT_GT(luminanceOf(luminanceColor(stops)), last) << stops;
        last = luminanceOf(luminanceColor(stops));
    }
    EXPECT_EQ(luminanceColor(-6), (DebugColor{ 68, 1, 84 }));
    EXPECT_EQ(luminanceColor(6), (DebugColor{ 253, 231, 37 }));
}

TEST(DebugColors, OfCountsChangeAtTheDocumentedSteps) {
    const std::set<uint32_t> steps{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193, 256 };
    for (uint32_t count = 1; count < 400; ++count) {
        const bool isStep = steps.contains(count);
        EXPECT_EQ(countColor(count) != countColor(count - 1), isStep) << count;
        const double before = count > 1 ? luminanceOf(countColor(count - 1)) : 0;
        EXPECT_EQ(luminanceOf(countColor(count)) > before, isStep) << count;
    }
    EXPECT_EQ(countColor(0), (DebugColor{ 64, 64, 64 }));
    EXPECT_EQ(countColor(1), (DebugColor{ 68, 1, 84 }));
    EXPECT_EQ(countColor(255), (DebugColor{ 253, 231, 37 }));
    EXPECT_EQ(countColor(~0u), (DebugColor{ 255, 255, 255 }));
}

TEST(DebugColors, OfMipLevelsAreOfZeroToTen) {
    EXPECT_EQ(mipLevelColor(0), (DebugColor{ 68, 1, 84 }));
    EXPECT_EQ(mipLevelColor(5), (DebugColor{ 33, 145, 140 }));
    for (const float level : { 10.0f, 11.0f, HUGE_VALF }) EXPECT_EQ(mipLevelColor(level), (DebugColor{ 253, 231, 37 }));
    for (const float level : { -0.01f, -20.0f, -HUGE_VALF, std::nanf("") })
        EXPECT_EQ(mipLevelColor(level), (DebugColor{ 153, 153, 153 }));
}

} // namespace
} // namespace filament_core
