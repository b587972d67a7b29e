// SPDX-License-Identifier: Apache-2.0
// Settings are timed and compared beside the viewer: all of them, in turns, against the right reference, until
// cancelled.
#include "tools/view/app/CostMeasurement.h"
#include "tests/tools/view/app/TestScene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

namespace filament_core::view {
namespace {

constexpr uint2 kMeasuredSize{ 96, 54 };

/// Polls until it is over, at most five minutes.
CostPlot waitFor(CostMeasurement& measurement) {
    CostPlot plot;
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    while (measurement.isBusy() && std::chrono::steady_clock::now() < end) letOthersWork();
    EXPECT_FALSE(measurement.isBusy());
    (void)measurement.poll(plot);
    return plot;
}

/// Until so many steps are done.
void pollUntil(CostMeasurement& measurement, CostPlot& plot, uint32_t done) {
    while (measurement.isBusy() && plot.done < done) {
        (void)measurement.poll(plot);
        letOthersWork();
    }
}

QualitySetting withSetting(Document const& document, std::string_view name, std::string_view value) {
    QualitySetting setting{ std::string(name), document.view.quality, document.view.samples };
    EXPECT_TRUE(setOption(setting.quality, name, value));
    return setting;
}

CostMeasurementOptions optionsFor(Backend backend, std::vector<QualitySetting> settings = {}) {
    return { .engine = { .backend = backend, .workers = 1, .validation = true },
             .rounds = 3,
             .settings = std::move(settings) };
}

TEST(CostMeasurement, MeasuresEverySettingInEveryRound) {
    const Document document = showcaseDocument(kMeasuredSize);
    CostMeasurement measurement;
    EXPECT_FALSE(measurement.isBusy());
    measurement.start(document, optionsFor(Backend::Null));
    EXPECT_TRUE(measurement.isBusy());
    const CostPlot plot = waitFor(measurement);
    ASSERT_EQ(plot.state, CostPlot::State::Finished) << plot.error;
    EXPECT_EQ(plot.points.size(), settingsToMeasure(document.view).size());
    EXPECT_EQ(plot.done, plot.total);
    for (MeasuredSetting const& point : plot.points) {
        EXPECT_EQ(point.rounds, 3u) << point.setting.name;
        EXPECT_TRUE(point.isMeasured()) << point.setting.name;
        EXPECT_GT(point.milliseconds, 0) << point.setting.name;
    }
    CostPlot again;
    EXPECT_FALSE(measurement.poll(again)) << "nothing is new";
}

class CostMeasurementApis : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, CostMeasurementApis, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& api) { return std::string(toString(api.param)); });

TEST_P(CostMeasurementApis, WhatIsNearerTheMostExactHasTheSmallerError) {
    Document document = showcaseDocument(kMeasuredSize);
    QualitySetting exact{ "exact", qualityPreset(QualityPreset::Reference), 1 };
    exact.quality.antiAliasing = AntiAliasing::Taa;
    CostMeasurement measurement;
    measurement.start(document, optionsFor(GetParam(), { { "low", qualityPreset(QualityPreset::Low), 1 }, exact }));
    const CostPlot plot = waitFor(measurement);
    ASSERT_EQ(plot.state, CostPlot::State::Finished) << plot.error;
    ASSERT_EQ(plot.points.size(), 2u);
    EXPECT_EQ(plot.reference, "the most exact setting");
    EXPECT_EQ(plot.clock, "device time");
    EXPECT_THAT(plot.device, testing::StartsWith(toString(GetParam())));
    EXPECT_GT(*plot.points[0].error, 2 * *plot.points[1].error) << "what is left is the number of gathered frames";
    EXPECT_GT(plot.points[0].milliseconds, 0);
}

TEST_P(CostMeasurementApis, AGivenReferenceIsTheOneThatErrorsAreFrom) {
    const Document document = showcaseDocument(kMeasuredSize);
    const QualitySetting now{ "as it is", document.view.quality, document.view.samples };
    CostMeasurementOptions options = optionsFor(GetParam(), { now, withSetting(document, "diffuse", "disney") });
    Image black{ .width = kMeasuredSize.x,
                 .height = kMeasuredSize.y,
                 .pixels = std::vector<std::byte>(size_t{ 4 } * kMeasuredSize.x * kMeasuredSize.y) };
    options.reference = { black, "black" };
    CostMeasurement measurement;
    measurement.start(document, options);
    CostPlot plot = waitFor(measurement);
    ASSERT_EQ(plot.state, CostPlot::State::Finished) << plot.error;
    EXPECT_EQ(plot.reference, "black");
    EXPECT_GT(*plot.points[0].error, 0.1) << "the sky is not black";

    options.reference = { Image{ .width = 1, .height = 1, .pixels = std::vector<std::byte>(4) }, "of another size" };
    measurement.start(document, options);
    plot = waitFor(measurement);
    EXPECT_EQ(plot.reference, "the most exact setting");
    EXPECT_LT(*plot.points[0].error, 0.1);
}

TEST(CostMeasurement, EndsWhenItIsCancelledAndKeepsWhatThereIs) {
    const Document document = showcaseDocument(kMeasuredSize);
    CostMeasurementOptions options = optionsFor(Backend::Null);
    options.rounds = 1000;
    CostMeasurement measurement;
    measurement.start(document, options);
    CostPlot plot;
    pollUntil(measurement, plot, 1);
    measurement.cancel();
    plot = waitFor(measurement);
    EXPECT_EQ(plot.state, CostPlot::State::Cancelled);
    EXPECT_GT(plot.done, 0u);
    EXPECT_LT(plot.done, plot.total);
    measurement.start(document, optionsFor(Backend::Null, { withSetting(document, "diffuse", "disney") }));
    EXPECT_EQ(waitFor(measurement).state, CostPlot::State::Finished) << "another one may begin";
}

TEST(CostMeasurement, SaysWhyItCannot) {
    Document document = showcaseDocument(kMeasuredSize);
    document.model.file = "/nowhere/model.glb";
    CostMeasurement measurement;
    measurement.start(document, optionsFor(Backend::Null));
    const CostPlot plot = waitFor(measurement);
    EXPECT_EQ(plot.state, CostPlot::State::Failed);
    EXPECT_THAT(plot.error, testing::HasSubstr("/nowhere/model.glb"));
}

TEST(CostMeasurement, ItsEndDoesNotWaitForTheLastRound) {
    CostMeasurementOptions options = optionsFor(Backend::Null);
    options.rounds = 1000;
    const auto begin = std::chrono::steady_clock::now();
    const auto secondsSince = [](auto time) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
    };
    std::optional<CostMeasurement> measurement(std::in_place);
    measurement->start(showcaseDocument(kMeasuredSize), options);
    CostPlot plot;
    pollUntil(*measurement, plot, 20);
    ASSERT_LT(plot.done, plot.total / 100) << plot.error;
    const double soFar = secondsSince(begin);
    const auto end = std::chrono::steady_clock::now();
    measurement.reset();
    EXPECT_LT(secondsSince(end), soFar + 1) << plot.done << " of " << plot.total << " steps took " << soFar << " s";
}

} // namespace
} // namespace filament_core::view
