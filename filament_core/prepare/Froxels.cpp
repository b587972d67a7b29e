// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/Froxels.h"

#include "filament_core/prepare/SliceLights.h"
#include "jobsystem/JobSystem.h"

#include <algorithm>
#include <numeric>

namespace filament_core::prepare {
namespace {

using shader::kMaxLightsOfFroxel;
using shader::PunctualLight;

struct DepthRange {
    float nearest = kEverywhere, farthest = 0; ///< of what limited lights reach; nearest > farthest: nothing
};

DepthRange depthsOf(std::span<const LightBounds> bounds) {
    DepthRange range;
    for (LightBounds const& light : bounds) {
        if (light.sphere.radius == kEverywhere) continue;
        range.nearest = std::min(range.nearest, std::max(light.sphere.center.z - light.sphere.radius, 0.0f));
        range.farthest = std::max(range.farthest, light.sphere.center.z + light.sphere.radius);
    }
    return range;
}

std::span<const LightBounds> findBounds(Arena& arena, std::span<const PunctualLight> lights, ViewSpace const& space,
                                        FroxelMargins margins) {
    const auto bounds = arena.arrayForOverwrite<LightBounds>(lights.size());
    std::ranges::transform(lights, bounds.begin(),
                           [&](PunctualLight const& light) { return boundsOf(light, space, margins); });
    return bounds;
}

// Square metres of an area; 1 for others.
float extentOf(PunctualLight const& light) {
    const float shape = light.colorIntensity.w;
    if (shape < float{ shader::kShapeRect }) return 1;
    const float3 x(light.directionScale), y(light.directionScale.w, light.offset.x, light.offset.w);
    const float square = glm::length(x) * glm::length(y);
    const bool isDisc =
            shape == float{ shader::kShapeDisc } || shape == float{ shader::kShapeDisc + shader::kShapeTwoSided };
    return (isDisc ? 3.14159265f : 4.0f) * square;
}

// As SelectLights: the luminance that arrives at the camera.
float importanceOf(PunctualLight const& light) {
    const float3 at(light.positionRange);
    const float luminance = glm::dot(float3(light.colorIntensity), float3(0.2126f, 0.7152f, 0.0722f));
    const float importance = luminance * extentOf(light) / std::max(glm::dot(at, at), 1e-4f);
    return importance > 0 ? importance : 0.0f;
}

std::span<const uint16_t> brightestFirst(Arena& arena, std::span<const PunctualLight> lights) {
    const auto order = arena.arrayForOverwrite<uint16_t>(lights.size());
    const auto importance = arena.arrayForOverwrite<float>(lights.size());
    std::ranges::transform(lights, importance.begin(), importanceOf);
    std::iota(order.begin(), order.end(), uint16_t{ 0 });
    std::ranges::sort(order, [&](uint16_t a, uint16_t b) {
        return importance[a] != importance[b] ? importance[a] > importance[b] : a < b;
    });
    return order;
}

bool isFull(std::span<const uint32_t> counts) {
    return std::ranges::any_of(counts, [](uint32_t count) { return count > kMaxLightsOfFroxel; });
}

/// The lists of all froxels, each with room for as many lights as it may have.
class Lists {
public:
    Lists(jobs::JobSystem& jobs, Arena& arena, SliceInput const& input)
            : mJobs(jobs), mInput(input), mRoom(std::min<size_t>(input.bounds.size(), kMaxLightsOfFroxel)),
              mCounts(arena.array<uint32_t>(input.grid.cells())),
              mEntries(arena.arrayForOverwrite<uint16_t>(input.grid.cells() * mRoom)) {}

    void fill(Arena& arena, std::span<const PunctualLight> lights) {
        // In the order of the lights, in which the lists need no sorting: froxels are hardly ever full.
        forEachSlice([&](uint32_t slice) { assignSlice(mInput, slice, {}, sliceOf(slice)); });
        if (!isFull(mCounts)) return;
        // Again, with the brightest first: what finds no place is dimmer than all that has one.
        const std::span<const uint16_t> order = brightestFirst(arena, lights);
        forEachSlice([&](uint32_t slice) {
            const SliceLists lists = sliceOf(slice);
            if (isFull(lists.counts)) assignSlice(mInput, slice, order, lists);
        });
    }

