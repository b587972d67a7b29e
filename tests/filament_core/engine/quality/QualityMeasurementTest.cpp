// SPDX-License-Identifier: Apache-2.0
// A cost table measured by the test, its predictions for settings that it does not contain, and the budget that uses
// it. Times are ratios to frames drawn in turns with them, so that other work on the machine slows both; a disturbed
// round is measured again.
#include "tests/filament_core/engine/quality/QualityFixture.h"

#include <filament/QualityBudget.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fmt/format.h>

namespace filament {
namespace {

/// A textured floor up to the horizon, lit by a sun and an environment: every choice affects every pixel.
class Floor {
public:
    explicit Floor(Engine& engine) : mTexture(checker(engine)), mPatch(engine, 80, textured()) {
        mPatch.setSurface({ 0.9f, 0.6f, 0.3f, 1 }, 0.5f, 0.5f);
        EXPECT_TRUE(engine.set(mPatch.instance(), "baseColorMap", mTexture,
                               Sampler{ Filter::Nearest, Filter::Linear, MipFilter::Linear, WrapMode::ClampToEdge,
                                        WrapMode::ClampToEdge }));
        mPatch.addSun({ 0, 0, 1 });
        mPatch.addEnvironment({ float4(0.5f), float4(0.1f), float4(0.3f), float4(0.2f), float4(0.1f) }, 5);
        mPatch.view.size = { 192, 192 };
    }
    Scene& scene() { return mPatch.scene; }
    View& view() { return mPatch.view; }

private:
    static MaterialDesc textured() {
        return { .package = shader::engineMaterial("gltf_lit_opaque"), .constants = { { "hasBaseColorMap", true } } };
    }
    static Owned<Texture> checker(Engine& engine) {
        std::vector<uint8_t> texels;
        for (uint32_t side = 512; side > 0; side /= 2) {
            for (uint32_t i = 0; i < side * side; ++i) {
                const bool isWhite = side > 1 && ((i / side + i) & 1) != 0;
                const auto value = static_cast<uint8_t>(side == 512 ? (isWhite ? 255 : 20) : 138);
                texels.insert(texels.end(), { value, value, value, uint8_t{ 255 } });
            }
        }
        return engine.own(engine.create(
                TextureDesc{ .width = 512, .height = 512, .levels = 10, .pixels = std::as_bytes(std::span(texels)) }));
    }

    Owned<Texture> mTexture;
    test::Patch mPatch;
};

class QualityMeasurementTest : public testing::TestWithParam<Backend> {
protected:
    static constexpr int kAttempts = 8; // other work on the machine may last for minutes

