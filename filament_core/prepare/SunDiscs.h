// SPDX-License-Identifier: Apache-2.0
/// SunDiscs: which suns a view shows in its sky, and where each pixel lies in their discs.
///   In      the lights of the scene, and the view.
///   Out: a SunDisc for each sun whose disc or halo the view may contain.
///   Disc    the luminance E / (pi sin^2 r) of a sun that gives E lux with the angular radius r; 0.001 degrees at
///           least.
///   Exact   in double precision. Pixels are counted from the position of the sun on screen, so that floats resolve the
///           smallest disc.
///   Thread  any; pure. Memory: the arena. Fails: std::bad_alloc.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"

#include <span>

namespace filament_core::prepare {

struct SunDiscs {
    std::span<const SunDisc> inView; ///< in the order of the scene
    uint32_t outOfView = 0;
};

SunDiscs findSunDiscs(Arena& arena, scene::Lights const& lights, ViewInput const& view);

} // namespace filament_core::prepare
