// SPDX-License-Identifier: Apache-2.0
/// Target mips: levels 1.. of a render target whose texels are sRGB codes, each the mean of the light of the level
/// above, by the area that its texels cover (MipMaps.h).
///   Why     the device would have to encode them, with bits that differ between processors (docs/conformance.md).
///   Draws   FrameTargets::target.
///   Skips   targets that generate no mips, and those of other formats: the device makes their mips.
#pragma once

#include "filament_core/passes/Frame.h"

namespace filament_core::passes {

/// After everything that draws to level 0.
void addTargetMips(framegraph::FrameGraph& graph, FrameContext const& context, FrameOutput const& output,
                   FrameTargets const& targets);

} // namespace filament_core::passes
