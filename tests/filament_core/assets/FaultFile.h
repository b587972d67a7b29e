// SPDX-License-Identifier: Apache-2.0
/// faultFile: a small input that went wrong once. They lie in "faults" beside the folder of the assets.
#pragma once

#include "toolkit/paths/Paths.h"

#include <filesystem>
#include <string>

namespace filament_core::assets {

inline std::filesystem::path faultFile(std::string const& name) { return tools::assetDir() / "../faults" / name; }

inline bool hasFaultFiles() { return !tools::assetDir().empty() && std::filesystem::exists(faultFile("README.md")); }

} // namespace filament_core::assets

/// In a test: ends it where the inputs are not.
#define SKIP_WITHOUT_FAULT_FILES()                                                                                     \
    if (!hasFaultFiles()) GTEST_SKIP() << "there is no folder 'faults' beside FILAMENT_ASSET_DIR"
