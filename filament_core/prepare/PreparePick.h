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
#include <filament_core/SectionPlanes.h>

#include <optional>

namespace filament_core::prepare {

inline constexpr uint32_t kMostCandidates = 4096;

struct PreparedPick {
    FramePacket packet;
    std::span<const uint32_t> renderables; ///< of each draw but those of `fronts`: its position in the scene
    /// Draws after these, of front faces alone: of which candidate. What section planes cut shows a cap where its back
    /// faces are nearer.
    std::span<const uint32_t> fronts;
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

/// The same on the cap that is seen where the ray to `point`, on a back face, enters what `section` leaves; none: it
/// enters nowhere before that, or only in front of the near plane.
std::optional<PickedPoint> pickedCap(SectionPlanes const& section, Camera const& camera, PickedPoint const& point);

/// Whether the point lies behind one of the planes that the ray to it may leave what is kept through; of
/// SectionCut::Each.
bool isBehindSection(SectionPlanes const& section, Camera const& camera, PickedPoint const& point);

/// Among the renderables of its node, in the order in which they were added; 0 without a node.
uint32_t primitiveOf(scene::SceneData const& scene, Renderable renderable);

} // namespace filament_core::prepare
