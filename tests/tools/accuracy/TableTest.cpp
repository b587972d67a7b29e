// SPDX-License-Identifier: Apache-2.0
// The table of effects: committed rows can be measured, and errors are refused in one line.
#include "toolkit/paths/Paths.h"
#include "tools/accuracy/Effect.h"
#include "tools/accuracy/Integrals.h"
#include "tools/accuracy/Page.h"
#include "tools/accuracy/SceneLibrary.h"
#include "tools/accuracy/Settings.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace filament_core::accuracy {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::filesystem::path kEffectsFolder = tools::sourceDir() / "tools" / "accuracy";

Result<std::vector<Effect>> readText(std::string const& text) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "effects-of-a-test.json";
    std::ofstream(file) << text;
    return readEffects(file);
}

std::string messageOf(std::string const& text) {
    const Result<std::vector<Effect>> effects = readText(text);
    return effects ? "no error" : effects.error().message;
}

std::string rowWith(std::string const& more) {
    return R"([{"name": "n", "title": "t", "question": "q", "scene": "furnace")" + more + "}]";
}

TEST(EffectTable, TheCommittedTableHasAllItNeeds) {
    const Result<std::vector<Effect>> effects = readEffects(kEffectsFolder / "effects.json");
    ASSERT_TRUE(effects) << effects.error().message;
    EXPECT_GE(effects->size(), 15u);
    const Result<SceneLibrary> scenes = SceneLibrary::read(kEffectsFolder / "scenes");
    ASSERT_TRUE(scenes) << scenes.error().message;
    for (Effect const& effect : *effects) {
        for (std::string const& scene : { effect.scene, effect.frame, effect.reference.scene }) {
            if (scene.empty()) continue;
            const auto found = scenes->find(scene);
            EXPECT_TRUE(found) << effect.name << ": " << found.error().message;
        }
        EXPECT_EQ(effect.scene.empty(), effect.reference.kind == ReferenceKind::Integral) << effect.name;
    }
}

/// Approximations of shading, and how exactly effects are computed.
std::vector<Option> approximations() {
    const auto quality = optionsOf<Quality>();
    std::vector<Option> all(quality.begin(), quality.end());
    for (Option const& option : optionsOf<Effects>())
        if (option.kind != OptionKind::Switch && !option.values.empty()) all.push_back(option);
    return all;
}

TEST(EffectTable, EveryApproximationIsMeasured) {
    const Result<std::vector<Effect>> effects = readEffects(kEffectsFolder / "effects.json");
    ASSERT_TRUE(effects);
    for (Option const& choice : approximations()) {
        const std::string prefix = std::string(choice.name) + "=";
        const bool isMeasured = std::ranges::any_of(*effects, [&](Effect const& effect) {
            return std::ranges::any_of(effect.values, [&](Value const& value) {
                return std::ranges::any_of(value.set, [&](std::string const& w) { return w.starts_with(prefix); });
            });
        });
        EXPECT_TRUE(isMeasured) << choice.name << " has no row in effects.json";
    }
}

TEST(EffectTable, AWrongRowIsRefusedWithFieldAndCure) {
    EXPECT_THAT(messageOf(rowWith(R"(, "choice": "fresnell")")), HasSubstr("values"));
    EXPECT_THAT(messageOf(rowWith(R"(, "choice": "fresnel", "values": ["schlick", "exakt"])")),
                AllOf(HasSubstr("exakt"), HasSubstr("schlick or exact")));
    EXPECT_THAT(messageOf(rowWith(R"(, "choice": "fresnel", "best": "exakt")")), HasSubstr("none of the values"));
    EXPECT_THAT(messageOf(rowWith(R"(, "choice": "fresnel", "cost": "free")")),
                HasSubstr("frame, environment or model"));
    EXPECT_THAT(messageOf(rowWith(R"(, "choice": "fresnel", "qestion": "q")")), HasSubstr("question"));
    EXPECT_THAT(messageOf(rowWith(R"(, "choice": "fresnel", "reference": {"kind": "scene"})")), HasSubstr("scene"));
    EXPECT_THAT(messageOf("{}"), HasSubstr("not a JSON list"));
    EXPECT_THAT(messageOf("[1"), HasSubstr("no JSON text"));
    const std::string twice = rowWith(R"(, "choice": "fresnel")");
    EXPECT_THAT(messageOf("[" + twice.substr(1, twice.size() - 2) + "," + twice.substr(1)), HasSubstr("two effects"));
}

TEST(EffectTable, ARowOfSixLinesIsEnough) {
    const Result<std::vector<Effect>> effects = readText(rowWith(R"(, "choice": "fresnel")"));
    ASSERT_TRUE(effects) << effects.error().message;
    ASSERT_EQ(effects->front().values.size(), 2u);
    EXPECT_EQ(effects->front().values[1].set, std::vector<std::string>{ "fresnel=exact" });
}

TEST(EffectSettings, EveryValueWorthMeasuringIsAccepted) {
    for (const char* choice : { "samples", "toneMapper", "preset", "environment.samples", "environment.faceSize",
                                "environment.format", "environment.roughnessMapping", "model.positions", "bake.grid",
                                "bake.lightmap", "model.tangents", "budget", "exact", "dither", "shBands" }) {
        const std::vector<std::string> values = valuesOf(choice);
        EXPECT_GE(values.size(), 2u) << choice;
        for (std::string const& value : values) {
            Settings settings;
            EXPECT_TRUE(change(settings, std::string(choice) + "=" + value)) << choice << " " << value;
        }
    }
}

