// SPDX-License-Identifier: Apache-2.0
/// attachmentMemory: what the textures of a plan occupy. For reports.
///   In      a compiled graph.   Thread: one at a time.   Memory: none.   Fails: never.
#pragma once

#include "framegraph/CompiledGraph.h"

#include <cstdint>

namespace filament_core::framegraph {

/// Of all levels, layers and samples.
uint64_t bytesOf(GraphTextureDesc const& desc);

struct AttachmentMemory {
    uint64_t bytes = 0;  ///< of the memory that the graph's own textures take
    uint64_t inTile = 0; ///< of those, what devices with tile memory need no room for
    uint64_t saved = 0;  ///< of all textures together, by those that share memory; their lives do not overlap
};
AttachmentMemory attachmentMemory(CompiledGraph const& plan);

/// What the attachments of a pass that runs occupy, of each the level and layer that it draws to; 0 for one that does
/// not run.
uint64_t attachmentBytes(CompiledGraph const& plan, size_t pass);

} // namespace filament_core::framegraph
