// SPDX-License-Identifier: Apache-2.0
/// cullRenderables: which renderables the view can see, how deep they are, and between which depths each draw lies.
///   In      the columns bounds, flags and drawable, and layers unless the view shows all; the frustum.
///   Out     the visible ones in the order of the scene, in ranges that still have gaps between them; writeKeys()
///           (DrawList.h) moves them together.
///   Visible unless it has nothing to draw, is in none of the view's layers, or may be dropped and its box lies outside
///           of one frustum plane, or misses all centres of pixels (PixelGrid.h). A box that is not a number is
///           visible: nothing proves it out of view.
///   Blocks  of renderables that rest (scene::RestingBlocks) are left out as a whole where their box is out of view:
///           the same result, faster.
///   Thread  jobs over ranges of the scene, eight boxes at a time (math/Simd.h); the bits of one at a time.
///   Memory  the arena: 16 B a renderable, 4 B a drawable.
///   Fails   never. Cost: bench/filament_core/prepare.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/ChooseLevels.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/SortKey.h"
#include "filament_core/prepare/ViewConstants.h"
#include "jobsystem/JobSystem.h"

#include <span>

namespace filament_core::prepare {

/// Renderables that one job culls at a time: about 10 us.
inline constexpr size_t kCullRange = 2048;

struct VisibleItems {
    static constexpr uint16_t kNoSpan = 0xFFFF; ///< of draws that have nothing visible
    std::span<const SortItem> slots;  ///< those of range r begin at r * kCullRange; their keys are depthBits()
    std::span<const uint32_t> firsts; ///< how many are visible before range r; one entry more than ranges
    std::span<const uint16_t> spans;  ///< by draw; read them with spanOf()
    uint32_t fading = 0; ///< of these: whose level of detail appears while another one vanishes, which is not in here

    uint32_t count() const { return firsts.back(); }
    bool isSeen(uint32_t draw) const { return spans[draw] != kNoSpan; }
    DepthSpan spanOf(uint32_t draw) const {
        const uint16_t span = spans[withoutFade(draw)];
        return { span & 0xFFu, 0xFFu - (span >> 8) };
    }
};

/// `levels`: which level of detail is visible of each.
VisibleItems cullRenderables(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                             ViewSpace const& space, ViewKind kind, ViewCounts& counts, LevelChoice const& levels = {});

} // namespace filament_core::prepare
