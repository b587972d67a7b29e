// SPDX-License-Identifier: Apache-2.0
/// AovFiles: the AOVs of `--aovs` as layers of one OpenEXR file for each API, and whether both APIs gave the same bits.
///   Fails   as saveExr(): one line with the file and the reason.
#pragma once

#include "tools/filament-render/BackendRun.h"

#include <string>

namespace filament_core::tools {

/// Writes DIR/API.aovs.exr. Without AOVs: nothing.
Result<void> saveAovs(Options const& options, BackendRun const& run);

/// One line for a person; empty without AOVs. `same`: whether all bits are.
struct AovComparison {
    bool same = true;
    std::string line{};
};
AovComparison compareAovs(Options const& options, BackendRun const& a, BackendRun const& b);

} // namespace filament_core::tools
