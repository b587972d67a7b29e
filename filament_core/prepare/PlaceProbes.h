// SPDX-License-Identifier: Apache-2.0
/// placeProbes: the reflection probes that a view uses, as shaders read them (shader::ReflectionProbe).
///   In      the probes of the scene, the view with the boxes of what is lit in it, and what the renderer's array of
///           cubes holds.
///   Out     a ProbePacket; the view's uniforms have the factor of a scene that only probes light.
///   Choice  those that reach a lit surface in the frustum, the nearest to the camera first; in the order of their
///           volume. An array that holds a cube keeps it where it is, so that few are copied. The environment is left
///           out where each surface lies in some box.
///   Bits    which layer a cube has changes none, nor does the number of workers.
///   Thread  the one that owns the arena; jobs over ranges of boxes.
///   Memory  the arena: 24 B a visible object, 16 B a probe of the scene, and shader::ProbeUniforms.
///   Fails   std::bad_alloc.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewInput.h"
#include "jobsystem/JobSystem.h"

namespace filament_core::prepare {

/// The box of an object in view; its centre is relative to the camera.
struct LitBox {
    float3 center, halfExtent;
};
/// Of an object that no light changes: meets no box of a probe, and sticks out of none.
inline constexpr LitBox kUnlitBox{ float3(0), float3(-1e30f) };

/// By place in `objects`.
std::span<const LitBox> litBoxes(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                                 ObjectList const& objects);

ProbePacket placeProbes(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                        HeldProbes const& held, std::span<const LitBox> lit, ViewPacket& packet);

} // namespace filament_core::prepare
