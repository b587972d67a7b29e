// SPDX-License-Identifier: Apache-2.0
/// A pass of the app over the scene's surfaces (<filament_core/MeshPass.h>): what the main view shows, drawn once with
/// one material into all colours of a render target.
///   Reads   nothing of a frame; textures of the material are the app's.
///   Draws   draws, order and deformations of the main view; the variant 0 of the material. Depths of its own.
///   Skips   the second draw of materials with two passes: one material draws all.
///   Thread  the app thread.   Fails: std::bad_alloc. engine/MeshPasses.h has checked the material.
#pragma once

#include "filament_core/passes/Frame.h"

#include <array>
#include <span>
#include <string_view>

namespace filament_core::passes {

struct MeshDraw {
    scene::MaterialInstance const* material = nullptr;
    std::string_view name;                       ///< in the graph
    std::array<std::array<float, 4>, 4> clear{}; ///< of the attachments
    bool isKept = false;                         ///< drawn over what the colours hold
    bool keepsHoles = false;                     ///< drawn where the objects' own materials leave depths
    uint32_t slot = 0;                           ///< out: of PipelineCache; known once the graph was walked
    std::span<const prepare::DrawCall> draws;    ///< out: the same
};

/// `mesh` lives as long as the graph. `others`: the attachments 1, 2, ...
void describeMeshPass(framegraph::FrameGraph& graph, FrameContext const& context, MeshDraw& mesh,
                      FrameOutput const& output, std::span<const FrameOutput> others);

} // namespace filament_core::passes
