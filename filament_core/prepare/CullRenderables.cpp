// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/CullRenderables.h"

#include "filament_core/prepare/CullBlocks.h"
#include "filament_core/prepare/LoadBoxes.h"

#include <array>
#include <atomic>
#include <cstring>

namespace filament_core::prepare {
namespace {

using scene::Renderables;
using simd::Float8;
using simd::kLanes;

static_assert(kCullRange % 64 == 0, "only the last range of a scene has boxes left over, and words of bits");

struct Tally {
    uint32_t visible = 0, outOfView = 0, nothingToDraw = 0, inOtherLayers = 0, tooSmall = 0, fading = 0;
    uint64_t trianglesSaved = 0;
};

/// Bit or lane i: renderable first + i.
struct Seen8 {
    uint32_t visible = 0, nothingToDraw = 0, inOtherLayers = 0, mayBeTooSmall = 0;
    std::array<float, kLanes> depth;
};

// Both ends of the span in one word that only decreases: the nearest step, and above it the distance of the farthest
// step from the last. Relaxed order suffices, because the result does not depend on the order, and the end of the loop
// publishes it. Using steps instead of exact depths makes changes rare: a draw changes a few dozen times, not once per
// renderable.
void extend(uint16_t& shared, uint32_t step) {
    std::atomic_ref<uint16_t> span(shared);
    uint16_t seen = span.load(std::memory_order_relaxed);
    for (;;) {
        const uint32_t nearest = std::min<uint32_t>(seen & 0xFFu, step);
        const uint32_t inverted = std::min<uint32_t>(seen >> 8, 0xFFu - step);
        const auto wanted = static_cast<uint16_t>(inverted << 8 | nearest);
        if (wanted == seen || span.compare_exchange_weak(seen, wanted, std::memory_order_relaxed)) return;
    }
}

class RangeCuller {
public:
    RangeCuller(Renderables const& renderables, ViewSpace const& space, ViewKind kind, std::span<uint16_t> spans,
                LevelChoice const& levels)
            : mRenderables(renderables), mSpace(space), mFrustum(space.frustum), mSpans(spans), mLevels(levels),
              mIsShadow(kind == ViewKind::Shadow) {}

    /// Writes the visible renderables of [begin, end) to `slots`.
    [[gnu::flatten]] Tally cull(size_t begin, size_t end, SortItem* slots) const {
        Tally tally;
        SortItem* next = slots;
        // Which renderables are tested one by one follows from the size of the scene alone, not from the number of
        // workers: any difference of rounding between the two functions is the same in every run.
        size_t i = begin;
        for (; i + kLanes <= end; i += kLanes) next = keep(see<kLanes>(i), i, next, tally);
        for (; i < end; ++i) next = keep(see1(i), i, next, tally);
        return finished(tally, begin, end, static_cast<uint32_t>(next - slots));
    }

    /// The same, testing only fours with a bit in `may`: no other renderable is in view. Each bit is a renderable from
    /// `begin` on.
    [[gnu::noinline]] Tally cullAmong(std::span<const uint64_t> may, size_t begin, size_t end, SortItem* slots) const {
        std::array<Few, kCullRange / kLanes> few;
        size_t count = 0;
        for (size_t word = 0; word < may.size(); ++word) {
            for (uint64_t left = may[word]; left != 0;) {
                const auto byte = static_cast<uint32_t>(std::countr_zero(left)) / 8;
                const uint64_t bits = left >> byte * 8 & 0xFF;
                const bool hasLow = (bits & 0xF) != 0, hasHigh = bits > 0xF;
                const size_t first = begin + word * 64 + byte * 8;
                few[count++] = { hasLow ? first : first + 4, hasLow && hasHigh ? 8u : 4u };
                left &= ~(uint64_t{ 0xFF } << byte * 8);
            }
        }
        Tally tally;
        SortItem* next = slots;
        for (size_t i = 0; i < count; ++i) {
            if (i + kFewAhead < count) prefetch(few[i + kFewAhead]);
            const bool isWhole = few[i].first + few[i].count <= end;
            if (few[i].count == 4 && isWhole)
                next = keep(see<4>(few[i].first), few[i].first, next, tally);
            else
                next = keepEight(few[i].first, std::min(end, few[i].first + few[i].count), next, tally);
        }
        tally.nothingToDraw = tally.inOtherLayers = 0; // of all instead
        countLeftOut(begin, end, tally);
        return finished(tally, begin, end, static_cast<uint32_t>(next - slots));
    }

private:
    /// Four or eight renderables.
    struct Few {
        size_t first = 0;
        uint32_t count = 0;
    };
    static constexpr size_t kFewAhead = 8;

