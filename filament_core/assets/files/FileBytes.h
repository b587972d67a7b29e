// SPDX-License-Identifier: Apache-2.0
/// Reads whole files, and replaces them in one step so that no reader ever sees half of one.
///   Thread  any; two writers of one path leave the complete file of one of them.
///   Fails   NotFound, Unreadable (also for directories and files above 4 GiB), with path, reason and cure.
#pragma once

#include "base/Result.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace filament::assets {

Result<std::vector<std::byte>> readFileBytes(std::filesystem::path const& path);

/// Writes a temporary file beside `path` and renames it; makes missing directories.
Result<void> replaceFile(std::filesystem::path const& path, std::span<const std::byte> bytes);

} // namespace filament::assets
