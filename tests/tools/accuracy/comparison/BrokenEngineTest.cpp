// SPDX-License-Identifier: Apache-2.0
// Committed rows with an engine that lacks a term: each must exceed the limit of the row, and stay below it unmodified.
#include "tests/tools/accuracy/comparison/ComparisonFixture.h"
#include "tools/accuracy/comparison/ComparisonPage.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace filament_core::accuracy {
namespace {

using nlohmann::json;

/// The engine gets the edited text of the material; the path tracer uses the values according to their names.
struct Break {
    const char *row, *from, *to;
};

ComparisonRow committedRow(std::string_view name) {
    const Result<std::vector<ComparisonRow>> rows = readComparisonRows(kFolder / "rows.json");
    for (ComparisonRow const& row : rows ? *rows : std::vector<ComparisonRow>{}) {
        if (row.name == name) return row;
    }
    ADD_FAILURE() << "there is no row " << name;
    return {};
}

/// Adds a feature to the scene of a row, for example "solid/sky": the same with an edit of its material. Returns its
/// name.
std::string addBroken(fs::path const& scenes, std::string const& scene, std::string const& feature,
                      Break const& broken) {
    const size_t slash = scene.find('/');
    const std::string base = scene.substr(0, slash);
    const fs::path file = scenes / (base + ".json");
    json all = json::parse(std::ifstream(file));
    json changed = all["features"][scene.substr(slash + 1)];
    changed["model"]["edits"][broken.from] = broken.to;
    all["features"][feature] = changed;
    std::ofstream(file) << all;
    return base + '/' + feature;
}

json rowOf(ComparisonRow const& row, std::string const& name, std::string const& scene) {
    return { { "name", name },
             { "scene", scene },
             { "unexplained", row.unexplained },
             { "step", row.step },
             { "limit", row.limit } };
}

// Half the path through the sheet and through the ball, a colour that counts twice, colours that all refract alike,
// highlights blurred too much.
constexpr Break kBreaks[] = {
    { "thin-sky", "= materialParams.microThickness;", "= 0.5 * materialParams.microThickness;" },
    { "solid-sky", "= materialParams.thickness;", "= 0.5 * materialParams.thickness;" },
    { "solid-tinted-sky", "= materialParams.baseColor;", "= materialParams.baseColor * materialParams.baseColor;" },
    { "dispersing-sky", "= materialParams.dispersion;", "= 0.0;" },
    { "filtered-sun", "specularAntiAliasingVariance : 0.15", "specularAntiAliasingVariance : 0.75" },
};

TEST(BrokenEngine, RowsOfGlassAndOfFilteredHighlightsNoticeIt) {
    const fs::path scenes = scenesToChange("broken-scenes");
    json rows = json::array();
    for (size_t i = 0; i < std::size(kBreaks); ++i) {
        const ComparisonRow row = committedRow(kBreaks[i].row);
        rows.push_back(rowOf(row, row.name, row.scene));
        const std::string feature = "broken-" + std::to_string(i);
        rows.push_back(rowOf(row, feature, addBroken(scenes, row.scene, feature, kBreaks[i])));
    }
    ComparisonOptions options = smallOptions(rowsFile("broken-rows", rows.dump()));
    options.scenes = scenes;
    options.size = { 64, 36 };
    const Result<ComparisonResults> results = comparePictures(options, {});
    ASSERT_TRUE(results) << results.error().message;
    ASSERT_TRUE(results->skipped.empty());
    for (RowResult const& row : results->rows) {
        const bool isBroken = row.row.name.starts_with("broken-");
        EXPECT_NE(row.isExplained() && row.isWithinLimit(), isBroken) << row.row.name << '\n' << textOf(*results);
    }
}

} // namespace
} // namespace filament_core::accuracy
