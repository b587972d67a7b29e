// SPDX-License-Identifier: Apache-2.0
// The engine compared with the path tracer, in small images: the unexplained difference stays below a limit, and the
// limit detects an engine that shades differently.
#include "tests/tools/accuracy/comparison/ComparisonFixture.h"
#include "toolkit/program/Html.h"
#include "tools/accuracy/comparison/ComparisonPage.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

namespace filament_core::accuracy {
namespace {

StepResult const& stepOf(RowResult const& row, std::string_view name) {
    return *std::ranges::find(row.steps, name, &StepResult::name);
}

TEST(Comparison, UnderASunEverythingButHalfFloatsAndTheGridIsExplained) {
    const fs::path rows = rowsFile("sun", R"([{"name": "metals", "scene": "metals/sun", "unexplained": 0.01},
        {"name": "dielectrics", "scene": "dielectrics/sun", "unexplained": 0.01}])");
    const Result<ComparisonResults> results = comparePictures(smallOptions(rows), {});
    ASSERT_TRUE(results) << results.error().message;
    ASSERT_EQ(results->rows.size(), 2u);
    for (RowResult const& row : results->rows) EXPECT_TRUE(row.isExplained()) << textOf(*results);
    EXPECT_GT(stepOf(results->rows[0], "interreflection").own, 0.02) << "metals see each other";
    EXPECT_GT(stepOf(results->rows[1], "coupling").own, 0.004) << "what dielectrics send each other";
}

TEST(Comparison, UnderASkyTheStepsAddUpToTheWholeAndTheRestIsSmall) {
    const fs::path rows =
            rowsFile("sky", R"([{"name": "dielectrics", "scene": "dielectrics/sky", "unexplained": 0.02}])");
    const Result<ComparisonResults> results = comparePictures(smallOptions(rows), {});
    ASSERT_TRUE(results) << results.error().message;
    RowResult const& row = results->rows.front();
    EXPECT_TRUE(row.isExplained()) << textOf(*results);
    const double shares = std::accumulate(row.steps.begin(), row.steps.end(), 0.0,
                                          [](double sum, StepResult const& step) { return sum + step.share; });
    EXPECT_NEAR(shares, 1, 1e-6);
    EXPECT_EQ(row.steps.back().left, 0) << "the last step ends at the path tracer's picture";
    EXPECT_EQ(row.pictures.size(), row.steps.size() + 1);
    for (const char* name : { "oneSample", "tables", "levels", "splitSum", "occlusion" })
        EXPECT_GT(stepOf(row, name).own, 0) << name;
    EXPECT_LT(row.eightBits, 0.5 / 255) << "rounding, and no more";
    EXPECT_GT(row.eightBits, 0.2 / 255);
}

TEST(Comparison, ThePathTracerAgreesWithClosedFormsWithinItsError) {
    const Result<SceneLibrary> scenes = SceneLibrary::read(kFolder / "scenes");
    ASSERT_TRUE(scenes) << scenes.error().message;
    jobs::JobSystem jobs;
    const Result<std::vector<ClosedForm>> forms = checkClosedForms(*scenes, { scratch() / "work", {} }, 256, jobs);
    ASSERT_TRUE(forms) << forms.error().message;
    ASSERT_EQ(forms->size(), 4u);
    for (ClosedForm const& form : *forms) {
        EXPECT_TRUE(form.agrees()) << form.name << ": " << form.mean << " for " << form.expected;
        EXPECT_LT(form.standardError, 0.01 * form.expected) << form.name;
        ClosedForm wrong = form;
        wrong.expected *= 1.02;
        EXPECT_FALSE(wrong.agrees()) << form.name << ": two per cent more would be noticed";
    }
}

TEST(Comparison, AnEngineThatShadesOtherwiseIsNotExplained) {
    const fs::path rows = rowsFile("wrong", R"([
        {"name": "masking", "scene": "metals/sun", "unexplained": 0.01, "set": ["specularVisibility=uncorrelated"]},
        {"name": "energy", "scene": "metals/sun", "unexplained": 0.01, "set": ["energyCompensation=off"]},
        {"name": "coupling", "scene": "dielectrics/sun", "unexplained": 0.01, "set": ["diffuseCoupling=off"]}])");
    const Result<ComparisonResults> results = comparePictures(smallOptions(rows), {});
    ASSERT_TRUE(results) << results.error().message;
    for (RowResult const& row : results->rows)
        EXPECT_FALSE(row.isExplained()) << row.row.name << '\n' << textOf(*results);
}

