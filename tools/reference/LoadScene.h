// SPDX-License-Identifier: Apache-2.0
/// loadScene: the files and lights of a command line as a scene for the path tracer.
///   In      checked options. Without a model the showcase is written into `options.out` and read from there.
///   Thread  any, one call at a time; parses on the job system.
///   Fails   errors of the loaders, with path.
#pragma once

#include "tools/reference/Options.h"

namespace filament_core::reference {

/// `warnings`: of the model's file.
Result<ReferenceScene> loadScene(Options const& options, jobs::JobSystem& jobs, std::vector<std::string>& warnings);

/// Of the model's file, its geometry and textures, and the environment: all machines must render the same.
uint64_t contentsOf(Options const& options, ReferenceScene const& scene);

} // namespace filament_core::reference
