// SPDX-License-Identifier: Apache-2.0
/// Flare passes: ghosts and halo of what is bright, as the surfaces of a lens reflect them.
///   Draws   targets.flare: what each block of pixels of targets.color gets of them. The finish pass adds it, and takes
///           the same light from where it was.
///   How     the mean of what is brighter than the threshold, in blocks, and halves of that down to one texel; each
///           ghost and the halo gather from the level that is as coarse as their own blur.
///   Skips   all of it, unless the frame's demand needs it; on the device, the gathering, if nothing is bright enough.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

#include <array>

namespace filament_core::passes {

/// Pixels of a side that become one texel: a power of two. Images of any size have 90 to 180 rows of blocks, if they
/// have so many pixels.
uint32_t flareBlock(uint32_t height);

inline constexpr size_t kMostGhosts = 8;

/// As flare.mat reads it.
struct FlareGhost {
    float scale = 0;  ///< the image is read at so many times the distance of the pixel from its middle
    float radius = 0; ///< in pixels of what is read
    float level = 0;
    float share = 0; ///< of the light above the threshold; 0: there is no such ghost
};

/// For an image `height` pixels high.
std::array<FlareGhost, kMostGhosts> flareGhosts(LensFlare const& flare, uint32_t height);
/// Radius and half of the width in pixels, level, share.
float4 flareHalo(LensFlare const& flare, uint32_t height);
/// Of the light above the threshold, that goes into all of them.
float flareShare(LensFlare const& flare);

void addFlarePasses(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
