// SPDX-License-Identifier: Apache-2.0
/// Tone-mapping pass: scene-linear light -> what an 8-bit display buffer stores.
///   Reads only the pixel that it writes, so that it can be a subpass of the colour pass; where the graph cannot merge
///   it (MSAA, a device without subpass inputs) it samples instead. Same arithmetic, same bits.
#pragma once

#include "filament_core/passes/FrameContext.h"

namespace filament::passes {

/// The two forms of the post-process material, specialised to the view's tone mapper.
struct ToneMapMaterials {
    scene::Material* merged = nullptr;  ///< reads a subpass input
    scene::Material* sampled = nullptr; ///< reads a texture of the same size
    backend::TextureHandle table{};     ///< of materials that look colours up (ToneTable.h); none: they compute them
};

framegraph::PassId addToneMapPass(framegraph::FrameGraph& graph, FrameContext const* context,
                                  ToneMapMaterials materials, framegraph::TextureId color,
                                  framegraph::TextureId display);

} // namespace filament::passes