TEST(EffectSettings, WhatIsWrongIsNamedTogetherWithWhatWouldBeRight) {
    Settings settings;
    EXPECT_THAT(change(settings, "environment.facesize=64").error().message, HasSubstr("'faceSize'"));
    EXPECT_THAT(change(settings, "environment.faceSize=65").error().message, HasSubstr("16, 32, 64"));
    EXPECT_THAT(change(settings, "samples=3").error().message, HasSubstr("1 or 4"));
    EXPECT_THAT(change(settings, "samples").error().message, HasSubstr("NAME=VALUE"));
    EXPECT_THAT(change(settings, "shBands=9").error().message, HasSubstr("1, 2 or 3"));
}

TEST(EffectSettings, OnlyOptionsOfLoadingLoadAnotherFile) {
    Settings a, b;
    ASSERT_TRUE(change(a, "specularVisibility=fast"));
    EXPECT_TRUE(a.environmentKey.empty());
    ASSERT_TRUE(change(b, "environment.samples=64"));
    EXPECT_FALSE(b.environmentKey.empty());
    EXPECT_TRUE(b.modelKey.empty());
    EXPECT_EQ(b.environment.samples, 64u);
}

TEST(EffectIntegrals, ATableIsNearerToTheIntegralThanItsFitAndALargerOneNearerThanASmall) {
    jobs::JobSystem jobs;
    const auto errorOf = [&](const char* word) {
        Settings settings;
        EXPECT_TRUE(change(settings, word));
        const Result<ErrorFigures> error = integralError("directionalAlbedo", settings, jobs);
        EXPECT_TRUE(error) << error.error().message;
        return error ? error->rms : -1;
    };
    const double fit = errorOf("splitSum=analytic"), small = errorOf("dfgTableSize=16"),
                 large = errorOf("dfgTableSize=64");
    EXPECT_LT(large, 0.01);
    EXPECT_LT(large, small);
    EXPECT_LT(small, fit);
    EXPECT_THAT(integralError("directionalAlbedos", {}, jobs).error().message, HasSubstr("directionalAlbedo"));
}

Results exampleResults() {
    const Result<std::vector<Effect>> effects = readText(rowWith(R"(, "choice": "fresnel", "best": "exact")"));
    EffectResult result{ .effect = effects->front(),
                         .values = {},
                         .referenceError = 0.01,
                         .command = "build/release/bin/filament-accuracy --effect n" };
    result.effect.title = "a < b & c";
    for (Value const& value : effects->front().values) {
        ValueResult one{ .value = value, .own = { 0.1234567, 0.5, 0.01 }, .frame = { 0.01, 0.02, 0.03 } };
        one.timings["vulkan"] = { { 10, 9, 11 }, { 1, 1, 1 } };
        result.values.push_back(one);
    }
    return { .machine = "a machine",
             .commit = "abc1234",
             .date = "2000-01-01",
             .drivers = { { "vulkan", "driver 1" } },
             .size = { 64, 32 },
             .rounds = 3,
             .effects = { result },
             .skipped = { { "other", "asset:x.hdr" } } };
}

TEST(EffectReport, TheJsonHoldsWhatABudgetNeeds) {
    const nlohmann::ordered_json json = jsonOf(exampleResults());
    EXPECT_EQ(json["commit"], "abc1234");
    auto const& effect = json["effects"][0];
    EXPECT_EQ(effect["name"], "n");
    auto const& value = effect["values"][1];
    EXPECT_EQ(value["value"], "exact");
    EXPECT_EQ(value["set"][0], "fresnel=exact");
    EXPECT_EQ(value["error"], 0.01);
    EXPECT_EQ(value["ownError"], 0.1235); // four digits
    EXPECT_EQ(value["milliseconds"]["vulkan"], 10.0);
    EXPECT_EQ(value["interval"]["vulkan"], nlohmann::ordered_json::array({ 1.0, 1.0 }));
}

TEST(EffectReport, TheTableOfNumbersHasALineForEachValueAndBackend) {
    const std::string csv = csvOf(jsonOf(exampleResults()));
    EXPECT_EQ(std::ranges::count(csv, '\n'), 3);
    EXPECT_THAT(csv, HasSubstr("n,exact,fresnel=exact,frame,vulkan,10,9,11"));
}

TEST(EffectReport, ThePageNamesMachineCommitAndTheCommandOfEveryRow) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / "report-text", page = folder / "page.html";
    const Result<void> written =
            writeReport(exampleResults(), { .out = folder, .page = page, .include = {}, .plots = false });
    ASSERT_TRUE(written) << written.error().message;
    std::ifstream file(page);
    const std::string html(std::istreambuf_iterator<char>(file), {});
    fs::remove_all(folder);
    for (const char* wanted : { "a machine", "abc1234", "filament-accuracy --effect n", "driver 1", "asset:x.hdr",
                                "12.3 %", "data-row=\"1\"" })
        EXPECT_THAT(html, HasSubstr(wanted));
    EXPECT_THAT(html, AllOf(HasSubstr("a &lt; b &amp; c"), Not(HasSubstr("a < b & c"))));
}

} // namespace
} // namespace filament_core::accuracy
