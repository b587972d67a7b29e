// SPDX-License-Identifier: Apache-2.0
/// The light that volumetric fog scatters towards the camera: a dispatch that sums it up along columns of cells, for
/// the materials of the colour pass to read (shaders/compute/fog_light.comp, docs/fog.md).
///   Demand  Effect::VolumetricFog; otherwise nothing is added.
///   Thread  the app thread.   Memory: a buffer of the graph, fogCellBytes().
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

/// After the shadow maps, before what reads FrameTargets::fogCells.
void addFogLightPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

/// Of FrameTargets::fogCells.
uint32_t fogCellBytes(FrameContext const& context);

/// Of what the frame leaves to the next one (Fog::volumetricFrames); 0: nothing.
uint32_t fogLightBytes(FrameContext const& context);

} // namespace filament_core::passes
