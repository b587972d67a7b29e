// SPDX-License-Identifier: Apache-2.0
/// bakeIrradianceGrid: an irradiance grid of a scene that does not move, traced by paths.
///   Method  a regular grid, which is halved along its longest spacing until the light that it gives at held-out points
///           is as close to what is traced there as asked for, or until the budget of probes is spent. The report says
///           which. Other points, which decide nothing, judge the last grid: a bound that the error keeps at
///           kBoundShare of the lit places of the box (Tolerance.h).
///   Bits    the same bytes for any number of workers.
///   Thread  any; works on the job system.
///   Memory  about 3 KB a probe.   Cost: 4 ms a probe and core with 1024 paths in a furnished room.
///   Fails   InvalidArgument in one line for settings outside of their ranges.
#pragma once

#include "base/Result.h"
#include "jobsystem/JobSystem.h"
#include "tools/bake/IrradianceLeaks.h"
#include "tools/bake/IrradianceProbes.h"
#include "tools/bake/Tolerance.h"

#include <filament_core/IrradianceGrid.h>

#include <optional>
#include <span>
#include <string>

namespace filament_core::bake {

struct GridSettings {
    IrradianceGridDesc box{};  ///< without probes
    float spacingMeters = 1;   ///< of the first grid, at most; (0, 1e6]
    uint32_t maxProbes = 4096; ///< [1, IrradianceProbes::kMaxProbes]
    float maxError = 0.05f;    ///< root mean square of the irradiance at held-out points, in shares of theirs; 0: spend
                               ///< the budget
    uint32_t heldOutPoints = 64;    ///< [1, 65536]
    uint32_t judgedPoints = 256;    ///< that judge the last grid, [0, 65536]; fewer than 59 bound nothing
    ProbeSettings probes{};         ///< farthestMeters follows from the spacing
    uint32_t leakPointsPerSide = 2; ///< of a cell; 0: leaks are not looked for
};

/// The last grid beside what is traced at points of their own. Errors are the largest among the six directions of the
/// axes, of the luminance of irradiance / pi.
struct GridJudgement {
    uint32_t points = 0;                 ///< that were compared
    uint32_t inside = 0;                 ///< others: they are inside of geometry
    uint32_t dark = 0;                   ///< others: there is no light
    std::optional<double> interpolation; ///< at kBoundShare of the lit places: no error is larger than two standard
                                         ///< errors of the probes and this, candela / m2; none: too few points
    double rms = 0, worst = 0;           ///< candela / m2: root mean square of the errors, and the largest
    float3 worstPlace{ 0.0f };           ///< metres from the centre, in the frame of the box
};

struct GridReport {
    uint32_t inside = 0;        ///< probes in geometry
    double mean = 0;            ///< luminance of their irradiance / pi, averaged over all directions: candela / m2
    double standardError = 0;   ///< root mean square of the probes', in shares of their mean
    double heldOutError = 0;    ///< as GridSettings::maxError, without the noise of both
    double heldOutNoise = 0;    ///< the share of the noise: standard errors of points and probes
    uint32_t heldOutPoints = 0; ///< that are not inside of geometry
    uint32_t rounds = 0;        ///< grids that were traced
    bool isWithinBound = false; ///< else the budget was spent
    uint64_t rays = 0;
    Leaks leaks{};
    GridJudgement judgement{};
};

struct BakedGrid {
    IrradianceGridDesc grid{};
    GridReport report{};
};

Result<BakedGrid> bakeIrradianceGrid(reference::TracedScene const& scene, GridSettings const& settings,
                                     jobs::JobSystem& jobs);

/// The error of settings outside of their ranges.
Result<void> checkGridSettings(GridSettings const& settings);

/// The grid that bakeIrradianceGrid() makes, of the records that GridTrace traces: those of the first grids suffice if
/// one of them is within the bound. Nothing: more are needed. `settings` are valid.
std::optional<BakedGrid> gridOfRecords(reference::TracedScene const& scene, GridSettings const& settings,
                                       std::span<const std::byte> records);

/// In a few lines.
std::string describe(BakedGrid const& baked);

} // namespace filament_core::bake
