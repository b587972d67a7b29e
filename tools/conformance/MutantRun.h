// SPDX-License-Identifier: Apache-2.0
/// runMutant: draws a case with a defect in the engine, and says whether its picture shows it.
///   Out     what was found, and a fault: the defect went unnoticed, or it proves nothing, because the commands of the
///           case have nothing of what it changes, or no draw reads that (DefectTrace.h).
///   Memory  an engine, which is gone when it returns. Kept for the other features of a scene, engines saved 2 to 15 %
///           of the time and took 1 GB.
///   Thread  any.   Fails: errors of the loaders and the device.
#pragma once

#include "toolkit/mutations/Mutations.h"
#include "tools/conformance/Results.h"
#include "tools/conformance/Stage.h"

#include <optional>

namespace filament_core::conformance {

struct MutantVerdict {
    std::optional<Kill> kill;        ///< none: a control, of which no draw has anything
    std::vector<std::string> errors; ///< of the device
    std::string fault;               ///< empty: it is as it should be
};

/// `options`: of the engine that has the defect. `reference`: the case's picture without it.
Result<MutantVerdict> runMutant(Mutation const& mutation, StageOptions const& options, SceneSpec const& spec,
                                Image const& reference);

/// "'stencilOff' (stencil test off) proves nothing: ..." where no draw has what it changes; empty: one does.
std::string whyUndrawn(Mutation const& mutation, DefectReach const& reach);

} // namespace filament_core::conformance
