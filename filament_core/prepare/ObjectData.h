// SPDX-License-Identifier: Apache-2.0
/// writeObjects: the visible renderables as shaders read them, relative to the camera.
///   In      the order of drawing and the placements of the scene.   Out: 64 B an object, each byte written once, in
///           the memory that the upload command carries: no copy in between.
///   Thread  jobs over ranges; every object is a function of its own placement and the camera.
///   Fails   never. Cost: bench/filament_core/prepare; it reads one cache line and writes one.
#pragma once

#include "filament_core/prepare/FramePacket.h"
#include "jobsystem/JobSystem.h"

#include <span>

namespace filament_core::prepare {

/// The difference of positions is taken in double: it is small, the operands may not be.
shader::ObjectData objectData(scene::Placement const& placement, double3 const& cameraWorld);

/// objects.size() == list.size().
void writeObjects(jobs::JobSystem& jobs, ObjectList const& list, std::span<shader::ObjectData> objects);

} // namespace filament_core::prepare