    SortItem* keepEight(size_t i, size_t end, SortItem* next, Tally& tally) const {
        if (i + kLanes <= end) return keep(see<kLanes>(i), i, next, tally);
        for (; i < end; ++i) next = keep(see1(i), i, next, tally);
        return next;
    }

    static Tally finished(Tally tally, size_t begin, size_t end, uint32_t visible) {
        tally.visible = visible;
        tally.outOfView = static_cast<uint32_t>(end - begin) - tally.visible - tally.nothingToDraw -
                          tally.inOtherLayers - tally.tooSmall;
        return tally;
    }

    void prefetch(Few few) const {
        using Four = scene::BoundsColumns::Four;
        auto const* const boxes = reinterpret_cast<const std::byte*>(&mRenderables.bounds.four(few.first / 4));
        for (size_t line = 0; line < few.count / 4 * sizeof(Four); line += 64) __builtin_prefetch(boxes + line);
        __builtin_prefetch(&mRenderables.drawable[few.first]);
    }

    /// Without a test of boxes, sixteen bytes at a time.
    void countLeftOut(size_t begin, size_t end, Tally& tally) const {
        using Byte16 [[gnu::vector_size(16)]] = uint8_t;
        static_assert(kCullRange / sizeof(Byte16) <= 255, "counts are bytes");
        const auto mask = static_cast<uint8_t>(scene::kNeverDrawn | scene::kCollapsed | (mIsShadow ? kNoCaster : 0));
        const Byte16 masks = Byte16{} + mask, visible = Byte16{} + mSpace.visibleLayers;
        Byte16 nothing{}, elsewhere{};
        size_t i = begin;
        for (; i + sizeof(Byte16) <= end; i += sizeof(Byte16)) {
            Byte16 flags, layers;
            std::memcpy(&flags, &mRenderables.flags[i], sizeof flags);
            const Byte16 isNothing = Byte16((flags & masks) != 0);
            nothing -= isNothing; // all ones: -1
            if (mSpace.visibleLayers == kAllLayers) continue;
            std::memcpy(&layers, &mRenderables.layers[i], sizeof layers);
            elsewhere -= Byte16((layers & visible) == 0) & ~isNothing;
        }
        for (size_t lane = 0; lane < sizeof(Byte16); ++lane) {
            tally.nothingToDraw += nothing[lane];
            tally.inOtherLayers += elsewhere[lane];
        }
        for (; i < end; ++i) {
            const bool isNothing = (mRenderables.flags[i] & mask) != 0;
            tally.nothingToDraw += isNothing;
            tally.inOtherLayers += !isNothing && (mRenderables.layers[i] & mSpace.visibleLayers) == 0;
        }
    }

    /// Of four only the low lanes count; `i` is a multiple of it.
    template <size_t kCount>
    [[gnu::always_inline]] Seen8 see(size_t i) const {
        const Box8 boxes = loadBoxes(mRenderables.bounds.four(i / 4), mRenderables.bounds.four(i / 4 + kCount / 8),
                                     mSpace.cameraWorld);
        uint64_t flags = 0;
        std::memcpy(&flags, &mRenderables.flags[i], kCount);
        Seen8 seen;
        seen.nothingToDraw = simd::bitOfEachByte(flags, kNeverDrawnBit) | simd::bitOfEachByte(flags, kCollapsedBit);
        if (mIsShadow)
            seen.nothingToDraw |=
                    simd::bitOfEachByte(flags, kCastsNoShadowsBit) | simd::bitOfEachByte(flags, kCannotCastBit);
        if (mSpace.visibleLayers != kAllLayers) seen.inOtherLayers = hidden<kCount>(i) & ~seen.nothingToDraw;
        const uint32_t mayBeCulled = simd::bitOfEachByte(flags, kCulledBit);
        constexpr uint32_t kAll = (1u << kCount) - 1;
        seen.visible = (mFrustum.intersects(boxes) | ~mayBeCulled) & ~seen.nothingToDraw & ~seen.inOtherLayers & kAll;
        // The exact test divides eight times for a box. It runs only for boxes that this one lets through, and that are
        // seen.
        seen.mayBeTooSmall = mSpace.pixels.mayMiss8(boxes.center, boxes.halfExtent) & mayBeCulled;
        simd::store8(seen.depth, simd::dot(mSpace.forward, boxes.center));
        return seen;
    }

