// SPDX-License-Identifier: Apache-2.0
/// MutantRun: draws cases with a defect in the engine, and says whether their pictures show it.
///   Out     what was found, and a fault: the defect went unnoticed, or it proves nothing, because the commands of the
///           case have nothing of what it changes, or no draw reads that (DefectTrace.h).
///   Memory  the engines of the last kEngines defects: the next features of a scene have the same defects, models and
///           pipelines.
///   Thread  one at a time.
///   Fails   errors of the loaders and the device.
#pragma once

#include "tools/conformance/Mutations.h"
#include "tools/conformance/Results.h"
#include "tools/conformance/Stage.h"

#include <list>
#include <optional>

namespace filament::conformance {

struct MutantVerdict {
    std::optional<Kill> kill;        ///< none: a control, of which no draw has anything
    std::vector<std::string> errors; ///< of the device
    std::string fault;               ///< empty: it is as it should be
};

/// "no draw has what 'stencilOff' (stencil test off) changes, pipeline 'x'"; empty: one does.
std::string whyUndrawn(Mutation const& mutation, DefectReach const& reach);

class MutantRun {
public:
    /// `options`: of the engine that has the defect. `reference`: the case's picture without it.
    Result<MutantVerdict> run(Mutation const& mutation, StageOptions const& options, SceneSpec const& spec,
                              Image const& reference);

private:
    static constexpr size_t kEngines = 8;

    struct Mutant {
        std::string_view mutation;
        std::unique_ptr<Stage> stage;
    };

    Result<Stage*> stageOf(Mutation const& mutation, StageOptions const& options);
    Result<std::string> faultOfUnnoticed(Mutation const& mutation, StageOptions const& options, SceneSpec const& spec,
                                         Image const& reference, DefectReach const& reach);

    std::list<Mutant> mMutants; // the last one first
};

} // namespace filament::conformance
