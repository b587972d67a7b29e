// SPDX-License-Identifier: Apache-2.0
/// RasterStates: all of a pipeline but its program: culling, depth, stencil, blending, vertices. They follow from the
/// material, the raster state of its instance, and where it is drawn.
///   Thread  any; pure functions.   Memory: none.   Fails: never.
#pragma once

#include "filament_core/passes/PassSlot.h"

namespace filament_core::passes {

/// `raster`: that of the instance, as the pass of `slot` draws it.
backend::PipelineDesc surfaceStates(PassSlot const& slot, PipelineUse const& use, scene::InstanceRaster const& raster,
                                    scene::GeometryLayout const& geometry);
/// Of a triangle over the whole target: no vertices, no culling.
backend::PipelineDesc fullScreenStates(PassSlot const& slot, scene::Material const& material);

} // namespace filament_core::passes