    /// One word a froxel, then the lists.
    std::span<const uint32_t> pack(Arena& arena, ViewCounts& counts) {
        const size_t cells = mCounts.size();
        const auto begins = arena.arrayForOverwrite<uint32_t>(cells);
        auto end = static_cast<uint32_t>(cells);
        // The places of all lists are known before they are copied, so that the jobs below need no order among
        // themselves.
        for (size_t i = 0; i < cells; ++i) {
            begins[i] = end;
            end += lengthOf(i);
            counts.longestFroxel = std::max(counts.longestFroxel, lengthOf(i));
            counts.fullFroxels += mCounts[i] > kMaxLightsOfFroxel;
            counts.lightsLeftOut += mCounts[i] - lengthOf(i);
        }
        counts.froxels = static_cast<uint32_t>(cells);
        counts.froxelEntries = end - counts.froxels;
        const auto words = arena.arrayForOverwrite<uint32_t>(end);
        forEachSlice([&](uint32_t slice) {
            const size_t first = size_t{ slice } * mInput.grid.tiles();
            for (size_t i = first; i < first + mInput.grid.tiles(); ++i) {
                words[i] = begins[i] << shader::kFroxelCountBits | lengthOf(i);
                std::ranges::copy(mEntries.subspan(i * mRoom, lengthOf(i)), words.begin() + begins[i]);
            }
        });
        return words;
    }

private:
    uint32_t lengthOf(size_t froxel) const { return std::min(mCounts[froxel], kMaxLightsOfFroxel); }

    SliceLists sliceOf(uint32_t slice) const {
        const size_t tiles = mInput.grid.tiles();
        return { mCounts.subspan(slice * tiles, tiles), mEntries.subspan(slice * tiles * mRoom, tiles * mRoom), mRoom };
    }

    template <class F>
    void forEachSlice(F&& function) {
        jobs::parallelFor<"froxels">(mJobs, mInput.grid.slices, 1, [&](size_t begin, size_t end) {
            for (size_t slice = begin; slice < end; ++slice) function(static_cast<uint32_t>(slice));
        });
    }

    jobs::JobSystem& mJobs;
    SliceInput const& mInput;
    size_t mRoom;
    std::span<uint32_t> mCounts; ///< also of lights that found no place
    std::span<uint16_t> mEntries;
};

} // namespace

// Olsson, Billeter and Assarsson 2012, "Clustered Deferred and Forward Shading": lists by clusters whose slices are
// exponential in depth.
FroxelLists assignLights(jobs::JobSystem& jobs, Arena& arena, ViewSpace const& space, uint2 size,
                         std::span<const PunctualLight> lights, shader::FrameUniforms& frame, ViewCounts& counts,
                         FroxelOptions const& options) {
    if (lights.size() < std::max<size_t>(options.fewest, 1)) return {};
    const std::span<const LightBounds> bounds = findBounds(arena, lights, space, options.margins);
    const DepthRange depths = depthsOf(bounds);
    if (!(depths.nearest < depths.farthest)) return {}; // all lights are unlimited
    const FroxelGrid grid = makeFroxelGrid(size, depths.nearest, depths.farthest);
    const std::optional<TileAxes> axes = tileAxes(grid, space.clipFromView);
    if (!axes) return {};
    const auto slices = arena.arrayForOverwrite<SliceRange>(lights.size());
    std::ranges::transform(bounds, slices.begin(), [&](LightBounds const& light) { return slicesOf(grid, light); });
    // Each light knows its slices before the jobs begin: a job skips most lights by comparing two bytes.
    const SliceInput input{ grid, *axes, bounds, slices, depths.farthest, options.margins };
    Lists lists(jobs, arena, input);
    lists.fill(arena, lights);
    frame.froxelGrid = float4(grid.columns, grid.rows, grid.slices, grid.firstSlice);
    frame.froxelPlaces.x = static_cast<float>(grid.shift);
    return { lists.pack(arena, counts) };
}

} // namespace filament_core::prepare
