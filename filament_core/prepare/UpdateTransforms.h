// SPDX-License-Identifier: Apache-2.0
/// updateTransforms: brings world transforms up to date with what the user changed, and what hangs at nodes with them,
/// skins last: their bones are where the joints are then.
///   In      the nodes of a scene and which of them changed.   Out: their world transforms, the placement and bounds of
///           renderables, the positions and directions of lights.
///   Thread  the app thread, which works along; a level of more than kTransformGrain changed nodes is shared with the
///           workers, a smaller one is not worth waking anybody for.
///   Bits    the same for any number of workers: a node is computed from its parent and itself, whoever does it.
///   Memory  none of its own; Transforms reuses its queue.
///   Fails   never. Cost: in proportion to what changed; one test without changes. bench/filament_core/prepare.
#pragma once

#include "filament_core/scene/SceneData.h"
#include "jobsystem/JobSystem.h"

#include <cstddef>

namespace filament::prepare {

/// Nodes a range: 4 us of nodes alone, 10 us of nodes with a renderable each. 128 to 512 measured alike, 4096 slower.
inline constexpr size_t kTransformGrain = 256;

void updateTransforms(jobs::JobSystem& jobs, scene::SceneData& scene);

} // namespace filament::prepare
