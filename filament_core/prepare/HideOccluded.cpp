// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/HideOccluded.h"

#include "filament_core/prepare/DrawList.h"
#include "filament_core/prepare/OcclusionBuffer.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

constexpr size_t kItemsOfJob = 512;

/// Of an item that may be an occluder: how large it looks.
struct SizedItem {
    float pixels = 0;
    uint32_t item = 0;
};

bool drawsNoFaces(scene::InstanceRaster const& raster) {
    return !raster.cullingDisabled && raster.culling == shader::Culling::FrontAndBack;
}

DrawnFaces facesOf(scene::InstanceRaster const& raster) {
    if (raster.cullingDisabled || raster.culling == shader::Culling::None) return DrawnFaces::All;
    return raster.culling == shader::Culling::Back ? DrawnFaces::Front : DrawnFaces::Back;
}

class OcclusionCulling {
public:
    OcclusionCulling(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables, ViewSpace const& space,
                     ViewInput const& view)
            : mJobs(jobs), mArena(arena), mRenderables(renderables), mSpace(space), mSize(view.size),
              mIsShadowMap(view.kind == ViewKind::Shadow) {}

    /// The items that are not hidden, in their order.
    std::span<const SortItem> visible(std::span<const SortItem> items) const {
        const std::span<const PlacedOccluder> occluders = choose(items);
        if (occluders.empty()) return items;
        const OcclusionBuffer buffer(mJobs, mArena, mSize, occluders, errorOfDepths());
        const auto hidden = mArena.arrayForOverwrite<bool>(items.size());
        jobs::parallelFor<"hide">(mJobs, items.size(), kItemsOfJob, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) hidden[i] = isHidden(buffer, items[i]);
        });
        const auto kept = mArena.arrayForOverwrite<SortItem>(items.size());
        size_t count = 0;
        for (size_t i = 0; i < items.size(); ++i) {
            if (!hidden[i]) kept[count++] = items[i];
        }
        return kept.first(count);
    }

private:
    float3 centerOf(uint32_t renderable) const {
        return float3(mRenderables.bounds.centerAt(renderable) - mSpace.cameraWorld);
    }

    DepthError errorOfDepths() const {
        if (mSpace.clipFromView[3][3] != 0) return kParallelDepthError;
        return mIsShadowMap ? kScaleFreeDepthError : kPerspectiveDepthError;
    }

    scene::InstanceRaster rasterOf(SortItem const& item) const {
        scene::InstanceRaster const& raster = mRenderables.drawables[drawableOf(item.draw)].material->raster;
        return mIsShadowMap ? scene::inShadowMaps(raster) : raster;
    }

    float pixelsOf(SortItem const& item) const {
        if (!mRenderables.drawables.use(drawableOf(item.draw)).occludes || drawsNoFaces(rasterOf(item))) return 0;
        if (fadeOf(item.draw) != 0) return 0; // has holes where the other level of detail is seen, or is not there
        const float3 center = centerOf(item.renderable);
        const float radius = glm::length(mRenderables.bounds.halfExtentAt(item.renderable));
        const float4 clip = mSpace.clipFromWorld * float4(center, 1);
        const float scale = std::abs(mSpace.clipFromView[1][1]) * static_cast<float>(mSize.y);
        return radius * scale / std::max(clip.w, radius * 1e-3f); // beside the camera: as large as any
    }

    std::span<const PlacedOccluder> choose(std::span<const SortItem> items) const {
        const auto sizes = mArena.arrayForOverwrite<float>(items.size());
        jobs::parallelFor<"occluders">(mJobs, items.size(), kItemsOfJob, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) sizes[i] = pixelsOf(items[i]);
        });
        // In small maps many casters are small, and cost as much to draw as in large ones.
        const float smallest = mIsShadowMap ? std::min(kSmallestPixels, static_cast<float>(mSize.y) * kSmallestShare)
                                            : kSmallestPixels;
        const auto sized = mArena.arrayForOverwrite<SizedItem>(items.size());
        size_t count = 0;
        for (uint32_t i = 0; i < items.size(); ++i) {
            if (sizes[i] >= smallest) sized[count++] = { sizes[i], i };
        }
        const size_t chosen = std::min(count, kMostOccluders);
        // Ties are broken by position: which occluders are chosen must not depend on the sorting of the C++ library.
        std::ranges::partial_sort(sized.first(count), sized.begin() + static_cast<ptrdiff_t>(chosen),
                                  [](SizedItem const& a, SizedItem const& b) {
                                      return a.pixels != b.pixels ? a.pixels > b.pixels : a.item < b.item;
                                  });
        const auto occluders = mArena.array<PlacedOccluder>(chosen);
        for (size_t i = 0; i < chosen; ++i) occluders[i] = placed(items[sized[i].item]);
        return occluders;
    }

    PlacedOccluder placed(SortItem const& item) const {
        scene::Placement const& placement = mRenderables.placement[item.renderable];
        scene::Drawable const& drawable = mRenderables.drawables[drawableOf(item.draw)];
        double4x4 world(1.0); // as objectData() places it
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                world[column][row] = static_cast<double>(placement.rows[static_cast<size_t>(row)][column]);
        }
        world[3] = double4(placement.translation - mSpace.cameraWorld, 1);
        return { .mesh = drawable.geometry.occluder,
                 .clipFromObject = double4x4(mSpace.clipFromWorld) * world,
                 .faces = facesOf(rasterOf(item)),
                 .mirrored = isMirrored(item.draw) };
    }

    bool isHidden(OcclusionBuffer const& buffer, SortItem const& item) const {
        const bool mayBeCulled = (mRenderables.flags[item.renderable] & scene::kCulled) != 0;
        const scene::Drawables::Use use = mRenderables.drawables.use(drawableOf(item.draw));
        // What writes stencil values is drawn even where it is hidden: a failed depth test may change them as well.
        return mayBeCulled && use.staysInBounds && (use.order & scene::Drawables::kStencilWriteOrder) == 0 &&
               buffer.hides(mSpace.clipFromWorld, centerOf(item.renderable),
                            mRenderables.bounds.halfExtentAt(item.renderable));
    }

    jobs::JobSystem& mJobs;
    Arena& mArena;
    scene::Renderables const& mRenderables;
    ViewSpace const& mSpace;
    uint2 mSize;
    bool mIsShadowMap;
};

