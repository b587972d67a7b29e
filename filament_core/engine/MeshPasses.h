// SPDX-License-Identifier: Apache-2.0
/// MeshPasses: MeshPass as a pass of a frame, the checks that it can be drawn, and requests for its pipelines.
///   In      a pass of the app and the target.   Out: what describeMeshPass() draws, in the frame arena.
///   Thread  the app thread.
///   Memory  the arena; requests as CompileQueue.
///   Fails   the checks: one line that names the material, the reason and the cure. std::bad_alloc.
#pragma once

#include "filament_core/engine/PostProcess.h"
#include "filament_core/passes/MeshPass.h"

#include <filament_core/MeshPass.h>

namespace filament_core::engine {

/// Before the frame is planned.
Result<void> checkMeshPass(Engine::Impl& engine, MeshPass const& pass, PassTargets const& to);
/// When it is known what is in view: vertices have what the material reads.
Result<void> checkMeshDraws(Engine::Impl& engine, MeshPass const& pass, prepare::ViewPacket const& view);

/// What a mesh pass sees of a view.
View viewOfMeshPass(View const& view, uint2 size);

/// Of a checked pass.
passes::MeshDraw* meshDrawOf(Engine::Impl& engine, Arena& arena, MeshPass const& pass);

/// Of the objects in view, once the graph was rehearsed.
void requestMeshPipelines(Engine::Impl& engine, passes::MeshDraw const& mesh);

} // namespace filament_core::engine
