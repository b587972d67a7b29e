// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DrawList.h"

#include <algorithm>

namespace filament_core::prepare {
namespace {

struct RangeDraws {
    uint32_t first = 0; // first the range's count, then the sum of the counts before it
    uint64_t triangles = 0;
};

// What drawing order depends on besides state. Nothing but casters is drawn into shadow maps, all of which leave their
// depth once: there nothing is.
uint32_t specialOrders(DrawOrder const& order) {
    using scene::Drawables;
    if (order.kind == ViewKind::Shadow) return 0;
    return Drawables::kBlendedOrder | Drawables::kTwoPassesOrder | Drawables::kNoDepthWriteOrder |
           Drawables::kNoDepthTestOrder | Drawables::kStencilWriteOrder | (order.composes ? Drawables::kAnyOrder : 0) |
           (order.refraction == RefractionOrder::Any ? 0 : Drawables::kReadsSceneColorOrder);
}

Composed composedAs(scene::Drawables::Use use, uint32_t depth, uint32_t special, DrawOrder const& order) {
    if (!order.composes || use.place != kDefaultPlace) return Composed::Behind;
    if (special & scene::Drawables::kAnyOrder) return Composed::InAnyOrder;
    // What keeps its order is drawn before the composed objects only if it lies behind all of them. If it lies among
    // them, no place is right for all pixels, and it is drawn over them.
    return depth > order.farthest ? Composed::Behind : Composed::InOrder;
}

uint64_t keyOf(scene::Drawables::Use use, SortItem const& item, DepthSpan span, int hidden, uint32_t special,
               DrawOrder const& order) {
    using scene::Drawables;
    const auto depth = static_cast<uint32_t>(item.key);
    // Several properties may apply to an object, and the first in this list decides. Transparent objects need all that
    // is opaque below them, and what writes stencil values comes before what may test them.
    if (special & Drawables::kBlendedOrder) return blendedKey(depth, use.place, composedAs(use, depth, special, order));
    if (special & Drawables::kStencilWriteOrder) return opaqueKey(use.order, item.draw, kStencilSlice, depth);
    if (special & Drawables::kReadsSceneColorOrder)
        return order.refraction == RefractionOrder::BackToFront ? layeredKey(depth) : refractingKey(depth);
    if (special & (Drawables::kNoDepthWriteOrder | Drawables::kNoDepthTestOrder))
        return lateKey(depth, (special & Drawables::kNoDepthTestOrder) != 0, use.place);
    const uint32_t slice = sliceStart(span, use.users >> hidden, coarseStep(depth));
    return opaqueKey(use.order, item.draw, std::max(slice, kFirstSlice), depth);
}

bool startsDraw(std::span<const SortItem> items, size_t i) {
    return i % shader::kObjectsPerWindow == 0 || items[i].draw != items[i - 1].draw || isDrawnTwice(items[i].draw) ||
           isLayered(items[i].key);
}

uint32_t countDraws(std::span<const SortItem> items, size_t begin, size_t end) {
    uint32_t count = 0;
    for (size_t i = begin; i < end; ++i) count += startsDraw(items, i) + isDrawnTwice(items[i].draw);
    return count;
}

DrawCall drawCall(scene::Renderables const& renderables, std::span<const SortItem> items, size_t first, size_t end) {
    const uint32_t draw = items[first].draw;
    scene::Drawable const& drawable = renderables.drawables[drawableOf(draw)];
    return { drawable.material,
             &drawable.geometry,
             static_cast<uint32_t>(first),
             static_cast<uint32_t>(end - first),
             isMirrored(draw),
             drawable.properties,
             isDrawnTwice(draw) ? DrawPass::First : DrawPass::Only,
             scene::deformationAt(renderables, items[first].renderable),
             fadeOf(draw) };
}

void widen(AnyOrderExtent& extent, uint32_t depth) {
    ++extent.count;
    if (depth > 0) extent.nearest = std::min(extent.nearest, depth);
    extent.farthest = std::max(extent.farthest, depth);
}

// Returns the number of triangles in the range.
uint64_t writeDraws(scene::Renderables const& renderables, std::span<const SortItem> items, size_t begin, size_t end,
                    DrawCall* draws) {
    uint64_t triangles = 0;
    for (size_t first = begin; first < end;) {
        size_t next = first + 1;
        while (next < end && !startsDraw(items, next)) ++next;
        *draws = drawCall(renderables, items, first, next);
        const uint64_t drawn = static_cast<uint64_t>(draws->geometry->indexCount / 3) * draws->instanceCount;
        triangles += drawn;
        if (draws->pass == DrawPass::First) {
            draws[1] = draws[0];
            (++draws)->pass = DrawPass::Second;
            triangles += drawn;
        }
        ++draws;
        first = next;
    }
    return triangles;
}

} // namespace

AnyOrderExtent findAnyOrder(jobs::JobSystem& jobs, Arena& arena, scene::Drawables const& drawables,
                            VisibleItems const& visible) {
    const auto ranges = arena.array<AnyOrderExtent>(visible.firsts.size() - 1);
    jobs::parallelFor<"any order">(jobs, visible.slots.size(), kCullRange, [&](size_t begin, size_t) {
        // The ranges are those of culling: `firsts` has their borders.
        const size_t range = begin / kCullRange, count = visible.firsts[range + 1] - visible.firsts[range];
        for (SortItem const& item : visible.slots.subspan(begin, count)) {
            const scene::Drawables::Use use = drawables.use(drawableOf(item.draw));
            if ((use.order & scene::Drawables::kAnyOrder) && use.place == kDefaultPlace)
                widen(ranges[range], static_cast<uint32_t>(item.key));
        }
    });
    AnyOrderExtent all;
    for (AnyOrderExtent const& range : ranges) {
        all.count += range.count;
        all.nearest = std::min(all.nearest, range.nearest);
        all.farthest = std::max(all.farthest, range.farthest);
    }
    return all;
}

std::span<SortItem> writeKeys(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                              VisibleItems const& visible, LevelChoice const& levels, DrawOrder const& order) {
    scene::Drawables const& drawables = renderables.drawables;
    const auto all = arena.arrayForOverwrite<SortItem>(visible.count() + visible.fading);
    const auto items = all.first(visible.count());
    const uint32_t specials = specialOrders(order);
    // The visible share of the scene as a power of two: the members of a draw are assumed to be visible in the same
    // proportion.
    const int hidden = static_cast<int>(std::bit_width(visible.slots.size()) - std::bit_width(items.size()));
    jobs::parallelFor<"sort keys">(jobs, visible.slots.size(), kCullRange, [&](size_t begin, size_t) {
        const size_t range = begin / kCullRange;
        SortItem const* from = visible.slots.data() + begin;
        for (size_t i = visible.firsts[range]; i < visible.firsts[range + 1]; ++i, ++from) {
            const scene::Drawables::Use use = drawables.use(drawableOf(from->draw));
            static_assert(scene::Drawables::kTwoPassesOrder << 1 == kDrawnTwice);
            const uint32_t special = use.order & specials;
            items[i] = { keyOf(use, *from, visible.spanOf(from->draw), hidden, special, order), from->renderable,
                         from->draw | (special & scene::Drawables::kTwoPassesOrder) << 1 };
        }
    });
    if (visible.fading == 0) return items;
    // Few, and for a few frames.
    SortItem* next = all.data() + items.size();
    for (SortItem const& item : items) {
        if (fadeOf(item.draw) == 0) continue;
        const uint32_t finest = renderables.drawable[item.renderable];
        const LevelChoice::Vanishing other = levels.vanishing(item.renderable, finest, drawableOf(item.draw));
        const uint32_t draw = drawOf(other.drawable, isMirrored(item.draw));
        // What fades is opaque and has no other order than that of its depth, which the key of the other level has.
        const uint64_t key = (item.key & ~kDrawableKeyMask) | uint64_t{ other.drawable } << kDrawableKeyShift;
        *next++ = { key, item.renderable, draw | fadeBits(static_cast<LevelFade>(-other.fade)) };
    }
    return all;
}

std::span<const SortItem> itemsBefore(std::span<const SortItem> sorted, uint64_t key) {
    const auto isBefore = [=](SortItem const& item) { return item.key < key; };
    return { sorted.begin(), std::ranges::partition_point(sorted, isBefore) };
}

size_t drawsBefore(std::span<const DrawCall> draws, size_t item) {
    const auto isBefore = [=](DrawCall const& draw) { return draw.firstObject < item; };
    return static_cast<size_t>(std::ranges::partition_point(draws, isBefore) - draws.begin());
}

DrawLists mergeInstances(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                         std::span<const SortItem> items, ViewCounts& counts) {
    const auto ranges = arena.arrayForOverwrite<RangeDraws>((items.size() + kMergeRange - 1) / kMergeRange);
    jobs::parallelFor<"count draws">(jobs, items.size(), kMergeRange, [&](size_t begin, size_t end) {
        ranges[begin / kMergeRange].first = countDraws(items, begin, end);
    });
    uint32_t count = 0;
    for (RangeDraws& range : ranges) range.first = std::exchange(count, count + range.first);

    const auto draws = arena.arrayForOverwrite<DrawCall>(count);
    jobs::parallelFor<"merge">(jobs, items.size(), kMergeRange, [&](size_t begin, size_t end) {
        RangeDraws& range = ranges[begin / kMergeRange];
        // The counts of all earlier ranges are known: each job writes where its draws will stay.
        range.triangles = writeDraws(renderables, items, begin, end, draws.data() + range.first);
    });
    for (RangeDraws const& range : ranges) counts.triangles += range.triangles;

    // The first item after the sky or the copied colour starts a draw, because items of one material share its place.
    const size_t early = drawsBefore(draws, itemsBefore(items, kLateKey).size());
    return { draws.first(early), draws.subspan(early) };
}

} // namespace filament_core::prepare
