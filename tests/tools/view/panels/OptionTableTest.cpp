// SPDX-License-Identifier: Apache-2.0
// Options as rows: all that the engine has, with widgets that take all that is valid and nothing else.
#include "tools/view/panels/OptionTable.h"
#include "tools/view/panels/OptionCosts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace filament::view {
namespace {

TEST(OptionTable, HasEveryNameOfTheEnginesTablesOnce) {
    const std::vector<Option> options = makeOptions();
    std::set<std::string> names;
    for (Option const& option : options) EXPECT_TRUE(names.insert(option.name).second) << option.name;
    for (QualityChoice const& choice : qualityChoices()) EXPECT_TRUE(names.contains(std::string(choice.name)));
    for (EffectOption const& option : effectOptions()) EXPECT_TRUE(names.contains(std::string(option.name)));
    for (ColorGradingOption const& option : colorGradingOptions())
        EXPECT_TRUE(names.contains(std::string(option.name)));
    EXPECT_EQ(names.size(), 4 + qualityChoices().size() + effectOptions().size() + colorGradingOptions().size());
}

/// No option of the engine is left with a line of text: the words of its range are understood.
TEST(OptionTable, EveryOptionHasAWidgetOfItsKind) {
    for (Option const& option : makeOptions()) {
        EXPECT_NE(option.kind, OptionKind::Text) << option.name << ": " << option.range;
        EXPECT_EQ(option.standard, optionValue({}, option)) << option.name;
    }
}

TEST(OptionTable, EveryWordCanBeSetAndIsReadBack) {
    for (Option const& option : makeOptions()) {
        std::vector<std::string> values = option.words;
        if (option.kind == OptionKind::Number) {
            const std::vector<float> least(option.components, static_cast<float>(option.least));
            const std::vector<float> most(option.components, static_cast<float>(option.most));
            values.push_back(optionText(option, least));
            values.push_back(optionText(option, most));
        }
        EXPECT_GE(values.size(), 2u) << option.name;
        for (std::string const& value : values) {
            View view;
            const Result<void> done = setOption(view, option, value);
            ASSERT_TRUE(done) << done.error().message;
            EXPECT_EQ(optionValue(view, option), value) << option.name;
        }
    }
}

TEST(OptionTable, LimitsAreThoseOfTheEngine) {
    for (Option const& option : makeOptions()) {
        if (option.kind != OptionKind::Number) continue;
        const auto beyond = [&](double limit, float direction) {
            const auto number = static_cast<float>(limit);
            const float next = option.isWhole ? number + direction : std::nextafter(number, direction * INFINITY);
            return optionText(option, std::vector<float>(option.components, next));
        };
        View view;
        EXPECT_FALSE(setOption(view, option, beyond(option.most, 1))) << option.name;
        EXPECT_FALSE(setOption(view, option, beyond(option.least, -1))) << option.name;
        EXPECT_EQ(optionValue(view, option), option.standard) << option.name;
    }
}

TEST(OptionTable, RefusesWhatIsNotAValue) {
    for (Option const& option : makeOptions()) {
        View view;
        const Result<void> done = setOption(view, option, "no such value");
        ASSERT_FALSE(done) << option.name;
        EXPECT_NE(done.error().message.find("no such value"), std::string::npos) << done.error().message;
    }
    View view;
    EXPECT_FALSE(setOption(view, { .name = "nothing" }, "on"));
}

TEST(OptionTable, UnderstandsTheWordsOfRanges) {
    const Option flag = optionFromRange("off or on", "off");
    EXPECT_EQ(flag.kind, OptionKind::Switch);
    const Option choice = optionFromRange("base, golden or punchy", "base");
    EXPECT_EQ(choice.kind, OptionKind::Choice);
    EXPECT_EQ(choice.words, (std::vector<std::string>{ "base", "golden", "punchy" }));
    const Option whole = optionFromRange("a whole number from 16 to 256", "64");
    EXPECT_TRUE(whole.kind == OptionKind::Number && whole.isWhole && whole.components == 1);
    const Option color = optionFromRange("R,G,B, each from -1 to 1000.5", "0,0,0");
    EXPECT_TRUE(color.kind == OptionKind::Number && color.components == 3);
    EXPECT_EQ(color.least, -1);
    EXPECT_EQ(color.most, 1000.5);
    const Option scale = optionFromRange("a number from 0.5 to 1, or two: X,Y", "1,1");
    EXPECT_TRUE(scale.kind == OptionKind::Number && scale.components == 2 && scale.most == 1);
    for (const char* strange : { "", "anything", "a path of a file", "from here to there", "from 2 to 1", ", or " })
        EXPECT_EQ(optionFromRange(strange, "x").kind, OptionKind::Text) << strange;
}

TEST(OptionTable, NumbersSurviveTheirTexts) {
    Option option{ .kind = OptionKind::Number, .components = 3 };
    const std::vector<float> numbers{ 0.1f, -3e-7f, 12345.678f };
    EXPECT_EQ(optionNumbers(option, optionText(option, numbers)), numbers);
    EXPECT_TRUE(optionNumbers(option, "1,2").empty());
    EXPECT_TRUE(optionNumbers(option, "1,2,x").empty());
    EXPECT_TRUE(optionNumbers(option, "1,2,3,4").empty());
}

TEST(OptionTable, FamiliesAreWhatComesBeforeTheDot) {
    EXPECT_EQ((Option{ .name = "fog.density" }).family(), "fog");
    EXPECT_EQ((Option{ .name = "fog" }).family(), "fog");
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
} // namespace filament::view
