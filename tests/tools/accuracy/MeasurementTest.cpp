// SPDX-License-Identifier: Apache-2.0
// Small images of real rows, on both APIs.
#include "toolkit/paths/Paths.h"
#include "tools/accuracy/Measure.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace filament_core::accuracy {
namespace {

const std::filesystem::path kFolder = tools::sourceDir() / "tools" / "accuracy";

Results measuredAll(std::vector<std::string> const& names, std::vector<Backend> backends) {
    const Result<std::vector<Effect>> effects = readEffects(kFolder / "effects.json");
    const Result<SceneLibrary> scenes = SceneLibrary::read(kFolder / "scenes");
    if (!effects || !scenes) return {};
    MeasureOptions options{ .backends = std::move(backends) };
    options.size = options.errorSize = { 96, 54 };
    options.rounds = 2, options.mostTraced = 1;
    options.frame = "sun-chart"; // one material: few pipelines
    options.folders = { tools::buildDir() / "accuracy-test", tools::assetDir() };
    double last = 0;
    const Result<Results> results = measure(*effects, names, *scenes, options, [&](std::string const&, double done) {
        EXPECT_GE(done, last);
        EXPECT_LE(done, 1.0);
        last = done;
    });
    EXPECT_TRUE(results) << results.error().message;
    return results ? *results : Results{};
}

EffectResult measured(std::string const& name, std::vector<Backend> backends) {
    const Results results = measuredAll({ name }, std::move(backends));
    return results.effects.size() == 1 ? results.effects.front() : EffectResult{};
}

TEST(Measurement, ExactMaskingIsNearestToThePathTracerAndEveryValueIsTimedOnBothBackends) {
    const EffectResult result = measured("specularVisibility", { Backend::Vulkan, Backend::Gles });
    ASSERT_EQ(result.values.size(), 3u);
    EXPECT_LT(result.values[0].own.rms, 0.01);  // correlated
    EXPECT_GT(result.values[1].own.rms, 0.02);  // fast
    EXPECT_GT(result.values[2].own.rms, 0.015); // uncorrelated
    EXPECT_EQ(result.values[0].frame.rms, 0.0); // it is the best value itself
    for (ValueResult const& value : result.values) {
        ASSERT_EQ(value.timings.size(), 2u);
        for (auto const& [backend, timing] : value.timings) {
            EXPECT_GT(timing.milliseconds.median, 0.0) << backend;
            EXPECT_GT(timing.ratio.median, 0.0) << backend;
        }
    }
}

/// Everything but the times.
std::string errorsOf(Results const& results) {
    tools::Json json = jsonOf(results);
    for (tools::Json& effect : json["effects"]) {
        for (tools::Json& value : effect["values"]) {
            for (const char* name : { "milliseconds", "millisecondsInterval", "ratio", "interval" }) value.erase(name);
        }
    }
    return json["effects"].dump(1);
}

// What --shard relies on.
TEST(Measurement, OfEachRowAloneHasTheErrorsOfAllTogether) {
    const std::vector<Backend> gles{ Backend::Gles };
    Results apart = measuredAll({ "energyCompensation" }, gles);
    const Results together = measuredAll({ "energyCompensation", "specularVisibility" }, gles),
                  second = measuredAll({ "specularVisibility" }, gles);
    apart.effects.insert(apart.effects.end(), second.effects.begin(), second.effects.end());
    EXPECT_EQ(together.effects.size(), 2u);
    EXPECT_EQ(errorsOf(apart), errorsOf(together));
}

TEST(Measurement, WhiteMetalsVanishInAFurnaceOnlyIfTheirEnergyIsGivenBack) {
    const EffectResult result = measured("energyCompensation", { Backend::Gles });
    ASSERT_EQ(result.values.size(), 2u);
    EXPECT_LT(result.values[0].own.rms, 0.001);
    EXPECT_GT(result.values[1].own.rms, 0.1);
}

TEST(Measurement, TheApisPartOnlyWithoutExactShaders) {
    const EffectResult result = measured("exact", { Backend::Vulkan, Backend::Gles });
    ASSERT_EQ(result.values.size(), 2u);
    EXPECT_EQ(result.values[0].own.max, 0.0); // on: the same bits
    EXPECT_GT(result.values[1].own.max, 0.0);
    EXPECT_LT(result.values[1].own.rms, 0.001);
}

TEST(Measurement, AnEffectThatNeedsTwoBackendsIsSkippedWithOneAndSaysSo) {
    const Results results = measuredAll({ "exact" }, { Backend::Gles });
    EXPECT_TRUE(results.effects.empty());
    ASSERT_EQ(results.skipped.size(), 1u);
    EXPECT_EQ(results.skipped[0].reason, "two backends");
}

TEST(Measurement, AnUnknownEffectIsRefusedWithTheNearestName) {
    const Result<std::vector<Effect>> effects = readEffects(kFolder / "effects.json");
    const Result<SceneLibrary> scenes = SceneLibrary::read(kFolder / "scenes");
    ASSERT_TRUE(effects && scenes);
    const Result<Results> results = measure(*effects, { "frensel" }, *scenes, {}, [](std::string const&, double) {});
    ASSERT_FALSE(results);
    EXPECT_THAT(results.error().message, testing::HasSubstr("fresnel"));
}

} // namespace
} // namespace filament_core::accuracy
