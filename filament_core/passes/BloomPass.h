// SPDX-License-Identifier: Apache-2.0
/// Bloom passes: light that a lens scatters around what is bright.
///   Draws   targets.bloom: what each pixel of targets.color scatters. The finish pass adds it.
///   How     the scene colour at half size, and half of that, until a texel is as wide as Bloom::radius; then each
///           level is added to the one before it (Jimenez 2014, "Next Generation Post Processing in Call of Duty:
///           Advanced Warfare"). Weights sum to 1: light is moved, not added. BloomResolution::Quarter begins with the
///           second level.
///   Skips   all of it, unless the frame's demand needs it.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

#include <filament_core/Quality.h>

namespace filament_core::passes {

/// Levels for a radius in pixels, with the first, which is as large as `resolution` says.
uint8_t bloomLevels(uint2 view, float radiusPixels, BloomResolution resolution);

void addBloomPasses(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
