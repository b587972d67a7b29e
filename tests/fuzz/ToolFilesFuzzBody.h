// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, the readers of the tools' own files give contents or an
/// error of one line that names the file. The first byte chooses the reader.
#pragma once

#include "base/Assert.h"
#include "toolkit/materials/MaterialFile.h"
#include "toolkit/scenes/SceneFile.h"
#include "tools/accuracy/Effect.h"
#include "tools/accuracy/Shards.h"
#include "tools/accuracy/comparison/Comparison.h"
#include "tools/conformance/Baselines.h"
#include "tools/conformance/Journal.h"
#include "tools/conformance/Results.h"

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace filament_core::test {

enum class ToolFile : uint8_t { Scene, Baselines, Results, Times, Journal, Effects, Rows, Show, Accuracy };
inline constexpr int kToolFiles = 9;

/// A folder of this process, removed with it.
class ToolFolder {
public:
    ToolFolder() : mPath(std::filesystem::temp_directory_path() / ("tool-files-" + std::to_string(getpid()))) {
        std::filesystem::create_directories(mPath);
    }
    ~ToolFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(mPath, ignored);
    }
    std::filesystem::path write(const char* name, std::string_view text) const {
        std::ofstream(mPath / name, std::ios::binary) << text;
        return mPath / name;
    }
    std::filesystem::path const& path() const { return mPath; }

private:
    std::filesystem::path mPath;
};

template <class T>
bool isContents(Result<T> const& read, std::string_view name) {
    if (read.ok()) return true;
    FILAMENT_ASSERT(read.error().message.find(name) != std::string::npos, "an error names the file");
    FILAMENT_ASSERT(read.error().message.find('\n') == std::string::npos, "an error is one line");
    return false;
}

inline bool fuzzBaselines(ToolFolder const& folder, std::string_view text) {
    const auto read = conformance::Baselines::read(folder.write("baselines.json", text));
    if (!isContents(read, "baselines.json")) return false;
    const std::filesystem::path once = folder.path() / "once.json", twice = folder.path() / "twice.json";
    FILAMENT_ASSERT(read->write(once).ok(), "what was read can be written");
    const auto again = conformance::Baselines::read(once);
    FILAMENT_ASSERT(again.ok() && again->write(twice).ok(), "what was written can be read");
    const auto contents = [](std::filesystem::path const& file) {
        std::ifstream in(file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    FILAMENT_ASSERT(contents(once) == contents(twice), "writing what was read changes nothing");
    return true;
}

inline bool fuzzToolFile(ToolFile kind, std::string_view text) {
    static const ToolFolder folder;
    switch (kind) {
    case ToolFile::Scene:
        return isContents(tools::readSceneFile(folder.write("scene.json", text)), "scene.json");
    case ToolFile::Baselines:
        return fuzzBaselines(folder, text);
    case ToolFile::Results:
        folder.write("results.json", text);
        folder.write("times.json", "{}");
        return isContents(conformance::readResults(folder.path()), "results.json");
    case ToolFile::Times:
        folder.write("results.json", R"({"build": "b", "reference": "r", "cases": []})");
        folder.write("times.json", text);
        return isContents(conformance::readResults(folder.path()), "times.json");
    case ToolFile::Journal:
        return !conformance::readJournal(folder.write("journal.json", text)).cases.empty();
    case ToolFile::Effects:
        return isContents(accuracy::readEffects(folder.write("effects.json", text)), "effects.json");
    case ToolFile::Rows:
        return isContents(accuracy::readComparisonRows(folder.write("rows.json", text)), "rows.json");
    case ToolFile::Show:
        return isContents(tools::readMaterialShow(text, "fuzzed.mat"), "fuzzed.mat");
    case ToolFile::Accuracy:
        return isContents(accuracy::mergeShards({ folder.write("accuracy.json", text) }), "");
    }
    return false;
}

inline bool fuzzToolFile(std::string_view input) {
    if (input.empty()) return false;
    const auto kind = static_cast<ToolFile>(static_cast<unsigned char>(input[0]) % kToolFiles);
    return fuzzToolFile(kind, input.substr(1));
}

} // namespace filament_core::test
