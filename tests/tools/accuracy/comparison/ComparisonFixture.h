// SPDX-License-Identifier: Apache-2.0
/// Shared by the tests of comparisons: the committed rows and scenes, a folder for output, small images.
#pragma once

#include "toolkit/paths/Paths.h"
#include "tools/accuracy/comparison/Comparison.h"

#include <filesystem>
#include <fstream>
#include <string>

namespace filament_core::accuracy {

namespace fs = std::filesystem;

inline const fs::path kFolder = tools::sourceDir() / "tools/accuracy/comparison";

inline fs::path scratch() {
    const fs::path folder = tools::buildDir() / "comparison-test";
    fs::create_directories(folder);
    return folder;
}

inline fs::path rowsFile(std::string const& name, std::string const& text) {
    const fs::path path = scratch() / (name + ".json");
    std::ofstream(path) << text;
    return path;
}

inline ComparisonOptions smallOptions(fs::path const& rows) {
    return { .rows = rows,
             .scenes = kFolder / "scenes",
             .folders = { scratch() / "work", {} },
             .size = { 80, 45 },
             .mostSamples = 64 };
}

/// A folder with the committed scenes, to which more can be added.
inline fs::path scenesToChange(std::string const& name) {
    const fs::path folder = scratch() / name;
    fs::remove_all(folder);
    fs::copy(kFolder / "scenes", folder, fs::copy_options::recursive);
    return folder;
}

} // namespace filament_core::accuracy
