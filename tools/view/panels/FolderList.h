// SPDX-License-Identifier: Apache-2.0
/// FolderList: what of a folder a file dialog shows, and what a path is.
///   Order    folders first, then files; by name, without regard to case, digits by their value: "view 9" before "view
///            10".
///   Without  hidden names, files that do not end as asked for, and what is neither file nor folder.
///   Limits   kMostEntries, in the order in which the system names them: isCut.
///   Thread   any.   Fails: never: `error` says in one line why nothing is there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

inline constexpr size_t kMostEntries = 10'000;

struct FolderEntry {
    std::string name{}; ///< any bytes
    bool isFolder = false;
    uint64_t bytes = 0; ///< of a file
};

struct FolderList {
    std::vector<FolderEntry> entries{};
    std::string error{};
    bool isCut = false;
};

enum class PathKind : uint8_t {
    Missing, ///< or what cannot be looked at
    File,    ///< a regular one
    Folder,
    Other, ///< a pipe, a device
};
PathKind kindOfPath(std::filesystem::path const& path); ///< follows links

/// `endings`: lower case, with the dot: ".glb"; files are compared without regard to case. None: all files.
FolderList listFolder(std::filesystem::path const& folder, std::span<const std::string_view> endings);
/// Whether it has one of the endings, in any case; true without endings.
bool endsAsAsked(std::string name, std::span<const std::string_view> endings);
bool comesBefore(FolderEntry const& a, FolderEntry const& b);
/// The places of entries whose names contain all words of the filter.
std::vector<size_t> matching(std::vector<FolderEntry> const& entries, std::string_view filter);
/// A name as text that can be drawn: bytes that are no UTF-8, and control characters, become '?'.
std::string shownName(std::string_view name);

} // namespace filament_core::view