/// The committed scenes, and one more whose features are `features`.
fs::path scenesWith(std::string const& features) {
    const fs::path folder = scenesToChange("scenes");
    std::ofstream(folder / "broken.json") << R"({"model": {"material": "materials/coat.mat", "mesh": "sphere"},
        "camera": {"eye": [0.8, 0.9, 4.6], "at": [0, 0, 0], "fovDegrees": 28},
        "suns": [{"direction": [0.6, -0.5, -0.6], "lux": 100000}],
        "view": {"size": [240, 136], "linear": true}, "features": {)"
                                          << features << "}}";
    return folder;
}

// The engine gets a text that differs from what the path tracer reads from the values: each missing term of a layered
// material is detected.
TEST(Comparison, AMaterialWithoutItsTermIsNotExplained) {
    const fs::path scenes = scenesWith(R"(
        "coat": {"model": {"edits": {"= materialParams.clearCoat;": "= 0.5 * materialParams.clearCoat;"},
            "values": {"baseColor": "0.7,0.1,0.1", "metallic": "0", "roughness": "0.5", "clearCoat": "1",
                       "clearCoatRoughness": "0.3"}}},
        "sheen": {"model": {"material": "materials/sheen.mat",
            "edits": {"= materialParams.sheenColor;": "= 0.7 * materialParams.sheenColor;"},
            "values": {"baseColor": "0.5,0.1,0.1", "metallic": "0", "roughness": "0.9", "sheenColor": "0.9,0.8,0.8",
                       "sheenRoughness": "0.5"}}},
        "brushed": {"model": {"material": "materials/brushed.mat",
            "edits": {"= materialParams.anisotropy;": "= 0.7 * materialParams.anisotropy;"},
            "values": {"baseColor": "0.9,0.9,0.9", "metallic": "1", "roughness": "0.6", "anisotropy": "0.8"}}},
        "corner": {"model": {"material": "materials/corner_bent.mat", "mesh": "plane",
            "edits": {"specularAmbientOcclusion : bentNormals": "specularAmbientOcclusion : none"},
            "values": {"baseColor": "0.9,0.9,0.9", "metallic": "1", "roughness": "0.5", "wallHeight": "2"}},
            "suns": [], "environment": {"file": "white", "skybox": false}})");
    const fs::path rows = rowsFile("broken", R"([
        {"name": "coat", "scene": "broken/coat", "unexplained": 0.03},
        {"name": "sheen", "scene": "broken/sheen", "unexplained": 0.03},
        {"name": "brushed", "scene": "broken/brushed", "unexplained": 0.03},
        {"name": "corner", "scene": "broken/corner", "unexplained": 0.03}])");
    ComparisonOptions options = smallOptions(rows);
    options.scenes = scenes;
    const Result<ComparisonResults> broken = comparePictures(options, {});
    ASSERT_TRUE(broken) << broken.error().message;
    for (RowResult const& row : broken->rows)
        EXPECT_FALSE(row.isExplained()) << row.row.name << '\n' << textOf(*broken);
}

TEST(Comparison, EveryTermOfAMaterialIsExplained) {
    const fs::path rows = rowsFile("terms", R"([
        {"name": "coat", "scene": "coat/paint-sun", "unexplained": 0.02, "step": "coat", "limit": 0.08},
        {"name": "sheen", "scene": "sheen/sun", "unexplained": 0.02, "step": "sheen", "limit": 0.12},
        {"name": "brushed", "scene": "brushed/sun", "unexplained": 0.03},
        {"name": "occlusion", "scene": "corner/paint-bent", "unexplained": 0.03, "step": "occlusion", "limit": 0.2}])");
    const Result<ComparisonResults> results = comparePictures(smallOptions(rows), {});
    ASSERT_TRUE(results) << results.error().message;
    for (RowResult const& row : results->rows) {
        EXPECT_TRUE(row.isExplained()) << textOf(*results);
        EXPECT_TRUE(row.isWithinLimit()) << textOf(*results);
        RowResult strict = row;
        strict.row.limit = 0.5 * row.stepError();
        EXPECT_EQ(strict.isWithinLimit(), row.row.step.empty()) << row.row.name;
    }
}

TEST(Comparison, TheCommittedRowsNameScenesThatAreThereAndStepsThatExist) {
    const Result<std::vector<ComparisonRow>> rows = readComparisonRows(kFolder / "rows.json");
    ASSERT_TRUE(rows) << rows.error().message;
    const Result<SceneLibrary> scenes = SceneLibrary::read(kFolder / "scenes");
    ASSERT_TRUE(scenes) << scenes.error().message;
    std::vector<Rung> all = ladder({ .material = { .coat = true, .sheen = true, .refraction = true, .solid = true } });
    for (ComparisonRow const& row : *rows) {
        EXPECT_TRUE(scenes->find(row.scene)) << row.name;
        EXPECT_TRUE(row.step.empty() || row.step == "occlusion" ||
                    std::ranges::any_of(all, [&](Rung const& rung) { return rung.name == row.step; }))
                << row.name;
        EXPECT_FALSE(row.title.empty()) << row.name;
    }
    for (const char* step : { "coat", "sheen", "splitSum", "oneSample", "occlusion", "refraction", "solidTint" })
        EXPECT_TRUE(std::ranges::any_of(*rows, [&](ComparisonRow const& row) { return row.step == step; })) << step;
}

