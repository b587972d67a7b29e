// SPDX-License-Identifier: Apache-2.0
/// Runner: draws the cases of a shard in every configuration, compares them, inspects frames, and tests mutations.
///   Configurations  each backend with one worker, captured; then 0, 2 and 8 workers, pinned and on big cores. The
///                   first one produces the reference image.
///   Out     the results; images in OUT/images.
///   Memory  one engine per configuration, one case at a time.
///   Fails   a missing device or scene folder; errors within a case are results of that case.
///   Cost    about a second per case on two cores with Mesa's CPU drivers, half of it for mutations.
#pragma once

#include "tools/conformance/Baselines.h"
#include "tools/conformance/Options.h"
#include "tools/conformance/Results.h"
#include "tools/conformance/Stage.h"

namespace filament_core::conformance {

struct Configuration {
    std::string name;
    StageOptions stage;
};
std::vector<Configuration> configurationsOf(Options const& options);

/// The first two backends, or the only one twice. One of them has the defect of --mutate: the first that it fits.
struct StagePair {
    std::unique_ptr<Stage> a, b;
};
Result<StagePair> openPair(Options const& options, bool capture);

/// Values of --set override those of the cases.
void overrideQuality(std::vector<SceneSpec>& cases, Options const& options);

/// The cases that --only and --cases name, in the order of --shuffle, and every shard.count-th one of those.
std::vector<SceneSpec> casesOf(std::vector<SceneSpec> all, Options const& options);

/// Here, and then on the machines of --machines.
Result<Results> runCases(Options const& options, std::vector<SceneSpec> const& cases);

/// What --bisect prints.
Result<std::string> bisectCase(Options const& options, std::vector<SceneSpec> const& cases);

} // namespace filament_core::conformance
