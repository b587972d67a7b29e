// SPDX-License-Identifier: Apache-2.0
/// ClosedForms: the path tracer itself against scenes whose radiance is a formula: what its stated error is worth.
///   Thread  one at a time; works on the job system.
///   Fails   what the scene files say.
///   Cost    under a second.
#pragma once

#include "tools/accuracy/SceneLibrary.h"
#include "tools/reference/Reference.h"

namespace filament::accuracy {

struct ClosedForm {
    std::string name, formula;
    double expected = 0, mean = 0;
    double standardError = 0; ///< of the mean
    /// How far off in standard errors; 0 if both say the same.
    double deviations() const;
    /// Within four standard errors and what floats round.
    bool agrees() const;
};

Result<std::vector<ClosedForm>> checkClosedForms(SceneLibrary const& scenes, conformance::SceneFolders const& folders,
                                                 uint32_t samplesPerPixel, jobs::JobSystem& jobs);

} // namespace filament::accuracy
