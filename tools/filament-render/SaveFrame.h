// SPDX-License-Identifier: Apache-2.0
/// saveRunAsFrame: --save-frame, the image of a command line as a folder that anyone can replay
/// (docs/saved-frames.md).
///   In      the runs of the command line: the image of the first one is what was shown.
///   Fails   errors of saveFrame(); Internal if an API does not draw again what was shown. The folder is then complete.
#pragma once

#include "toolkit/showcase/Showcase.h"
#include "tools/filament-render/BackendRun.h"

#include <span>

namespace filament_core::tools {

Result<void> saveRunAsFrame(Options const& options, showcase::Files const& files, std::span<const BackendRun> runs);

} // namespace filament_core::tools
