// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SliceLights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::prepare {
namespace {

constexpr uint32_t kMaxTilesOfAxis = 64;

/// First and one past the last.
struct Tiles {
    uint32_t begin = 0, end = 0;
};

/// Comparisons with NaN are false: such a range has all tiles.
Tiles tilesBetween(float low, float high, float count) {
    Tiles tiles{ 0, static_cast<uint32_t>(count) };
    if (low > 0) tiles.begin = static_cast<uint32_t>(std::min(low, count));
    if (high < count) tiles.end = high >= 0 ? static_cast<uint32_t>(high) + 1 : 0;
    return tiles;
}

struct SliceInterval {
    float low, high;
};

SliceInterval around(std::array<float, 4> const& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return { low, high };
}

/// A part of a slice, widened by what the depth of a point in it may be off.
struct Slab {
    float nearest, farthest;
};

// What the terms of a tile coordinate sum up to at most, over the points of the view at a depth: a bound for the
// rounding of shader and CPU, in tiles. A point of the view is at most `reach` from the camera.
float tileMargin(TileAxis const& axis, TileAxis const& other, float depth, FroxelMargins margins) {
    const float half = axis.tiles / 2, w = axis.weight(depth);
    const auto extent = [&](TileAxis const& along) {
        return std::max(std::abs(along.borderOf(0, depth)), std::abs(along.borderOf(along.tiles, depth)));
    };
    const float reach = depth + extent(axis) + extent(other);
    const float terms = (std::abs(axis.scale) + std::abs(axis.skew) + half * axis.slope) * reach +
                        std::abs(axis.offset) + half * axis.constant;
    return margins.tile() * (terms / w + axis.tiles);
}

class Slice {
public:
    Slice(SliceInput const& input, uint32_t slice, SliceLists const& lists)
            : mInput(input), mX(input.axes.x), mY(input.axes.y), mLists(lists), mSlab(slabOf(input, slice)) {
        for (const float depth : { mSlab.nearest, mSlab.farthest }) {
            if (!(mX.slope * depth + mX.constant > 0)) continue; // the eye: all tiles meet there
            mMarginX = std::max(mMarginX, tileMargin(mX, mY, depth, input.margins));
            mMarginY = std::max(mMarginY, tileMargin(mY, mX, depth, input.margins));
        }
        std::ranges::fill(lists.counts, 0u);
    }

    void add(uint32_t light) {
        LightBounds const& bounds = mInput.bounds[light];
        LightSphere const& sphere = bounds.sphere;
        if (sphere.radius == kEverywhere) return addToAll(light);
        const Slab reached{ std::max(mSlab.nearest, sphere.center.z - sphere.radius),
                            std::min(mSlab.farthest, sphere.center.z + sphere.radius) };
        if (!(reached.nearest <= reached.farthest)) return;
        const float gap = std::max({ mSlab.nearest - sphere.center.z, sphere.center.z - mSlab.farthest, 0.0f });
        addDisc(light, bounds, reached, (sphere.radius - gap) * (sphere.radius + gap));
    }

    void sortLists() {
        for (size_t tile = 0; tile < mLists.counts.size(); ++tile) {
            const auto first = mLists.entries.begin() + static_cast<std::ptrdiff_t>(tile * mLists.room);
            std::sort(first, first + static_cast<std::ptrdiff_t>(std::min<size_t>(mLists.counts[tile], mLists.room)));
        }
    }

private:
    static Slab slabOf(SliceInput const& input, uint32_t slice) {
        FroxelGrid const& grid = input.grid;
        const auto widened = [&](float depth, float sign) {
            const auto extent = [&](TileAxis const& axis) {
                return std::max(std::abs(axis.borderOf(0, depth)), std::abs(axis.borderOf(axis.tiles, depth)));
            };
            return depth + sign * input.margins.place() * (depth + extent(input.axes.x) + extent(input.axes.y));
        };
        const bool isLast = slice + 1 == grid.slices;
        return { slice == 0 ? 0.0f : std::max(widened(grid.sliceBegin(slice), -1), 0.0f),
                 isLast ? std::max(input.farthest, widened(grid.sliceBegin(slice), 1))
                        : widened(grid.sliceBegin(slice + 1), 1) };
    }

    /// The tiles that a disc of this radius around (x, depth) reaches within the slab.
    static Tiles tilesOf(TileAxis const& axis, float x, float radius, Slab slab, float margin) {
        const float nearest = axis.weight(slab.nearest), farthest = axis.weight(slab.farthest);
        const SliceInterval at = around(
                { axis.tileOf(x - radius, slab.nearest, nearest), axis.tileOf(x + radius, slab.nearest, nearest),
                  axis.tileOf(x - radius, slab.farthest, farthest), axis.tileOf(x + radius, slab.farthest, farthest) });
        return tilesBetween(at.low - margin, at.high + margin, axis.tiles);
    }