    /// Ratio of the frame times of `quality` to those of the defaults, drawn in turns: the median of the faster half of
    /// the rounds. Measures processor time, because the devices of these tests run on the processor.
    static double ratioToDefault(Engine& engine, Floor& floor, Quality const& quality) {
        Renderer renderer(engine, { .passTimers = true });
        const Owned<SwapChain> target =
                engine.own(engine.create(SwapChainDesc{ .size = floor.view().size, .imageCount = 1 }));
        const auto milliseconds = [&](Quality const& drawn) {
            floor.view().quality = drawn;
            const std::clock_t before = std::clock();
            renderer.render(floor.scene(), floor.view(), target);
            engine.waitIdle();
            return static_cast<double>(std::clock() - before) * 1000 / CLOCKS_PER_SEC;
        };
        milliseconds(quality), milliseconds({});
        std::vector<std::pair<double, double>> rounds; // both together, and their ratio
        for (int round = 0; round < 31; ++round) {
            const double chosen = milliseconds(quality), standard = milliseconds({});
            rounds.emplace_back(chosen + standard, chosen / standard);
        }
        floor.view().quality = {};
        std::ranges::sort(rounds);
        rounds.resize(15);
        std::ranges::nth_element(rounds, rounds.begin() + 7, {}, &std::pair<double, double>::second);
        return rounds[7].second;
    }
};

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

/// The preset with the default's look-ups: on a slanted metal, one look-up gives too much light where missing
/// compensation gives too little, and a sum of squares does not know what cancels.
Quality presetOf(QualityPreset preset) {
    Quality quality = qualityPreset(preset);
    quality.specularLookUps = Quality{}.specularLookUps;
    return quality;
}

/// The other choices in which presets differ.
const CostMeasurement kMeasurement{ .rounds = 31,
                                    .choices = { "specularVisibility", "fresnel", "energyCompensation", "splitSum",
                                                 "dfgTableSize", "diffuseIrradiance", "shBands", "textureFilter" } };
constexpr QualityPreset kPresets[] = { QualityPreset::Low, QualityPreset::High, QualityPreset::Reference };

TEST_P(QualityMeasurementTest, ErrorsAreThoseOfThePicturesAndTheMostExactValueHasNone) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Floor floor(*engine);
    const Result<QualityCosts> costs =
            measureQualityCosts(*engine, floor.scene(), floor.view(), { .rounds = 15, .choices = { "textureFilter" } });
    ASSERT_TRUE(costs) << costs.error().message;
    floor.view().quality = qualityPreset(QualityPreset::Reference);
    const Image exact = test::renderLinear(*engine, floor.scene(), floor.view());
    for (QualityCost const& cost : costs->effects[0].values) {
        ASSERT_TRUE(setQuality(floor.view().quality, "textureFilter", cost.value));
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
    Floor floor(*engine);
    EXPECT_FALSE(measureQualityCosts(*engine, floor.scene(), floor.view(), { .rounds = 14 }));
    const Result<QualityCosts> costs =
            measureQualityCosts(*engine, floor.scene(), floor.view(), { .choices = { "textureFilters" } });
    ASSERT_FALSE(costs);
    EXPECT_NE(costs.error().message.find("did you mean 'textureFilter'?"), std::string::npos) << costs.error().message;
}

/// Uses the cost of a preset as the budget.
QualityDecision buyFor(QualityPreset preset, Backend backend, QualityCosts const& costs, double& milliseconds) {
    QualityBudget budget{ .gpuMilliseconds = 1, .size = costs.size, .backend = backend };
    const Result<QualityPrediction> predicted = predictQuality(presetOf(preset), budget, costs);
    EXPECT_TRUE(predicted) << predicted.error().message;
    milliseconds = budget.gpuMilliseconds = predicted->milliseconds;
    return *chooseQuality(budget, costs);
}

/// Milliseconds by which the table may be wrong about a setting, as its own intervals say: a disturbed machine has wide
/// ones.
double uncertaintyOf(Quality const& quality, QualityCosts const& costs, Backend backend) {
    double ratios = 0;
    for (QualityEffect const& effect : costs.effects) {
        const auto cost = std::ranges::find(effect.values, *qualityValue(quality, effect.name), &QualityCost::value);
        if (cost != effect.values.end()) ratios += (cost->on(backend).highRatio - cost->on(backend).lowRatio) / 2;
    }
    return ratios * costs.frameMilliseconds(backend);
}

/// The errors of choices are added as squares, but on this floor some of them cancel in part.
constexpr double kErrorOfPredictedErrors = 1.25;

TEST_P(QualityMeasurementTest, WhatABudgetBuysTakesItWithinTenPercentAndIsNoWorseThanThePreset) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Floor floor(*engine);
    const auto pictureOf = [&](Quality const& quality) {
        floor.view().quality = quality;
        return test::renderLinear(*engine, floor.scene(), floor.view());
    };
    const Image exact = pictureOf(presetOf(QualityPreset::Reference));
    std::string missed = "never measured";
    for (int attempt = 0; attempt < kAttempts && !missed.empty(); ++attempt) {
        missed.clear();
        floor.view().quality = {};
        const Result<QualityCosts> costs = measureQualityCosts(*engine, floor.scene(), floor.view(), kMeasurement);
        ASSERT_TRUE(costs) << costs.error().message;
        for (const QualityPreset preset : kPresets) {
            double budget = 0;
            const QualityDecision bought = buyFor(preset, GetParam(), *costs, budget);
            const double error = errorOf(pictureOf(bought.quality), exact);
            const double presetError = errorOf(pictureOf(presetOf(preset)), exact);
            const double measured =
                    ratioToDefault(*engine, floor, bought.quality) * costs->frameMilliseconds(GetParam());
            const double deviation = 0.1 * budget + uncertaintyOf(bought.quality, *costs, GetParam());
            const bool keepsBudget =
                    measured <= budget + deviation && measured >= bought.predicted.milliseconds - deviation;
            if (keepsBudget && error <= kErrorOfPredictedErrors * presetError) continue;
            missed += fmt::format("{}: measured {} ms, allowed {} ms more or less, error {} (the preset's: {})\n{}",
                                  toString(preset), measured, deviation, error, presetError, bought.explanation);
        }
    }
    EXPECT_EQ(missed, "") << kAttempts << " times";
    test::expectNoErrors(*engine);
}

INSTANTIATE_TEST_SUITE_P(BothApis, QualityMeasurementTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament
