// SPDX-License-Identifier: Apache-2.0
/// Hashes of what a view draws: contents, never addresses.
///   Thread  any; pure.   Memory: none.   Fails: never.
#pragma once

#include "filament_core/prepare/FramePacket.h"

namespace filament_core::prepare {

/// Of everything in a ViewPacket and behind it, deformations excepted.
uint64_t hashView(ViewPacket const& view, uint64_t seed);

/// Of everything that the depths of a shadow map of `mapSize` depend on: equal hashes, equal depths. Parameters, time
/// and globals count only for materials whose depth can depend on them; as does what transmits light into a coloured
/// map.
uint64_t hashShadowView(scene::SceneData const& scene, ViewPacket const& view, uint32_t mapSize, bool isColored);

} // namespace filament_core::prepare
