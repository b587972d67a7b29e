// SPDX-License-Identifier: Apache-2.0
/// placeProbes: the reflection probes that a view uses, as shaders read them (shader::ReflectionProbe).
///   In      the probes of the scene, the view, and what the renderer's array of cubes holds.
///   Out     a ProbePacket; the view's uniforms have the factor of a scene that only probes light.
///   Choice  those whose box the frustum meets, the nearest to the camera first; in the order of their volume. An array
///           that holds a cube keeps it where it is, so that few are copied.
///   Bits    which layer a cube has changes none.
///   Thread  the one that owns the arena.   Memory: the arena, 250 B a probe of the view and 16 B a probe of the scene.
///   Fails   std::bad_alloc.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewInput.h"

namespace filament_core::prepare {

ProbePacket placeProbes(Arena& arena, scene::SceneData const& scene, ViewInput const& view, HeldProbes const& held,
                        ViewPacket& packet);

} // namespace filament_core::prepare
