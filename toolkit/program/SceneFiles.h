// SPDX-License-Identifier: Apache-2.0
/// SceneFiles: turns options into existing files: where to read, where to write.
///   Thread  one; the showcase is generated on a separate job system.
///   Fails   Unreadable with the path and what to give instead.
#pragma once

#include "toolkit/program/SceneOptions.h"
#include "toolkit/showcase/Showcase.h"

namespace filament_core::tools {

/// The folder of the images, created if it is missing.
Result<void> makeOutFolder(SceneOptions const& options);

/// The files of the command line. Without a model the showcase is written into the folder of the images, and without
/// environment and sun its sky. `--environment none` means none. An environment that the model itself brings comes
/// before these, unless the command line names one: SceneOptions::environment is empty.
Result<showcase::Files> chooseFiles(SceneOptions const& options);

} // namespace filament_core::tools