    /// What a tile covers of its axis, within the slab.
    static SliceInterval coverOf(TileAxis const& axis, uint32_t tile, Slab slab, float margin) {
        const float low = static_cast<float>(tile) - margin, high = static_cast<float>(tile) + 1 + margin;
        return around({ axis.borderOf(low, slab.nearest), axis.borderOf(high, slab.nearest),
                        axis.borderOf(low, slab.farthest), axis.borderOf(high, slab.farthest) });
    }

    // Within a slab, a sphere is no wider than the disc in which it is widest there.
    void addDisc(uint32_t light, LightBounds const& bounds, Slab slab, float squaredRadius) {
        const float3 center = bounds.sphere.center;
        const Tiles rows = tilesOf(mY, center.y, std::sqrt(squaredRadius), slab, mMarginY);
        for (uint32_t row = rows.begin; row < rows.end; ++row) {
            const SliceInterval cover = coverOf(mY, row, slab, mMarginY);
            const float gap = std::max({ cover.low - center.y, center.y - cover.high, 0.0f });
            const float squared = squaredRadius - gap * gap;
            if (squared < 0) continue;
            const Tiles columns = tilesOf(mX, center.x, std::sqrt(squared), slab, mMarginX);
            if (bounds.cone.isNarrow)
                addCone(light, bounds.cone, columns, row);
            else
                for (uint32_t column = columns.begin; column < columns.end; ++column) append(light, column, row);
        }
    }

    void addCone(uint32_t light, LightCone const& cone, Tiles columns, uint32_t row) {
        findBoxes();
        const SliceInterval y = mBoxesY[row];
        for (uint32_t column = columns.begin; column < columns.end; ++column) {
            const SliceInterval x = mBoxesX[column];
            const float3 low(x.low, y.low, mSlab.nearest), high(x.high, y.high, mSlab.farthest);
            if (intersects(cone, (low + high) * 0.5f, glm::length(high - low) * 0.5f)) append(light, column, row);
        }
    }

    // The boxes around the froxels of the slice, axis by axis.
    void findBoxes() {
        if (mHasBoxes) return;
        mHasBoxes = true;
        for (uint32_t i = 0; i < mInput.grid.columns; ++i) mBoxesX[i] = coverOf(mX, i, mSlab, mMarginX);
        for (uint32_t i = 0; i < mInput.grid.rows; ++i) mBoxesY[i] = coverOf(mY, i, mSlab, mMarginY);
    }

    void append(uint32_t light, uint32_t column, uint32_t row) {
        const size_t tile = size_t{ row } * mInput.grid.columns + column;
        const size_t count = mLists.counts[tile]++;
        if (count < mLists.room) mLists.entries[tile * mLists.room + count] = static_cast<uint16_t>(light);
    }

    void addToAll(uint32_t light) {
        for (uint32_t row = 0; row < mInput.grid.rows; ++row) {
            for (uint32_t column = 0; column < mInput.grid.columns; ++column) append(light, column, row);
        }
    }

    SliceInput const& mInput;
    const TileAxis mX, mY;
    const SliceLists mLists;
    const Slab mSlab;
    float mMarginX = 0, mMarginY = 0;
    bool mHasBoxes = false;
    std::array<SliceInterval, kMaxTilesOfAxis> mBoxesX, mBoxesY;
};

} // namespace

// The borders of slices are exact, the depths of points are not: a slice more on both sides covers that.
SliceRange slicesOf(FroxelGrid const& grid, LightBounds const& light) {
    const auto last = static_cast<uint8_t>(grid.slices - 1);
    if (light.sphere.radius == kEverywhere) return { 0, last };
    const auto sliceOf = [&](float depth) {
        const auto slice = static_cast<int>(std::bit_cast<uint32_t>(std::max(depth, 0.0f)) >> grid.shift);
        return std::clamp(slice - static_cast<int>(grid.firstSlice), 0, static_cast<int>(last));
    };
    const int first = sliceOf(light.sphere.center.z - light.sphere.radius);
    const int end = sliceOf(light.sphere.center.z + light.sphere.radius);
    return { static_cast<uint8_t>(std::max(first - 1, 0)), static_cast<uint8_t>(std::min<int>(end + 1, last)) };
}

void assignSlice(SliceInput const& input, uint32_t slice, std::span<const uint16_t> order, SliceLists const& lists) {
    Slice cells(input, slice, lists);
    const auto add = [&](uint32_t light) {
        const SliceRange range = input.slices[light];
        if (range.first <= slice && slice <= range.last) cells.add(light);
    };
    if (order.empty()) {
        for (uint32_t light = 0; light < input.bounds.size(); ++light) add(light);
        return;
    }
    for (const uint16_t light : order) add(light);
    cells.sortLists();
}

} // namespace filament_core::prepare
