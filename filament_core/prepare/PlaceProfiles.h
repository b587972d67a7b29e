// SPDX-License-Identifier: Apache-2.0
/// PlaceProfiles: the light profiles that a view needs, as shaders read them (shader::kProfiledLightWords).
///   In      the lights that a view has kept, and their records.
///   Out     ViewPacket::profiles, and lights that name their place in it. Tables are not copied: those of the scene.
///   Limits  kMaxProfileWords for the tables of a view; lights of further profiles stay dark, and are counted.
///   Thread  the one that owns the arena.   Memory: the arena; 64 B a light of the view, 32 B a profile.
///   Fails   std::bad_alloc, and nothing has changed.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"

#include <span>

namespace filament_core::prepare {

/// `records`: parallel to packet.lights, into Lights::records.
void placeProfiles(Arena& arena, scene::Lights const& lights, std::span<const uint32_t> records, ViewPacket& packet);

} // namespace filament_core::prepare