TEST(Comparison, AStepThatTheLadderDoesNotHaveIsRefusedWithTheNearest) {
    const fs::path rows = rowsFile("step", R"([{"name": "n", "scene": "coat/paint-sun", "step": "coats"}])");
    const Result<ComparisonResults> results = comparePictures(smallOptions(rows), {});
    ASSERT_FALSE(results);
    EXPECT_NE(results.error().message.find("'coats'; did you mean 'coat'?"), std::string::npos)
            << results.error().message;
}

TEST(Comparison, AMaterialsValueThatNoTracerKnowsIsRefusedWithTheNearest) {
    const fs::path scenes = scenesWith(R"("value": {"model": {"values": {"clearcoat": "1"}}})");
    ComparisonOptions options =
            smallOptions(rowsFile("value", R"([{"name": "n", "scene": "broken/value", "samples": 2}])"));
    options.scenes = scenes;
    const Result<ComparisonResults> results = comparePictures(options, {});
    ASSERT_FALSE(results);
    EXPECT_NE(results.error().message.find("'clearcoat'"), std::string::npos) << results.error().message;
    EXPECT_NE(results.error().message.find("did you mean 'clearCoat'?"), std::string::npos) << results.error().message;
}

TEST(Comparison, TheReportHoldsEveryRowItsStepsAndItsCommand) {
    const fs::path rows =
            rowsFile("report", R"([{"name": "a-row", "title": "A <title>", "scene": "dielectrics/sun"}])");
    ComparisonOptions options = smallOptions(rows);
    options.mostSamples = 2;
    options.size = { 16, 9 };
    const Result<ComparisonResults> results = comparePictures(options, {});
    ASSERT_TRUE(results) << results.error().message;
    const Result<void> written = writeComparison(*results, scratch() / "report");
    ASSERT_TRUE(written) << written.error().message;
    std::ifstream file(scratch() / "report" / "comparison.fragment.html");
    const std::string html{ std::istreambuf_iterator<char>(file), {} };
    for (const char* text :
         { "A &lt;title&gt;", "Missing inter-reflection", "filament-accuracy --compare a-row",
           "src=\"comparison/a-row-engine.png\"", "src=\"comparison/a-row-traced.png\"", "<section", "</section>" }) {
        EXPECT_NE(html.find(text), std::string::npos) << text;
    }
    for (const char* name : { "a-row-engine.png", "a-row-traced.png" }) {
        std::ifstream picture(scratch() / "report/comparison" / name, std::ios::binary);
        char signature[9] = {};
        picture.read(signature, 8);
        EXPECT_STREQ(signature, "\x89PNG\r\n\x1A\n") << name;
    }
    const auto document = jsonOf(*results);
    EXPECT_EQ(document["rows"][0]["steps"].size(), results->rows[0].steps.size());
    EXPECT_EQ(document["rows"][0]["rms"].get<double>(), results->rows[0].rms);
}

TEST(Comparison, RowsThatAreWrongAreRefusedWithTheirFileAndField) {
    const std::pair<const char*, const char*> wrong[] = {
        { "{}", "must be a JSON list of rows" },
        { R"([{"scene": "metals/sun"}])", "row 0: name" },
        { R"([{"name": "a", "scene": "metals/sun", "sample": 4}])", "'sample' is not a field here; did you mean" },
        { R"([{"name": "a", "scene": "metals/sun", "samples": 1}])", "samples: expected a number from 2" },
        { R"([{"name": "a", "scene": "metals/sun", "set": ["fresnell=exact"]}])", "fresnell" },
    };
    for (auto const& [text, complaint] : wrong) {
        const auto rows = readComparisonRows(rowsFile("wrong-row", text));
        ASSERT_FALSE(rows) << text;
        EXPECT_NE(rows.error().message.find("wrong-row.json"), std::string::npos) << rows.error().message;
        EXPECT_NE(rows.error().message.find(complaint), std::string::npos) << rows.error().message;
    }
    ComparisonOptions options = smallOptions(kFolder / "rows.json");
    options.chosen = { "metals-sum" };
    const Result<ComparisonResults> unknown = comparePictures(options, {});
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().message.find("did you mean 'metals-sun'?"), std::string::npos) << unknown.error().message;
}