    template <size_t kCount>
    uint32_t hidden(size_t i) const {
        constexpr uint64_t kOnes = 0x0101'0101'0101'0101, kLow7 = 0x7F7F'7F7F'7F7F'7F7F;
        uint64_t layers = 0;
        std::memcpy(&layers, &mRenderables.layers[i], kCount);
        // Eight masks as the bytes of one word: vectors of bytes would be needed for this test alone.
        const uint64_t shared = layers & mSpace.visibleLayers * kOnes;
        const uint64_t isShared = ((shared & kLow7) + kLow7) | shared; // bit 7 of each byte that is not zero
        return ~simd::bitOfEachByte(isShared, 7) & 0xFFu;
    }

    Seen8 see1(size_t i) const {
        const uint8_t flags = mRenderables.flags[i];
        const float3 center(mRenderables.bounds.centerAt(i) - mSpace.cameraWorld);
        const bool nothing = flags & (scene::kNeverDrawn | scene::kCollapsed | (mIsShadow ? kNoCaster : 0));
        const bool inView =
                !(flags & scene::kCulled) || intersects(mSpace.frustum, center, mRenderables.bounds.halfExtentAt(i));
        Seen8 seen;
        seen.nothingToDraw = nothing;
        seen.inOtherLayers = !nothing && (mRenderables.layers[i] & mSpace.visibleLayers) == 0;
        seen.visible = inView && !nothing && !seen.inOtherLayers;
        seen.mayBeTooSmall = !mSpace.pixels.isEmpty() && (flags & scene::kCulled) != 0;
        seen.depth[0] = glm::dot(mSpace.forward, center);
        return seen;
    }

    SortItem* keep(Seen8 const& seen, size_t first, SortItem* next, Tally& tally) const {
        tally.nothingToDraw += static_cast<uint32_t>(std::popcount(seen.nothingToDraw));
        tally.inOtherLayers += static_cast<uint32_t>(std::popcount(seen.inOtherLayers));
        for (uint32_t left = seen.visible; left != 0; left &= left - 1) {
            const auto lane = static_cast<uint32_t>(std::countr_zero(left));
            const uint32_t renderable = static_cast<uint32_t>(first) + lane;
            if ((seen.mayBeTooSmall >> lane & 1) != 0 && isTooSmall(renderable)) {
                ++tally.tooSmall;
                continue;
            }
            const uint32_t depth = depthBits(seen.depth[lane]);
            const bool mirrored = mRenderables.flags[renderable] & scene::kMirrored;
            const uint32_t finest = mRenderables.drawable[renderable];
            const uint32_t draw = drawOf(mLevels.isOn() ? levelFor(renderable, finest, tally) : finest, mirrored);
            // The span belongs to the level that is drawn: sort keys slice the members of a draw by depth, and each
            // level is a draw.
            extend(mSpans[draw], coarseStep(depth));
            const uint32_t fade = mLevels.isOn() ? fadeFor(renderable, draw, depth, tally) : 0;
            *next++ = { depth, renderable, draw | fade };
        }
        return next;
    }

    /// It is made of triangles inside of its box, none of which covers a sample.
    bool isTooSmall(uint32_t renderable) const {
        if (!mRenderables.drawables.use(mRenderables.drawable[renderable]).staysInBounds) return false;
        const float3 center(mRenderables.bounds.centerAt(renderable) - mSpace.cameraWorld);
        return mSpace.pixels.missesAll(center, mRenderables.bounds.halfExtentAt(renderable));
    }

