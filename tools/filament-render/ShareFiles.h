// SPDX-License-Identifier: Apache-2.0
/// ShareFiles: what `--shares` and `--explain-pixel` write and print.
///   Fails   as saveExr(): one line with the file and the reason.
#pragma once

#include "tools/filament-render/BackendRun.h"

#include <string>

namespace filament_core::tools {

/// Writes DIR/API.shares.exr and DIR/API.pixel.json, as far as there are any.
Result<void> saveShares(Options const& options, BackendRun const& run);

/// A table for a person.
std::string textOf(PixelExplanation const& explanation);

/// Whether both APIs gave the same bits.
bool hasSameShares(BackendRun const& a, BackendRun const& b);

} // namespace filament_core::tools