uint64_t trianglesOf(std::span<const DrawCall> draws) {
    uint64_t triangles = 0;
    for (DrawCall const& draw : draws) triangles += uint64_t{ draw.geometry->indexCount / 3 } * draw.instanceCount;
    return triangles;
}

} // namespace

void hideOccluded(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables, ViewSpace const& space,
                  ViewInput const& view, ViewPacket& packet) {
    const std::span<const SortItem> all = packet.objects.order;
    const std::span<const SortItem> early = itemsBefore(all, kLateKey);
    if (early.size() < kObjectsWorthHiding || !renderables.drawables.hasOccluders()) return;
    const std::span<const SortItem> kept = OcclusionCulling(jobs, arena, renderables, space, view).visible(early);
    const size_t hidden = early.size() - kept.size();
    if (hidden == 0) return;

    // Later draws keep their places in a window of objects, on which the counts of their draw calls depend, and with
    // these what other steps of the frame say of them. So whole windows leave, and what remains of the last is a gap.
    const size_t removed = hidden / shader::kObjectsPerWindow * shader::kObjectsPerWindow;
    const auto order = arena.arrayForOverwrite<SortItem>(all.size() - removed);
    std::ranges::copy(kept, order.begin());
    std::ranges::copy(early.last(hidden - removed), order.begin() + static_cast<ptrdiff_t>(kept.size()));
    std::ranges::copy(all.subspan(early.size()), order.begin() + static_cast<ptrdiff_t>(early.size() - removed));
    const auto blended = arena.copy(packet.blended);
    for (DrawCall& draw : blended) draw.firstObject -= static_cast<uint32_t>(removed);

    ViewCounts drawn;
    const DrawLists draws = mergeInstances(jobs, arena, renderables, order.first(kept.size()), drawn);
    packet.counts.triangles = packet.counts.triangles - trianglesOf(packet.opaque) + drawn.triangles;
    packet.counts.visible -= static_cast<uint32_t>(hidden);
    packet.counts.occluded = static_cast<uint32_t>(hidden);
    packet.opaque = draws.opaque;
    packet.blended = blended;
    packet.objects.order = order;
}

} // namespace filament_core::prepare