    uint32_t levelFor(uint32_t renderable, uint32_t finest, Tally& tally) const {
        scene::Drawables const& drawables = mRenderables.drawables;
        const float3 center(mRenderables.bounds.centerAt(renderable) - mSpace.cameraWorld);
        const uint32_t level = mLevels.choose(renderable, finest, center, mRenderables.bounds.halfExtentAt(renderable));
        tally.trianglesSaved += drawables.level(finest).triangles - drawables.level(level).triangles;
        return level;
    }

    uint32_t fadeFor(uint32_t renderable, uint32_t draw, uint32_t depth, Tally& tally) const {
        const LevelChoice::Vanishing other =
                mLevels.vanishing(renderable, mRenderables.drawable[renderable], drawableOf(draw));
        if (other.drawable == scene::kNoLevel) return 0;
        ++tally.fading;
        extend(mSpans[drawOf(other.drawable, isMirrored(draw))], coarseStep(depth));
        return fadeBits(other.fade);
    }

    static constexpr uint32_t kCulledBit = std::countr_zero<uint32_t>(scene::kCulled);
    static constexpr uint32_t kNeverDrawnBit = std::countr_zero<uint32_t>(scene::kNeverDrawn);
    static constexpr uint32_t kCollapsedBit = std::countr_zero<uint32_t>(scene::kCollapsed);
    static constexpr uint32_t kCastsNoShadowsBit = std::countr_zero<uint32_t>(scene::kCastsNoShadows);

    static constexpr uint32_t kCannotCastBit = std::countr_zero<uint32_t>(scene::kCannotCast);
    static constexpr int kNoCaster = scene::kCastsNoShadows | scene::kCannotCast;

    Renderables const& mRenderables;
    ViewSpace const& mSpace;
    Frustum8 mFrustum;
    std::span<uint16_t> mSpans;
    LevelChoice const& mLevels;
    bool mIsShadow;
};

} // namespace

VisibleItems cullRenderables(jobs::JobSystem& jobs, Arena& arena, Renderables const& renderables,
                             ViewSpace const& space, ViewKind kind, ViewCounts& counts, LevelChoice const& levels) {
    const size_t ranges = (renderables.count() + kCullRange - 1) / kCullRange;
    // Each range writes to its own part of `slots`, and leaves a gap behind it. Sort keys close the gaps (writeKeys()),
    // so nothing is copied here.
    const auto slots = arena.arrayForOverwrite<SortItem>(renderables.count());
    const auto spans = arena.arrayForOverwrite<uint16_t>(drawOf(renderables.drawables.limit(), false));
    const auto tallies = arena.arrayForOverwrite<Tally>(ranges);
    std::ranges::fill(spans, VisibleItems::kNoSpan);
    const std::span<const uint64_t> may = cullBlocks(jobs, arena, renderables.blocks, space.frustum, space.cameraWorld);
    jobs::parallelFor<"cull">(jobs, renderables.count(), kCullRange, [&](size_t begin, size_t end) {
        const RangeCuller culler(renderables, space, kind, spans, levels);
        Tally& tally = tallies[begin / kCullRange];
        if (may.empty())
            tally = culler.cull(begin, end, &slots[begin]);
        else
            tally = culler.cullAmong(may.subspan(begin / 64, (end - begin + 63) / 64), begin, end, &slots[begin]);
    });

    const auto firsts = arena.arrayForOverwrite<uint32_t>(ranges + 1);
    Tally all;
    for (size_t range = 0; range < ranges; ++range) {
        firsts[range] = all.visible;
        all.visible += tallies[range].visible;
        all.outOfView += tallies[range].outOfView;
        all.nothingToDraw += tallies[range].nothingToDraw;
        all.inOtherLayers += tallies[range].inOtherLayers;
        all.tooSmall += tallies[range].tooSmall;
        all.fading += tallies[range].fading;
        all.trianglesSaved += tallies[range].trianglesSaved;
    }
    firsts[ranges] = all.visible;
    counts.renderables = renderables.count();
    counts.visible = all.visible;
    counts.outOfView = all.outOfView;
    counts.nothingToDraw = all.nothingToDraw;
    counts.inOtherLayers = all.inOtherLayers;
    counts.tooSmall = all.tooSmall;
    counts.fadingLevels = all.fading;
    counts.trianglesSaved = all.trianglesSaved;
    return { slots, firsts, spans, all.fading };
}

} // namespace filament_core::prepare
