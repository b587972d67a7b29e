// SPDX-License-Identifier: Apache-2.0
// Replays edits of the tools' own files, without clang: each gives contents or an error of one line.
#include "tests/fuzz/EditedText.h"
#include "tests/fuzz/ToolFilesFuzzBody.h"
#include "toolkit/paths/Paths.h"

#include <gtest/gtest.h>

#include <vector>

namespace filament_core {
namespace {

using test::fuzzToolFile;
using test::ToolFile;

std::string contentsOf(std::filesystem::path const& file) {
    std::ifstream in(file, std::ios::binary);
    EXPECT_TRUE(in.good()) << file;
    return { std::istreambuf_iterator<char>(in), {} };
}

constexpr const char* kBaselines = R"({"machine": {"device": "d", "cpu": "c", "driver": "v"}, "cases": {}})";
constexpr const char* kResults = R"({"build": "Release", "reference": "vulkan", "devices": {"vulkan": "llvmpipe"},
  "machines": {"width-128": {"device": "d"}}, "cases": []})";

constexpr const char* kAccuracy =
        R"({"program": "filament-accuracy", "version": 1, "machine": "m", "driver": {}, "commit": "c",
  "date": "2000-01-01", "frame": "f", "size": [1, 1], "rounds": 1, "effects": [{"name": "a", "cost": "frame", "values": [
    {"value": "v", "set": ["a=b"], "error": 0.1, "ownError": 0.1, "ownMax": 0.1, "ownFlip": 0.1, "frameFlip": 0.1, "totalError": 0.1,
     "milliseconds": {"vulkan": 1.0}, "millisecondsInterval": {"vulkan": [1.0, 1.0]}, "ratio": {"vulkan": 1.0},
     "interval": {"vulkan": [1.0, 1.0]}}]}], "skipped": [], "shard": {"index": 0, "count": 1, "rows": ["a"]}})";

struct Sample {
    ToolFile kind;
    std::string text;
};

std::vector<Sample> samples() {
    const std::filesystem::path root = tools::sourceDir();
    const std::filesystem::path scenes = root / "tests/conformance/scenes";
    return { { ToolFile::Scene, contentsOf(scenes / "lines.json") },
             { ToolFile::Scene, contentsOf(scenes / "spot-lights.json") },
             { ToolFile::Scene, contentsOf(scenes / "materials-vertex.json") },
             { ToolFile::Baselines, kBaselines },
             { ToolFile::Results, kResults },
             { ToolFile::Times, R"({"lines": 0.5, "lines/msaa": 1})" },
             { ToolFile::Journal, "{\"begin\": \"a\"}\n{\"end\": {}}\n" },
             { ToolFile::Effects, contentsOf(root / "tools/accuracy/effects.json") },
             { ToolFile::Rows, contentsOf(root / "tools/accuracy/comparison/rows.json") },
             { ToolFile::Accuracy, kAccuracy },
             { ToolFile::Show,
               "// show: mesh=torus tint=1,0.5,0.2 map=brick/color slab=true instances=3\nmaterial {}" } };
}

TEST(ToolFiles, AreReadAsTheyStand) {
    for (Sample const& sample : samples()) {
        if (sample.kind == ToolFile::Baselines || sample.kind == ToolFile::Journal) continue; // made up above
        EXPECT_TRUE(fuzzToolFile(sample.kind, sample.text)) << sample.text.substr(0, 60);
    }
}

TEST(ToolFiles, SurviveEditsAnywhere) {
    std::mt19937 random(20261123);
    size_t refused = 0;
    const std::vector<Sample> originals = samples();
    for (int round = 0; round < 2000; ++round) {
        Sample const& sample = originals[round % originals.size()];
        refused += !fuzzToolFile(sample.kind, test::editedText(sample.text, random));
    }
    EXPECT_GT(refused, 500u);
}

TEST(ToolFiles, OfEveryReaderSurviveTheFilesOfTheOthers) {
    for (Sample const& sample : samples()) {
        for (int kind = 0; kind < test::kToolFiles; ++kind) fuzzToolFile(static_cast<ToolFile>(kind), sample.text);
    }
    for (const char* text : { "", "null", "[]", "{}", "3", "\"\"", "[[[[", "{\"cases\": 1}", "\xff\xfe" }) {
        for (int kind = 0; kind < test::kToolFiles; ++kind) fuzzToolFile(static_cast<ToolFile>(kind), text);
    }
}

} // namespace
} // namespace filament_core