TEST(Comparison, ARowWithoutItsAssetsIsSkippedWithTheReason) {
    const fs::path rows = rowsFile("assets", R"([{"name": "helmet", "scene": "helmet/studio"}])");
    const Result<ComparisonResults> results = comparePictures(smallOptions(rows), {});
    ASSERT_TRUE(results) << results.error().message;
    EXPECT_TRUE(results->rows.empty());
    ASSERT_EQ(results->skipped.size(), 1u);
    EXPECT_NE(results->skipped[0].reason.find("FlightHelmet"), std::string::npos);
}

TEST(Ladder, EveryStepHasANameAndOneOfThemIsTheUnexplained) {
    const LadderScene scenes[] = { { .hasEnvironment = false },
                                   { .hasEnvironment = false, .hasLights = true },
                                   { .hasEnvironment = true },
                                   { .material = { .coat = true, .sheen = true } },
                                   { .material = { .refraction = true } },
                                   { .material = { .refraction = true, .solid = true } } };
    for (LadderScene const& scene : scenes) {
        const std::vector<Rung> rungs = ladder(scene);
        size_t unexplained = 0;
        for (size_t i = 0; i + 1 < rungs.size(); ++i) {
            EXPECT_FALSE(rungs[i].name.empty() || rungs[i].title.empty() || rungs[i].exact.empty()) << i;
            unexplained += rungs[i].name == kUnexplained;
            const bool changesWorld = rungs[i].kind != rungs[i + 1].kind;
            EXPECT_EQ(changesWorld, rungs[i].name == kUnexplained) << "only there the reference takes over";
        }
        EXPECT_EQ(unexplained, 1u);
        EXPECT_TRUE(rungs.back().name.empty()) << "the last picture is the truth";
    }
}

Picture flat(float3 color, uint32_t width = 8, uint32_t height = 8) {
    return { width, height, std::vector<float3>(size_t{ width } * height, color) };
}

TEST(Difference, IsRelativeToBothAndSigned) {
    const Picture truth = flat(float3(1)), bright = flat(float3(1.5f));
    const DifferenceScale scale(truth, bright);
    const double floor = 0.01 * std::sqrt(3.0), size = 1.25 * std::sqrt(3.0) + floor;
    EXPECT_NEAR(rms(bright, truth, scale), 0.5 * std::sqrt(3.0) / size, 1e-9);
    EXPECT_NEAR(bias(bright, truth, scale), 0.5 / size, 1e-9);
    EXPECT_NEAR(bias(truth, bright, scale), -0.5 / size, 1e-9);
    EXPECT_NEAR(product(bright, truth, truth, bright, scale), -std::pow(rms(bright, truth, scale), 2), 1e-12);
}

TEST(Difference, PixelsBesideTheBackgroundDoNotCount) {
    Picture truth = flat(float3(1));
    truth.pixels[0] = float3(0);
    const DifferenceScale scale(truth, flat(float3(1)));
    EXPECT_EQ(scale.pixels(), 60u);
    EXPECT_FALSE(scale.counts(0) || scale.counts(1) || scale.counts(8) || scale.counts(9));
    EXPECT_TRUE(scale.counts(2));
}

TEST(Difference, MapsAreRedWhereTheFirstPictureIsBrighterAndBlueWhereItIsDarker) {
    const Picture truth = flat(float3(1)), bright = flat(float3(2));
    const DifferenceScale scale(truth, truth);
    const auto pixel = [](Image const& image, int c) {
        return std::to_integer<int>(image.pixels[static_cast<size_t>(c)]);
    };
    const Image red = differenceMap(bright, truth, scale, 0.25), blue = differenceMap(truth, bright, scale, 0.25);
    const Image white = differenceMap(truth, truth, scale, 0.25);
    EXPECT_GT(pixel(red, 0), pixel(red, 2) + 80);
    EXPECT_GT(pixel(blue, 2), pixel(blue, 0) + 80);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(pixel(white, c), 255);
}

TEST(Html, TextIsEscapedAndBytesAreTheTestVectorsOfRfc4648) {
    EXPECT_EQ(tools::escapedHtml("a<b> & \"c\""), "a&lt;b&gt; &amp; &quot;c&quot;");
    const std::pair<const char*, const char*> vectors[] = {
        { "", "" }, { "f", "Zg==" }, { "fo", "Zm8=" }, { "foo", "Zm9v" }, { "foob", "Zm9vYg==" }
    };
    for (auto const& [text, encoded] : vectors)
        EXPECT_EQ(tools::base64(std::as_bytes(std::span(std::string_view(text)))), encoded);
}

} // namespace
} // namespace filament_core::accuracy
