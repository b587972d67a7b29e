// SPDX-License-Identifier: Apache-2.0
/// RecentFiles: the files that were opened last, kept between runs.
///   Where    $XDG_STATE_HOME/filament-view/recent.json, or ~/.local/state/... (XDG Base Directory Specification 0.8).
///   Text     a list of absolute paths, newest first. Whatever the file holds, reading it gives a list: what is no such
///            path is left out.
///   Limits   kMostRecent files of at most kLongestPath bytes; a file above 1 MiB is not read.
///   Thread   one.
///   Fails    add(): Unreadable, the list is then kept in this program alone.
#pragma once

#include "base/Result.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

inline constexpr size_t kMostRecent = 20, kLongestPath = 4096;

/// Empty: neither XDG_STATE_HOME nor HOME is an absolute path.
std::filesystem::path recentFilesPath();

std::vector<std::filesystem::path> recentFromJson(std::string_view text); ///< never fails
std::string recentToJson(std::vector<std::filesystem::path> const& files);

class RecentFiles {
public:
    /// Empty: nothing is read or kept.
    explicit RecentFiles(std::filesystem::path store);
    std::vector<std::filesystem::path> const& files() const { return mFiles; } ///< newest first
    /// To the front; what other viewers have added meanwhile stays.
    Result<void> add(std::filesystem::path const& file);

private:
    void read();

    std::filesystem::path mStore;
    std::vector<std::filesystem::path> mFiles;
};

} // namespace filament_core::view
