// SPDX-License-Identifier: Apache-2.0
/// preparePick: what may cover one pixel of a view, one draw for each object, so that each can be drawn by itself.
///   In      the current scene, the view without jitter, the pixel, and for what: nodes can be left out.
///   Out     a packet with one view: its opaque draws are the candidates, also those that blend, in the order in which
///           the view draws them. The uniforms are those of the view itself, so that what is drawn covers the same
///           pixels.
///   Limits  kMostCandidates; beyond, those whose boxes begin farthest away are left out.
///   Thread, memory, bits, fails: as prepareView().
#pragma once

#include "filament_core/prepare/PrepareView.h"

#include <filament_core/Objects.h>

namespace filament_core::prepare {

inline constexpr uint32_t kMostCandidates = 4096;

struct PreparedPick {
    FramePacket packet;
    std::span<const uint32_t> renderables; ///< of each draw: its position in the scene
};

/// `last`: the levels of detail that the last frame drew.
PreparedPick preparePick(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                         uint2 pixel, PickAim aim = PickAim::Anything, std::span<const DrawnLevel> last = {});

/// Of a depth that is reversed, the pixel's distance along the view, and the place there.
struct PickedPoint {
    double distanceMeters = 0;
    double3 positionWorld{ 0.0 };
};
PickedPoint pickedPoint(Camera const& camera, uint2 size, uint2 pixel, float depth);

/// Among the renderables of its node, in the order in which they were added; 0 without a node.
uint32_t primitiveOf(scene::SceneData const& scene, Renderable renderable);

} // namespace filament_core::prepare
