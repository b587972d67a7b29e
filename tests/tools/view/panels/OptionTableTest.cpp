// SPDX-License-Identifier: Apache-2.0
// Options as rows: all that the engine has, with widgets that take all that is valid and nothing else.
#include "tools/view/panels/OptionTable.h"
#include "tools/view/panels/OptionCosts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace filament_core::view {
namespace {

TEST(OptionTable, HasEveryOptionOfAViewInOneGroup) {
    std::set<Option const*> shown;
    for (OptionGroup const& group : makeOptionGroups()) {
        EXPECT_FALSE(group.options.empty()) << group.title;
        for (Option const* option : group.options) EXPECT_TRUE(shown.insert(option).second) << option->name;
    }
    EXPECT_EQ(shown.size(), optionsOf<View>().size());
}

TEST(OptionTable, CostsAreKnownForApproximationsOfShading) {
    EXPECT_TRUE(isRated(*findOption(optionsOf<View>(), "splitSum")));
    EXPECT_FALSE(isRated(*findOption(optionsOf<View>(), "bloom")));
    EXPECT_EQ(defaultValue(*findOption(optionsOf<View>(), "fog.color")), "0.5,0.6,0.7");
}

/// What a widget writes at its ends is accepted.
TEST(OptionTable, NumbersOfWidgetsAreAccepted) {
    for (Option const& option : optionsOf<View>()) {
        if (option.kind != OptionKind::Number && option.kind != OptionKind::Integer) continue;
        for (const double limit : { option.least, option.most }) {
            View view;
            constexpr double kMost = std::numeric_limits<float>::max(); // of numbers without limits
            const std::vector<float> numbers(option.components, static_cast<float>(std::clamp(limit, -kMost, kMost)));
            EXPECT_TRUE(setOption(view, option.name, optionText(option, numbers))) << option.name << '=' << limit;
        }
    }
}

TEST(OptionTable, NumbersSurviveTheirTexts) {
    const Option option{ .kind = OptionKind::Number, .components = 3 };
    const std::vector<float> numbers{ 0.1f, -3e-7f, 12345.678f };
    EXPECT_EQ(optionNumbers(option, optionText(option, numbers)), numbers);
    EXPECT_TRUE(optionNumbers(option, "1,2").empty());
    EXPECT_TRUE(optionNumbers(option, "1,2,x").empty());
    EXPECT_TRUE(optionNumbers(option, "1,2,3,4").empty());
}

TEST(OptionCosts, AreRatiosOfTheTableTimesTheFrame) {
    QualityCosts costs;
    costs.effects.push_back({ .name = "ao",
                              .values = { { .value = "off", .error = 0.25, .vulkan = { .milliseconds = 10 } },
                                          { .value = "gtao", .error = 0, .vulkan = { .milliseconds = 15 } } } });
    const auto cost = tabledCost(costs, Backend::Vulkan, "ao", "off", "gtao", 4);
    ASSERT_TRUE(cost);
    EXPECT_DOUBLE_EQ(cost->milliseconds, 2);
    EXPECT_EQ(tabledCost(costs, Backend::Vulkan, "ao", "gtao", "off", 6)->error, 0.25);
    EXPECT_DOUBLE_EQ(tabledCost(costs, Backend::Vulkan, "ao", "gtao", "off", 6)->milliseconds, -2);
    EXPECT_FALSE(tabledCost(costs, Backend::Gles, "ao", "off", "gtao", 4)) << "never measured";
    EXPECT_FALSE(tabledCost(costs, Backend::Vulkan, "ao", "off", "sao", 4));
    EXPECT_FALSE(tabledCost(costs, Backend::Vulkan, "shadows", "off", "on", 4));
}

void frames(ChangeMeter& meter, size_t count, double milliseconds) {
    for (size_t i = 0; i < count; ++i) meter.frame(milliseconds);
}

TEST(ChangeMeter, MeasuresTheMedianAfterAgainstTheMedianBefore) {
    ChangeMeter meter;
    frames(meter, 12, 10);
    meter.frame(500); // a hiccup
    meter.changed("ao", "off", "gtao");
    frames(meter, ChangeMeter::kSkipped, 900); // programs are being compiled
    frames(meter, ChangeMeter::kFrames, 13);
    ASSERT_TRUE(meter.changeOf("ao"));
    EXPECT_DOUBLE_EQ(meter.changeOf("ao")->milliseconds, 3);
    EXPECT_EQ(meter.changeOf("ao")->from, "off");
    EXPECT_EQ(meter.changeOf("ao")->to, "gtao");
    EXPECT_EQ(meter.changeOf("bloom"), nullptr);
    meter.changed("bloom", "off", "on");
    frames(meter, ChangeMeter::kSkipped + ChangeMeter::kFrames, 14);
    EXPECT_DOUBLE_EQ(meter.changeOf("bloom")->milliseconds, 1);
}

TEST(ChangeMeter, SaysNothingOfChangesThatNobodyCanTellApart) {
    ChangeMeter meter;
    frames(meter, 12, 10);
    meter.changed("ao", "off", "gtao");
    frames(meter, 6, 13);
    meter.changed("bloom", "off", "on");
    frames(meter, 30, 14);
    EXPECT_EQ(meter.changeOf("ao"), nullptr);
    EXPECT_EQ(meter.changeOf("bloom"), nullptr);
    EXPECT_EQ(meter.medianMilliseconds(), 14);
}

TEST(ChangeMeter, ASliderThatIsDraggedIsOneChange) {
    ChangeMeter meter;
    frames(meter, 12, 10);
    for (int i = 0; i < 20; ++i) {
        meter.changed("fog.density", std::to_string(i), std::to_string(i + 1));
        frames(meter, 2, 100);
    }
    frames(meter, 40, 11);
    ASSERT_TRUE(meter.changeOf("fog.density"));
    EXPECT_EQ(meter.changeOf("fog.density")->from, "0");
    EXPECT_EQ(meter.changeOf("fog.density")->to, "20");
    EXPECT_DOUBLE_EQ(meter.changeOf("fog.density")->milliseconds, 1);
}

} // namespace
} // namespace filament_core::view
