// SPDX-License-Identifier: Apache-2.0
/// GridTrace: what an irradiance grid is made of, traced in a fixed order, so that a run can stop and continue, and
/// machines can each trace a part.
///   Order   points that decide when to stop refining; points that judge the last grid; then the probes of each grid,
///           the coarsest first, up to the budget. One run traces no grid beyond the first that is within the bound;
///           parts, which do not know it, trace them all.
///   Out     records of recordBytes() each, in that order.
///   Bits    a record depends on its number and the settings alone.
///   Thread  any; trace() works on the job system.   Fails: never; `settings` are valid.
#pragma once

#include "tools/bake/IrradianceBake.h"

#include <cstddef>
#include <functional>
#include <span>

namespace filament_core::bake {

/// A place at which light was traced for comparison.
struct HeldOutProbe {
    float3 local{ 0.0f }; ///< metres from the centre, in the frame of the box
    IrradianceProbe traced{};
    uint64_t rays = 0;
};

class GridTrace {
public:
    GridTrace(reference::TracedScene const& scene, GridSettings const& settings);

    size_t size() const { return endOfGrid(grids() - 1); } ///< records of all
    size_t grids() const { return mCounts.size(); }        ///< at least 1
    uint3 countOf(size_t grid) const { return mCounts[grid]; }
    size_t endOfGrid(size_t grid) const { return mEnds[grid]; } ///< one beyond its last record
    size_t recordBytes() const;

    /// [first, last) in batches, in order, on the calling thread; until `finished` returns false.
    void trace(size_t first, size_t last, jobs::JobSystem& jobs,
               std::function<bool(std::span<const std::byte>)> const& finished) const;

    // From records, which begin with the first of all.
    std::vector<HeldOutProbe> heldOut(std::span<const std::byte> records) const;
    std::vector<HeldOutProbe> judging(std::span<const std::byte> records) const;
    std::vector<TracedProbe> probesOf(size_t grid, std::span<const std::byte> records) const;

private:
    TracedProbe traceOne(size_t record) const;
    TracedProbe tracePoint(size_t number, uint64_t stream) const;
    float3 pointOf(size_t number, uint64_t stream) const;
    std::vector<HeldOutProbe> points(size_t first, size_t count, uint64_t stream,
                                     std::span<const std::byte> records) const;
    TracedProbe read(std::span<const std::byte> records, size_t record) const;
    void write(TracedProbe const& probe, std::byte* to) const;
    double3 inWorld(float3 local) const;
    size_t depths() const { return size_t{ mSettings.probes.depthSize } * mSettings.probes.depthSize; }

    reference::TracedScene const& mScene;
    GridSettings const& mSettings;
    std::vector<uint3> mCounts;
    std::vector<size_t> mEnds;
};

} // namespace filament_core::bake
