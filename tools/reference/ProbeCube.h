// SPDX-License-Identifier: Apache-2.0
/// traceProbe: what a reflection probe sees from a camera's place, by paths: the truth of the engine's captureProbe().
///   Out     a KTX 2.0 file of half floats along the axes of the world, times the camera's exposure. It is read as
///           panoramas are, and cmgen filters it.
///   Thread  any; works on the job system.   Fails: as render().
#pragma once

#include "tools/reference/Reference.h"

#include <cstddef>
#include <vector>

namespace filament_core::reference {

/// `view`: its camera's place and exposure count. `size`: texels of a side.
Result<std::vector<std::byte>> traceProbe(TracedScene const& scene, ReferenceView view, uint32_t size,
                                          ReferenceSettings const& settings, jobs::JobSystem& jobs,
                                          Progress const& progress);

} // namespace filament_core::reference
