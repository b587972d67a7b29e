// SPDX-License-Identifier: Apache-2.0
// The budget's choice compared with all combinations, its rules for ties and limits, and compared with presets. No
// device.
#include <filament_core/Options.h>
#include <filament_core/QualityBudget.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

namespace filament_core {
namespace {

constexpr double kFrame = 8; // milliseconds of a frame of defaults: eighths of it are exact numbers

QualityCost cost(std::string value, double error, double milliseconds) {
    const QualityCost::Time time{ milliseconds, milliseconds / kFrame, milliseconds / kFrame };
    return { .value = std::move(value), .error = error, .vulkan = time, .gles = time };
}

QualityCosts tableOf(std::vector<QualityEffect> effects) {
    return { .machine = "test", .driver = "test", .commit = "", .size = { 100, 100 }, .effects = std::move(effects) };
}

QualityBudget budgetOf(double milliseconds) { return { .gpuMilliseconds = milliseconds, .size = { 100, 100 } }; }

/// Three choices with clear prices: look-ups are cheap and save much, filters are expensive.
QualityCosts smallTable() {
    return tableOf(
            { { "energyCompensation", { cost("off", 0.5, 7), cost("on", 0, kFrame) } },
              { "anisotropicLookUps", { cost("one", 0.25, 7), cost("three", 0.125, 7.5), cost("five", 0, kFrame) } },
              { "textureFilter", { cost("asAuthored", 0.75, kFrame), cost("anisotropic", 0, 16) } } });
}

/// Random prices and errors that are exact in binary, often equal, with defaults where they belong.
QualityCosts randomTable(std::mt19937& random) {
    std::vector<QualityEffect> effects;
    for (const char* name : { "specularVisibility", "splitSum", "dfgTableSize", "diffuseIrradiance", "shBands" }) {
        if (random() % 4 == 0) continue;
        const auto choice = std::ranges::find(optionsOf<Quality>(), std::string_view(name), &Option::name);
        const std::string standard = *optionValue(Quality{}, name);
        QualityEffect effect{ .name = name, .values = {} };
        for (const std::string_view value : choice->values) {
            const double milliseconds = value == standard ? kFrame : 4 + static_cast<double>(random() % 8);
            effect.values.push_back(cost(std::string(value), static_cast<double>(random() % 6) / 16, milliseconds));
        }
        effects.push_back(std::move(effect));
    }
    if (effects.empty()) effects.push_back({ "fresnel", { cost("schlick", 0.25, kFrame), cost("exact", 0, 9) } });
    return tableOf(std::move(effects));
}

struct Combination {
    double squaredError = 0, milliseconds = kFrame;
    int changes = 0;
    Quality quality{};
    auto key() const { return std::tie(squaredError, milliseconds, changes); }
};

/// Tries every combination of all values.
void visitAll(QualityCosts const& costs, size_t effect, Quality const& quality, std::vector<Combination>& all) {
    if (effect < costs.effects.size()) {
        for (QualityCost const& value : costs.effects[effect].values) {
            Quality next = quality;
            EXPECT_TRUE(setOption(next, costs.effects[effect].name, value.value));
            visitAll(costs, effect + 1, next, all);
        }
        return;
    }
    Combination combination{ .quality = quality };
    for (QualityEffect const& rated : costs.effects) {
        if (rated.name == "dfgTableSize" && quality.splitSum != SplitSum::Table) continue;
        if (rated.name == "shBands" && quality.diffuseIrradiance != DiffuseIrradiance::SphericalHarmonics) continue;
        const std::string has = *optionValue(quality, rated.name);
        const auto value = std::ranges::find(rated.values, has, &QualityCost::value);
        combination.squaredError += value->error * value->error;
        combination.milliseconds += value->vulkan.milliseconds - kFrame;
        combination.changes += has != *optionValue(Quality{}, rated.name);
    }
    all.push_back(combination);
}

Combination bestOf(std::vector<Combination> const& all, double budget) {
    const auto better = [](Combination const& a, Combination const& b) { return a.key() < b.key(); };
    std::vector<Combination> fitting;
    std::ranges::copy_if(all, std::back_inserter(fitting),
                         [&](Combination const& c) { return c.milliseconds <= budget; });
    if (!fitting.empty()) return *std::ranges::min_element(fitting, better);
    return *std::ranges::min_element(all, [](Combination const& a, Combination const& b) {
        return std::tie(a.milliseconds, a.squaredError, a.changes) <
               std::tie(b.milliseconds, b.squaredError, b.changes);
    });
}

TEST(QualityBudget, TheChoiceIsTheBestOfAllCombinations) {
    std::mt19937 random(1);
    for (int table = 0; table < 200; ++table) {
        const QualityCosts costs = randomTable(random);
        std::vector<Combination> all;
        visitAll(costs, 0, {}, all);
        for (double budget = 0.5; budget < 20; budget += 0.5) {
            const Result<QualityDecision> decision = chooseQuality(budgetOf(budget), costs);
            ASSERT_TRUE(decision) << decision.error().message;
            const Combination best = bestOf(all, budget);
            ASSERT_EQ(decision->fits, best.milliseconds <= budget);
            ASSERT_NEAR(decision->predicted.error, std::sqrt(best.squaredError), 1e-6) << toJson(costs);
            ASSERT_EQ(decision->predicted.milliseconds, std::max(best.milliseconds, 0.0)) << toJson(costs);
            const auto same = std::ranges::count_if(all, [&](Combination const& c) { return c.key() == best.key(); });
            if (same == 1) {
                ASSERT_EQ(toString(decision->quality), toString(best.quality)) << toJson(costs);
            }
        }
    }
}

TEST(QualityBudget, MoreTimeIsNeverWorse) {
    double last = 1e9;
    for (double budget = 1; budget < 1000; budget *= 1.01) {
        const Result<QualityDecision> decision = chooseQuality({ .gpuMilliseconds = budget, .size = { 640, 360 } });
        ASSERT_TRUE(decision);
        EXPECT_LE(decision->predicted.error, last);
        if (decision->fits) {
            EXPECT_LE(decision->predicted.milliseconds, budget);
        }
        last = decision->predicted.error;
    }
    double squares = 0;
    for (QualityEffect const& effect : defaultQualityCosts().effects)
        squares += std::pow(std::ranges::min(effect.values, {}, &QualityCost::error).error, 2);
    EXPECT_LE(last, std::sqrt(squares) + 1e-5) << "enough time buys everything";
}

TEST(QualityBudget, NoPresetOfTheSameTimeIsBetter) {
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        for (const QualityPreset preset :
             { QualityPreset::Low, QualityPreset::Medium, QualityPreset::High, QualityPreset::Reference }) {
            QualityBudget budget{ .gpuMilliseconds = 1, .size = { 640, 360 }, .backend = backend };
            const Result<QualityPrediction> predicted = predictQuality(qualityPreset(preset), budget);
            ASSERT_TRUE(predicted) << predicted.error().message;
            budget.gpuMilliseconds = predicted->milliseconds;
            const Result<QualityDecision> decision = chooseQuality(budget);
            ASSERT_TRUE(decision);
            EXPECT_TRUE(decision->fits);
            EXPECT_LE(decision->predicted.error, predicted->error) << toString(preset);
            EXPECT_LE(decision->predicted.milliseconds, predicted->milliseconds) << toString(preset);
        }
    }
}

TEST(QualityBudget, WhatIsChosenIsPredictedAsPromised) {
    for (double milliseconds = 2; milliseconds < 100; milliseconds *= 1.3) {
        const QualityBudget budget{ .gpuMilliseconds = milliseconds, .size = { 640, 360 } };
        const Result<QualityDecision> decision = chooseQuality(budget);
        ASSERT_TRUE(decision);
        const Result<QualityPrediction> predicted = predictQuality(decision->quality, budget);
        ASSERT_TRUE(predicted);
        EXPECT_EQ(predicted->milliseconds, decision->predicted.milliseconds);
        EXPECT_EQ(predicted->error, decision->predicted.error);
    }
}

TEST(QualityBudget, StepsLeadFromTheCheapestToTheChosenSettingAndThenToTheNext) {
    const Result<QualityDecision> decision = chooseQuality(budgetOf(8), smallTable());
    ASSERT_TRUE(decision);
    EXPECT_EQ(toString(decision->quality), "default");
    EXPECT_EQ(decision->predicted.milliseconds, 8);
    EXPECT_EQ(decision->predicted.error, 0.75);
    ASSERT_EQ(decision->steps.size(), 2u) << "from off and one look-up";
    EXPECT_EQ(decision->steps[0].name, "energyCompensation") << "0.25 for 1 ms comes before 0.0625 for 1 ms";
    EXPECT_EQ(decision->steps[0].from, "off");
    EXPECT_EQ(decision->steps[0].to, "on");
    EXPECT_EQ(decision->steps[0].milliseconds, 1);
    EXPECT_EQ(decision->steps[1].name, "anisotropicLookUps");
    EXPECT_EQ(decision->steps[1].errorBefore, decision->steps[0].errorAfter);
    EXPECT_EQ(decision->steps[1].errorAfter, 0.75);
    ASSERT_EQ(decision->nextSteps.size(), 3u) << "the filter for 8 ms, and 2 ms sold: less error for 6 ms";
    EXPECT_EQ(decision->nextSteps[0].name, "textureFilter");
    EXPECT_EQ(decision->nextSteps[0].milliseconds, 8);
    EXPECT_EQ(decision->nextSteps[1].milliseconds + decision->nextSteps[2].milliseconds, -2);
    EXPECT_EQ(decision->next.error, std::sqrt(0.25 + 0.0625));
    EXPECT_EQ(decision->next.milliseconds, 14);
}

TEST(QualityBudget, TheExplanationNamesWhatWasBoughtAndWhatTheNextStepCosts) {
    const Result<QualityDecision> decision = chooseQuality(budgetOf(7), smallTable());
    ASSERT_TRUE(decision);
    for (const char* text :
         { "budget 7.000 ms for 100 x 100 on ", "predicted 7.000 ms", "setting: anisotropicLookUps=one",
           "cheapest setting: 6.000 ms", "+1.000 ms  energyCompensation off -> on", "next better setting: 7.500 ms",
           "+0.500 ms  anisotropicLookUps one -> three" }) {
        EXPECT_NE(decision->explanation.find(text), std::string::npos) << text << " in\n" << decision->explanation;
    }
    const Result<QualityDecision> rich = chooseQuality(budgetOf(1000), smallTable());
    ASSERT_TRUE(rich);
    EXPECT_TRUE(rich->nextSteps.empty());
    EXPECT_NE(rich->explanation.find("nothing better"), std::string::npos) << rich->explanation;
}

TEST(QualityBudget, TooSmallABudgetGivesTheCheapestSettingAndSaysSo) {
    const Result<QualityDecision> decision = chooseQuality(budgetOf(5), smallTable());
    ASSERT_TRUE(decision);
    EXPECT_FALSE(decision->fits);
    EXPECT_EQ(toString(decision->quality), "energyCompensation=off anisotropicLookUps=one");
    EXPECT_NE(decision->explanation.find("over the budget"), std::string::npos) << decision->explanation;
}

TEST(QualityBudget, ATimeThatMayBeNoiseIsNotSavedOrSpent) {
    QualityCosts costs = tableOf({ { "cameraRelative", { cost("off", 0, 7.75), cost("on", 0, kFrame) } } });
    EXPECT_FALSE(chooseQuality(budgetOf(7.75), costs)->quality.cameraRelative);
    costs.effects[0].values[0].vulkan.highRatio = 1.01;
    const Result<QualityDecision> decision = chooseQuality(budgetOf(7.75), costs);
    ASSERT_TRUE(decision);
    EXPECT_TRUE(decision->quality.cameraRelative) << "as fast and as exact: the default stays";
    EXPECT_EQ(decision->predicted.milliseconds, kFrame);
}

TEST(QualityBudget, TheTablesTimesAreScaledByPixelsAndByTheFrameThatWasMeasured) {
    QualityBudget budget{ .gpuMilliseconds = 1000, .size = { 200, 100 } };
    EXPECT_EQ(predictQuality({}, budget, smallTable())->milliseconds, 16);
    budget.frameMilliseconds = 4;
    EXPECT_EQ(predictQuality({}, budget, smallTable())->milliseconds, 4);
    Quality filtered;
    filtered.textureFilter = TextureFilter::Anisotropic;
    EXPECT_EQ(predictQuality(filtered, budget, smallTable())->milliseconds, 8) << "twice a frame, as in the table";
}

TEST(QualityBudget, WhatTheTableDoesNotRateStaysAsItWas) {
    Quality start;
    start.fresnel = FresnelTerm::Exact;
    start.splitSum = SplitSum::Analytic;
    const Result<QualityDecision> decision = chooseQuality(budgetOf(1000), smallTable(), start);
    ASSERT_TRUE(decision);
    EXPECT_EQ(toString(decision->quality), "fresnel=exact splitSum=analytic textureFilter=anisotropic");
    Quality unrated;
    unrated.textureFilter = TextureFilter::Bilinear;
    const Result<QualityPrediction> predicted = predictQuality(unrated, budgetOf(1), smallTable());
    ASSERT_FALSE(predicted);
    EXPECT_NE(predicted.error().message.find("does not rate textureFilter=bilinear"), std::string::npos);
}

TEST(QualityBudget, ASizeThatTheTableDoesNotNeedCostsNothingAndKeepsItsDefault) {
    const QualityCosts costs =
            tableOf({ { "splitSum", { cost("table", 0.5, kFrame), cost("analytic", 0, 7) } },
                      { "dfgTableSize", { cost("16", 0, 7), cost("64", 0.25, kFrame), cost("256", 0, 9) } } });
    const Result<QualityDecision> decision = chooseQuality(budgetOf(1000), costs);
    ASSERT_TRUE(decision);
    EXPECT_EQ(toString(decision->quality), "splitSum=analytic");
    EXPECT_EQ(decision->predicted.milliseconds, 7);
}

TEST(QualityBudget, InvalidBudgetsAreRejectedInOneLine) {
    for (const double bad : { 0.0, -1.0, double(NAN), double(INFINITY) }) EXPECT_FALSE(chooseQuality(budgetOf(bad)));
    EXPECT_FALSE(chooseQuality({ .gpuMilliseconds = 1, .size = { 0, 4 } }));
    EXPECT_FALSE(chooseQuality({ .gpuMilliseconds = 1, .frameMilliseconds = NAN }));
    QualityCosts costs = smallTable();
    for (QualityEffect& effect : costs.effects) {
        for (QualityCost& value : effect.values) value.gles = {};
    }
    const Result<QualityDecision> untimed = chooseQuality({ .gpuMilliseconds = 1, .backend = Backend::Gles }, costs);
    ASSERT_FALSE(untimed);
    EXPECT_EQ(untimed.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(untimed.error().message.find("has no times for"), std::string::npos) << untimed.error().message;
}

} // namespace
} // namespace filament_core
