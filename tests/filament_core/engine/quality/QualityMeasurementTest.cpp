// SPDX-License-Identifier: Apache-2.0
// A cost table measured by the test, its errors, and the budget that uses it.
#include "tests/filament_core/engine/quality/MeasuredFloor.h"

#include <cmath>

namespace filament_core {
namespace {

class QualityMeasurementTest : public testing::TestWithParam<Backend> {};

double luminance(Image const& image, uint32_t x, uint32_t y) {
    return static_cast<double>(glm::dot(float3(test::halfPixel(image, x, y)), float3(0.2126f, 0.7152f, 0.0722f)));
}

double errorOf(Image const& image, Image const& exact) {
    double mean = 0, sum = 0;
    const double count = double(exact.width) * exact.height;
    for (uint32_t y = 0; y < exact.height; ++y)
        for (uint32_t x = 0; x < exact.width; ++x) mean += luminance(exact, x, y) / count;
    for (uint32_t y = 0; y < exact.height; ++y) {
        for (uint32_t x = 0; x < exact.width; ++x) {
            const double truth = luminance(exact, x, y);
            sum += std::pow((luminance(image, x, y) - truth) / (truth + mean / 100), 2);
        }
    }
    return std::sqrt(sum / count);
}

/// The fewest rounds of small images: only errors are looked at, and times only have to be some.
constexpr uint32_t kRounds = 15;
constexpr uint2 kSize{ 96, 96 };
constexpr QualityPreset kPresets[] = { QualityPreset::Low, QualityPreset::High, QualityPreset::Reference };

TEST_P(QualityMeasurementTest, ErrorsAreThoseOfThePicturesAndTheMostExactValueHasNone) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    test::Floor floor(*engine);
    floor.view().size = kSize;
    const Result<QualityCosts> costs = measureQualityCosts(*engine, floor.scene(), floor.view(),
                                                           { .rounds = kRounds, .choices = { "textureFilter" } });
    ASSERT_TRUE(costs) << costs.error().message;
    floor.view().quality = qualityPreset(QualityPreset::Reference);
    const Image exact = test::renderLinear(*engine, floor.scene(), floor.view());
    for (QualityCost const& cost : costs->effects[0].values) {
        ASSERT_TRUE(setOption(floor.view().quality, "textureFilter", cost.value));
        const Image image = test::renderLinear(*engine, floor.scene(), floor.view());
        EXPECT_NEAR(cost.error, errorOf(image, exact), 1e-6) << cost.value;
        EXPECT_EQ(cost.error == 0, cost.value == "anisotropic");
        EXPECT_GT(cost.on(GetParam()).milliseconds, 0);
        EXPECT_LE(cost.on(GetParam()).lowRatio, cost.on(GetParam()).highRatio);
    }
    const Result<QualityCosts> read = readQualityCosts(toJson(*costs), "measured");
    EXPECT_TRUE(read) << read.error().message;
    test::expectNoErrors(*engine);
}

TEST_P(QualityMeasurementTest, AnUnknownChoiceOrTooFewRoundsAreRefused) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    test::Floor floor(*engine);
    floor.view().size = kSize;
    EXPECT_FALSE(measureQualityCosts(*engine, floor.scene(), floor.view(), { .rounds = kRounds - 1 }));
    const Result<QualityCosts> costs =
            measureQualityCosts(*engine, floor.scene(), floor.view(), { .choices = { "textureFilters" } });
    ASSERT_FALSE(costs);
    EXPECT_NE(costs.error().message.find("did you mean 'textureFilter'?"), std::string::npos) << costs.error().message;
}

/// The errors of choices are added as squares, but on this floor some of them cancel in part.
constexpr double kErrorOfPredictedErrors = 1.25;

// quality_bench compares the predicted times with measured ones.
TEST_P(QualityMeasurementTest, WhatABudgetBuysIsPredictedToKeepItAndIsNoWorseThanThePreset) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    test::Floor floor(*engine);
    floor.view().size = kSize;
    const auto pictureOf = [&](Quality const& quality) {
        floor.view().quality = quality;
        return test::renderLinear(*engine, floor.scene(), floor.view());
    };
    const Image exact = pictureOf(test::presetOfFloor(QualityPreset::Reference));
    floor.view().quality = {};
    const Result<QualityCosts> costs =
            measureQualityCosts(*engine, floor.scene(), floor.view(), test::measurementOfPresets(kRounds));
    ASSERT_TRUE(costs) << costs.error().message;
    for (const QualityPreset preset : kPresets) {
        const test::Bought bought = test::buyForPreset(preset, GetParam(), *costs);
        EXPECT_TRUE(bought.decision.fits) << bought.decision.explanation;
        EXPECT_LE(bought.decision.predicted.milliseconds, bought.milliseconds) << bought.decision.explanation;
        EXPECT_LE(errorOf(pictureOf(bought.decision.quality), exact),
                  kErrorOfPredictedErrors * errorOf(pictureOf(test::presetOfFloor(preset)), exact))
                << toString(preset) << "\n"
                << bought.decision.explanation;
    }
    test::expectNoErrors(*engine);
}

INSTANTIATE_TEST_SUITE_P(BothApis, QualityMeasurementTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
