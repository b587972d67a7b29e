// SPDX-License-Identifier: Apache-2.0
/// fileInside(): the files that a model or a material may name are those of its own folder. A file from elsewhere must
/// not make a program read /etc/passwd, or a device.
///   Thread  any. Fails: NotFound; InvalidArgument for a path that leaves the folder, with the cure.
#pragma once

#include "base/Result.h"

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace filament_core::assets {

enum class FilesFrom : uint8_t {
    Folder,   ///< the folder of the file that names them, and below
    Anywhere, ///< also absolute paths, "..", and links that lead out
};

/// The existing file that `relative` names below `folder`. Links and ".." are followed as the system follows them, and
/// the file that they lead to counts.
Result<std::filesystem::path> fileInside(std::filesystem::path const& folder, std::string_view relative,
                                         FilesFrom from = FilesFrom::Folder);

} // namespace filament_core::assets
