// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/IrradianceLeaks.h"

#include "filament_core/scene/SampleGrid.h"

#include <algorithm>
#include <array>

namespace filament_core::bake {
namespace {

/// A probe of the cell around a point, with its share of the interpolation.
struct CellProbe {
    uint32_t probe = 0;
    float3 place{ 0.0f };
    float weight = 0;
    bool isHidden = false; ///< from the point
};

class LeakSearch {
public:
    LeakSearch(scene::GridRecord const& grid, Blocked const& isBlocked)
            : mGrid(grid), mProbes(*grid.probes), mIsBlocked(isBlocked), mBias(scene::biasOf(grid)) {}

    void visitPoint(uint3 cell, float3 share) {
        float3 point(0);
        std::array<CellProbe, 8> corners;
        size_t count = 0;
        for (uint32_t corner = 0; corner < 8; ++corner) {
            const uint3 step(corner & 1, corner >> 1 & 1, corner >> 2);
            float weight = 1;
            bool exists = true;
            for (int axis = 0; axis < 3; ++axis) {
                exists = exists && (step[axis] == 0 || mProbes.count[axis] > 1);
                if (mProbes.count[axis] > 1) weight *= step[axis] != 0 ? share[axis] : 1 - share[axis];
            }
            if (!exists) continue;
            const uint3 at = cell + step;
            const uint32_t probe = (at.z * mProbes.count.y + at.y) * mProbes.count.x + at.x;
            corners[count++] = { probe, scene::placeOf(mGrid, at), weight };
        }
        for (int axis = 0; axis < 3; ++axis) {
            const float low = corners[0].place[axis], high = corners[count - 1].place[axis];
            point[axis] = mProbes.count[axis] > 1 ? low + (high - low) * share[axis]
                                                  : mGrid.halfExtent[axis] * (2 * share[axis] - 1);
        }
        judge(point, std::span(corners).first(count));
    }

    Leaks take() { return std::move(mLeaks); }

private:
    void judge(float3 point, std::span<CellProbe> corners) {
        float sum = 0;
        bool isSeen = false;
        for (CellProbe& corner : corners) {
            if (mProbes.probes[corner.probe].isInside) {
                corner.weight = 0;
                continue;
            }
            corner.isHidden = mIsBlocked(inWorld(corner.place), inWorld(point));
            isSeen = isSeen || !corner.isHidden;
            corner.weight *= scene::visibilityOf(mProbes, corner.probe, point - corner.place, mBias);
            sum += corner.weight;
        }
        if (!isSeen) return;
        ++mLeaks.points;
        for (CellProbe const& corner : corners)
            if (corner.isHidden && corner.weight > kLeakShare * sum)
                mLeaks.found.push_back({ point, corner.probe, corner.weight / sum });
    }

    double3 inWorld(float3 local) const { return mGrid.centerWorld + double3(mGrid.worldFromBox * local); }

    scene::GridRecord const& mGrid;
    IrradianceProbes const& mProbes;
    Blocked const& mIsBlocked;
    float mBias;
    Leaks mLeaks{};
};

} // namespace

Leaks findLeaks(scene::GridRecord const& grid, uint32_t pointsPerSide, Blocked const& isBlocked) {
    LeakSearch search(grid, isBlocked);
    const uint3 cells = glm::max(grid.probes->count, uint3(2)) - 1u;
    const auto visit = [&](uint3 cell) {
        for (uint32_t i = 0; i < pointsPerSide * pointsPerSide * pointsPerSide; ++i) {
            const uint3 at(i % pointsPerSide, i / pointsPerSide % pointsPerSide, i / pointsPerSide / pointsPerSide);
            search.visitPoint(cell, (float3(at) + 0.5f) / static_cast<float>(pointsPerSide));
        }
    };
    for (uint32_t z = 0; z < cells.z; ++z)
        for (uint32_t y = 0; y < cells.y; ++y)
            for (uint32_t x = 0; x < cells.x; ++x) visit({ x, y, z });
    return search.take();
}

} // namespace filament_core::bake
