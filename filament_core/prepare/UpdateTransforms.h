// SPDX-License-Identifier: Apache-2.0
/// updateTransforms: updates world transforms after changes by the user, and everything attached to the changed nodes.
/// Skins come last, because their bones follow the joints.
///   In      the nodes of a scene and which of them changed.   Out: their world transforms, the placement and bounds of
///           renderables, the positions and directions of lights.
///   Thread  the app thread, which takes part. Levels of more than kTransformGrain changed nodes are shared with the
///           workers; waking threads for smaller ones does not pay.
///   Bits    the same for any number of workers: a node depends only on its parent and itself.
///   Memory  none of its own; Transforms reuses its queue.
///   Fails   never. Cost: proportional to the changes; one test without changes. bench/filament_core/prepare.
#pragma once

#include "filament_core/scene/SceneData.h"
#include "jobsystem/JobSystem.h"

#include <cstddef>

namespace filament_core::prepare {

/// Nodes per range: 4 us of nodes alone, 10 us of nodes with a renderable each. 128 to 512 measured alike, 4096 slower.
inline constexpr size_t kTransformGrain = 256;

void updateTransforms(jobs::JobSystem& jobs, scene::SceneData& scene);

} // namespace filament_core::prepare
