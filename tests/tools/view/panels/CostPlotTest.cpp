// SPDX-License-Identifier: Apache-2.0
// Time and error of settings as points: which settings, which of them are best, and where they lie on the screen.
#include "tools/view/panels/CostPlot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace filament_core::view {
namespace {

MeasuredSetting point(double milliseconds, double error, std::string name = "setting") {
    return { .setting = { .name = std::move(name) }, .milliseconds = milliseconds, .error = error, .rounds = 1 };
}

TEST(CostPlot, MeasuresEveryValueOfEveryChoiceOnce) {
    View view;
    view.quality.shadows = ShadowFilter::Pcf5;
    const std::vector<QualitySetting> settings = settingsToMeasure(view);
    EXPECT_TRUE(hasSetting(view, settings.at(0))) << "the view's own comes first";
    for (Option const& choice : optionsOf<Quality>()) {
        for (const std::string_view value : choice.values) {
            View other = view;
            ASSERT_TRUE(setOption(other.quality, choice.name, value));
            const auto has = [&](QualitySetting const& setting) { return hasSetting(other, setting); };
            EXPECT_EQ(std::ranges::count_if(settings, has), 1) << choice.name << '=' << value;
        }
    }
    const auto has = [&](std::string_view name) { return std::ranges::count(settings, name, &QualitySetting::name); };
    EXPECT_EQ(has("samples=4"), 1);
    EXPECT_EQ(has("samples=1"), 0) << "as it is";
    EXPECT_EQ(has("preset reference"), 1);
    EXPECT_EQ(has("shadows=pcf5"), 0) << "as it is";
}

TEST(CostPlot, AppliedSettingsAreThoseOfTheView) {
    View view;
    for (QualitySetting const& setting : settingsToMeasure({})) {
        applySetting(view, setting);
        EXPECT_TRUE(hasSetting(view, setting)) << setting.name;
    }
}

bool isBeaten(MeasuredSetting const& a, MeasuredSetting const& b) {
    const bool isNoWorse = b.milliseconds <= a.milliseconds && *b.error <= *a.error;
    return isNoWorse && (b.milliseconds < a.milliseconds || *b.error < *a.error);
}

TEST(CostPlot, TheFrontHasExactlyWhatNobodyBeats) {
    std::mt19937 random(11);
    const auto number = [](std::mt19937& from) { return static_cast<double>(from() % 20); };
    for (int run = 0; run < 200; ++run) {
        std::vector<MeasuredSetting> points;
        for (size_t i = 0; i < 30; ++i) points.push_back(point(number(random), number(random)));
        points[7].rounds = 0;
        points[8].error.reset();
        const std::vector<size_t> front = paretoFront(points);
        for (size_t i = 0; i < points.size(); ++i) {
            const auto beats = [&](MeasuredSetting const& b) { return b.isMeasured() && isBeaten(points[i], b); };
            const bool isBest = points[i].isMeasured() && std::ranges::none_of(points, beats);
            const auto isEqual = [&](size_t j) {
                return points[j].milliseconds == points[i].milliseconds && points[j].error == points[i].error;
            };
            EXPECT_EQ(isBest, points[i].isMeasured() && std::ranges::any_of(front, isEqual)) << i;
        }
        for (size_t i = 1; i < front.size(); ++i) {
            EXPECT_LT(points[front[i - 1]].milliseconds, points[front[i]].milliseconds);
            EXPECT_GT(*points[front[i - 1]].error, *points[front[i]].error);
        }
    }
    EXPECT_TRUE(paretoFront({}).empty());
}

TEST(CostPlot, AllPointsAreInThePlotAndErrorGrowsUpwards) {
    const std::vector<MeasuredSetting> points{ point(10, 0.02), point(12, 0.005), point(11, 0.03) };
    const PlotScale scale = scaleOf(points, { 100, 50 }, { 200, 80 });
    for (MeasuredSetting const& each : points) {
        const float2 place = scale.place(each.milliseconds, *each.error);
        EXPECT_GT(place.x, 100);
        EXPECT_LT(place.x, 300);
        EXPECT_GT(place.y, 50);
        EXPECT_LT(place.y, 130);
    }
    EXPECT_LT(scale.place(11, 0.03).y, scale.place(11, 0.01).y);
    EXPECT_GT(scale.leastX, 5) << "zero is far away";
    EXPECT_EQ(scale.leastY, 0) << "zero is near";
}

TEST(CostPlot, OnePointAndNoneHaveAPlotAsWell) {
    for (std::vector<MeasuredSetting> const& points : { std::vector{ point(0, 0) }, std::vector<MeasuredSetting>{} }) {
        const PlotScale scale = scaleOf(points, { 0, 0 }, { 100, 100 });
        const float2 place = scale.place(0, 0);
        EXPECT_TRUE(std::isfinite(place.x) && std::isfinite(place.y));
    }
}

TEST(CostPlot, TicksAreRoundNumbersInTheRange) {
    EXPECT_EQ(ticksOf(0, 10, 5), (std::vector<double>{ 0, 2, 4, 6, 8, 10 }));
    EXPECT_EQ(ticksOf(9.1, 12.2, 4), (std::vector<double>{ 10, 11, 12 }));
    EXPECT_TRUE(ticksOf(1, 1, 5).empty());
    std::mt19937 random(3);
    for (int run = 0; run < 500; ++run) {
        const double least = std::uniform_real_distribution(-10.0, 10.0)(random);
        const double length = std::exp(std::uniform_real_distribution(-12.0, 12.0)(random));
        const std::vector<double> ticks = ticksOf(least, least + length, 5);
        EXPECT_LE(ticks.size(), 6u);
        EXPECT_GE(ticks.size(), 1u) << least << ' ' << length;
        for (const double tick : ticks) {
            EXPECT_GE(tick, least);
            EXPECT_LE(tick, least + length);
        }
    }
}

TEST(CostPlot, ThePointerFindsTheNearestPointWithinItsReach) {
    const std::vector<MeasuredSetting> points{ point(0, 0), point(10, 1), point(10.2, 1) };
    const PlotScale scale{ { 0, 0 }, { 100, 100 }, 0, 10, 0, 1 };
    EXPECT_EQ(nearestPoint(points, scale, { 3, 97 }, 8), 0u);
    EXPECT_EQ(nearestPoint(points, scale, { 102, 0 }, 8), 2u);
    EXPECT_EQ(nearestPoint(points, scale, { 50, 50 }, 8), std::nullopt);
}

TEST(CostPlot, DescriptionsNameThePointAndTheDifference) {
    const std::vector<MeasuredSetting> points{ point(10, 0.02, "as it is"), point(12, 0.01, "shadows=pcf5") };
    EXPECT_EQ(describe(points, 0), "as it is: 10.0 ms, error 2 %");
    EXPECT_EQ(describe(points, 1), "shadows=pcf5: 12.0 ms, error 1 %\n+2.00 ms, error -1 % against 'as it is'");
    EXPECT_EQ(describe(std::vector<MeasuredSetting>{ { .setting = { .name = "x" } } }, 0), "x: not measured yet");
}

} // namespace
} // namespace filament_core::view
