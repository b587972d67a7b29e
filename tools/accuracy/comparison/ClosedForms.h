// SPDX-License-Identifier: Apache-2.0
/// ClosedForms: checks the path tracer, and its stated error, in scenes whose radiance is a formula.
///   Thread  one at a time; works on the job system.
///   Fails   errors of the scene files.
///   Cost    under a second.
#pragma once

#include "tools/accuracy/SceneLibrary.h"
#include "tools/reference/Reference.h"

namespace filament_core::accuracy {

struct ClosedForm {
    std::string name, formula;
    double expected = 0, mean = 0;
    double standardError = 0; ///< of the mean
    /// The deviation in standard errors; 0 if both values are equal.
    double deviations() const;
    /// Within four standard errors and the rounding of floats.
    bool agrees() const;
};

Result<std::vector<ClosedForm>> checkClosedForms(SceneLibrary const& scenes, tools::SceneFolders const& folders,
                                                 uint32_t samplesPerPixel, jobs::JobSystem& jobs);

} // namespace filament_core::accuracy
