// SPDX-License-Identifier: Apache-2.0
/// Reads whole files, and replaces them in one step so that no reader ever sees half of one.
///   Thread  any; two writers of one path leave the complete file of one of them.
///   Fails   NotFound, Unreadable (also for directories and files above 4 GiB), with path, reason and cure.
#pragma once

#include "base/Result.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace filament_core::assets {

Result<std::vector<std::byte>> readFileBytes(std::filesystem::path const& path);

/// Reads text of at most `most` bytes, also from pipes and devices, which are read no further than that.
Result<std::string> readText(std::filesystem::path const& path, size_t most);

/// Writes a temporary file beside `path` and renames it, so that an error (a full disk) leaves the old file as it was.
/// Makes missing directories. A symbolic link stays: what it names is replaced. What is not a regular file (a device, a
/// pipe, /dev/stdout) is written into. An existing file keeps its permissions.
Result<void> replaceFile(std::filesystem::path const& path, std::span<const std::byte> bytes);

/// Deletes the temporary files that replaceFile() left in `folder` when its process was killed: those whose process is
/// gone and that has not been written to for a minute, or for an hour whatever the process (it may be on another
/// machine). Returns their number. Never fails.
size_t removeLeftovers(std::filesystem::path const& folder);

} // namespace filament_core::assets
