// SPDX-License-Identifier: Apache-2.0
/// SceneFiles: from the options to files that exist: where to read, where to write.
///   Thread  one; the showcase is made on a job system of its own.
///   Fails   Unreadable with the path and what to give instead.
#pragma once

#include "tools/common/SceneOptions.h"
#include "tools/showcase/Showcase.h"

namespace filament::tools {

/// The folder of the pictures, made if it is missing.
Result<void> makeOutFolder(SceneOptions const& options);

/// The files of the command line. Written into the folder of the pictures: the showcase where there is no model, its
/// sky where neither environment nor sun is asked for. `--environment none` is none.
Result<showcase::Files> chooseFiles(SceneOptions const& options);

} // namespace filament::tools
