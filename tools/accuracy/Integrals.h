// SPDX-License-Identifier: Apache-2.0
/// Integrals: compares what a set of choices computes instead of an integral with that integral in double precision,
/// for terms whose error no picture isolates.
///   directionalAlbedo  fraction of uniform light that the specular lobe reflects: reflectance 0.04, 0.5 and 1 at
///                      normal incidence, 24 roughnesses in [0.1, 1] and 24 cosines in [0.05, 1].
///   Thread  any; works on the job system.
///   Fails   NotFound with the nearest name.
#pragma once

#include "jobsystem/JobSystem.h"
#include "toolkit/pictures/Picture.h"
#include "tools/accuracy/Settings.h"

namespace filament_core::accuracy {

using namespace tools; // the toolkit

/// Relative rms and max; no FLIP, because there is no picture.
Result<ErrorFigures> integralError(std::string const& name, Settings const& settings, jobs::JobSystem& jobs);

} // namespace filament_core::accuracy
