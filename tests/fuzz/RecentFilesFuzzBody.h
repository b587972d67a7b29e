// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, the list of recent files is one of absolute paths without
/// control characters, each once, and the same again when it is written and read.
#pragma once

#include "base/Assert.h"
#include "tools/view/app/RecentFiles.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>

namespace filament_core {

/// Returns whether it had files.
inline bool fuzzRecentFilesOnce(std::span<const uint8_t> input) {
    const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
    const std::vector<std::filesystem::path> files = view::recentFromJson(text);
    FILAMENT_ASSERT(files.size() <= view::kMostRecent, "a list has a length");
    for (std::filesystem::path const& file : files) {
        const std::string path = file.string();
        FILAMENT_ASSERT(file.is_absolute() && path.size() <= view::kLongestPath, "paths are absolute");
        FILAMENT_ASSERT(std::ranges::all_of(path, [](char c) { return static_cast<unsigned char>(c) >= ' '; }),
                        "paths can be printed");
    }
    FILAMENT_ASSERT(std::set<std::filesystem::path>(files.begin(), files.end()).size() == files.size(),
                    "each file is there once");
    FILAMENT_ASSERT(view::recentFromJson(view::recentToJson(files)) == files, "what is written is what was read");
    return !files.empty();
}

} // namespace filament_core
