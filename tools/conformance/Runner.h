// SPDX-License-Identifier: Apache-2.0
/// Runner: draws the cases of a shard in every configuration, compares, looks inside, lets mutants loose.
///   Configurations  each backend with one worker, captured; then 0, 2 and 8 workers, pinned and on big cores. The
///                   first one makes the reference picture.
///   Out     the results; pictures in OUT/images.
///   Memory  one engine a configuration, one case at a time.
///   Fails   a device or a scene folder that is not there; what goes wrong in a case is a result of that case.
///   Cost    about a second a case on two cores with Mesa's CPU drivers, half of it for mutants.
#pragma once

#include "tools/conformance/Baselines.h"
#include "tools/conformance/Bisect.h"
#include "tools/conformance/Options.h"
#include "tools/conformance/Results.h"

namespace filament::conformance {

struct Configuration {
    std::string name;
    StageOptions stage;
};
std::vector<Configuration> configurationsOf(Options const& options);

/// What --set says goes over what the cases say.
void overrideQuality(std::vector<SceneSpec>& cases, Options const& options);

/// The cases that --only names, of those every shard.count-th one.
std::vector<SceneSpec> casesOf(std::vector<SceneSpec> all, Options const& options);

Result<Results> runCases(Options const& options, std::vector<SceneSpec> const& cases);

/// What --bisect prints.
Result<std::string> bisectCase(Options const& options, std::vector<SceneSpec> const& cases);

} // namespace filament::conformance
