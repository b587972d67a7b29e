// SPDX-License-Identifier: Apache-2.0
/// From visible renderables to draw calls, one function per step; prepareFrame calls them in this order, with
/// sortItems() (SortItems.h) in between.
///   Thread  jobs over ranges; anything that depends on earlier ranges is a prefix sum between two loops.
///   Memory  the arena: 16 B per visible renderable, 32 B per draw call.
#pragma once

#include "filament_core/prepare/CullRenderables.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewInput.h"
#include "shaders/interface/ShaderInterface.h"

#include <span>

namespace filament_core::prepare {

/// Items that one job merges at a time: whole windows, so that every range begins a draw call.
inline constexpr size_t kMergeRange = 16 * shader::kObjectsPerWindow;

/// When refractive objects are drawn.
enum class RefractionOrder : uint8_t {
    Any,         ///< like anything opaque: there is no refraction
    FrontToBack, ///< after the copy of the scene colour
    BackToFront, ///< after the copy; each shows those behind it
};

/// What is visible and may be composed in any order: it has the default place, and blendsInAnyOrder().
struct AnyOrderExtent {
    uint32_t count = 0;
    uint32_t nearest = ~0u, farthest = 0; ///< depthBits() of those in front of the camera
};
AnyOrderExtent findAnyOrder(jobs::JobSystem& jobs, Arena& arena, scene::Drawables const& drawables,
                            VisibleItems const& visible);

/// What orders the draws of a view, besides their own state and depth.
struct DrawOrder {
    ViewKind kind = ViewKind::Color;
    RefractionOrder refraction = RefractionOrder::Any;
    bool composes = false; ///< what may be composed in any order is
    uint32_t farthest = 0; ///< of AnyOrderExtent
};

/// The visible renderables without gaps, with their keys (SortKey.h), still in the order of the scene; then the levels
/// of detail that vanish, in that order.
std::span<SortItem> writeKeys(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                              VisibleItems const& visible, LevelChoice const& levels = {}, DrawOrder const& order = {});

/// The part of a sorted list with keys below `key`: kLateKey for what comes before the sky, kPictureEndKey for what
/// refracting objects see.
std::span<const SortItem> itemsBefore(std::span<const SortItem> sorted, uint64_t key);

/// How many of `draws` draw items before this one, which starts a draw.
size_t drawsBefore(std::span<const DrawCall> draws, size_t item);

struct DrawLists {
    std::span<const DrawCall> opaque, blended; ///< before and after the sky
};

/// Neighbours of one draw become one instanced draw call; none crosses a window of shader::kObjectsPerWindow objects.
/// Blended neighbours merge too, because instances draw in order. Objects with two passes get two draw calls each.
DrawLists mergeInstances(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                         std::span<const SortItem> items, ViewCounts& counts);

} // namespace filament_core::prepare
