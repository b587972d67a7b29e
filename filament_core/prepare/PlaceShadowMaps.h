// SPDX-License-Identifier: Apache-2.0
/// placeShadowMaps: where the maps of a frame lie in the atlas.
///   In      the sizes of the maps wanted, the most important first, and what the atlas held so far.
///   Out     a tile each. A map that the atlas holds in the same size keeps its tile, if the others fit around it.
///   How     tiles are aligned to their size, as in a quadtree, so free texels never lie in gaps: whatever has no more
///           texels than the atlas fits if it is placed from the largest down. If it does not fit, the largest maps are
///           halved, the least important first; what does not even fit at kSmallestShadowMap gets no tile.
///   Thread  any; pure.   Memory: the arena.   Fails: std::bad_alloc.
#pragma once

#include "filament_core/prepare/ShadowMaps.h"

namespace filament_core::prepare {

struct ShadowMapRequest {
    uint64_t owner = 0;
    uint32_t size = 0; ///< a power of two, kSmallestShadowMap to kLargestShadowMap
};

struct PlacedShadowMaps {
    uint32_t atlasSize = 0; ///< the smallest power of two that has room; not below that of `held`, if that has room
    std::span<const ShadowTile> tiles; ///< parallel to the requests; size 0: left out
};

/// `largestAtlas`: a power of two, at least kSmallestShadowMap.
PlacedShadowMaps placeShadowMaps(Arena& arena, std::span<const ShadowMapRequest> requests, ShadowAtlas const& held,
                                 uint32_t largestAtlas);

/// Of an atlas with `size` texels a side: 4 B each for the depth, and 8 or 16 for moments and a third more for their
/// mips.
uint64_t atlasBytes(uint32_t size, ShadowMoments moments);
/// The largest atlas, in texels of a side, that takes no more than `bytes`; at least one of kSmallestShadowMap.
uint32_t atlasSizeForBytes(uint64_t bytes, ShadowMoments moments);

} // namespace filament_core::prepare
