// SPDX-License-Identifier: Apache-2.0
/// PlaceImages: the images of lights that a view needs, as shaders read them (shader::ImagedLight).
///   In      the lights that a view has kept, and their records.
///   Out     ViewPacket::images, and lights that name their place in it. Tables are not copied: those of the scene.
///   Limits  kMaxImagedLights, and kMaxImageWords for the tables of a view; further lights stay dark, and are counted.
///   Thread  the one that owns the arena.   Memory: the arena; 150 B a light of the view.
///   Fails   std::bad_alloc, and nothing has changed.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"

#include <span>

namespace filament_core::prepare {

/// `records`: parallel to packet.lights, into Lights::records.
void placeImages(Arena& arena, scene::Lights const& lights, std::span<const uint32_t> records, double3 cameraWorld,
                 ViewPacket& packet);

} // namespace filament_core::prepare
