// SPDX-License-Identifier: Apache-2.0
/// Options: the checked command line of filament-conformance.
///   Fails   InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "base/Result.h"
#include "toolkit/program/Shard.h"

#include <filament_core/Engine.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::conformance {

struct Options {
    std::filesystem::path scenes, assets;
    std::filesystem::path baselines; ///< empty: images are not compared with stored ones
    std::filesystem::path out = "conformance";
    std::vector<Backend> backends{ Backend::Vulkan, Backend::Gles }; ///< the first is the reference
    std::string requireDevice;
    std::vector<std::string> only;   ///< cases whose names contain one of these; empty: all
    std::vector<std::string> cases;  ///< of those, the ones with these names; empty: all
    std::optional<uint64_t> shuffle; ///< seed of the order in which cases are drawn; none: by name
    bool fresh = false;              ///< new engines for each case: its image is the first that they draw
    tools::Shard shard{};
    bool threads = true; ///< also 0, 2 and 8 workers, and the affinity policies
    bool mutations = true;
    bool shares = false;               ///< also check that shares of lights and effects add up (ShareCheck.h)
    bool passedPictures = true;        ///< --pictures failed: none of cases that passed
    std::vector<std::string> machines; ///< simulated machines (Machines.h) whose child processes draw the cases again
    std::filesystem::path program;     ///< what they run: this program
    std::filesystem::path journal;     ///< where the run writes down how far it is (Journal.h); empty: nowhere
    bool updateBaselines = false;
    std::string build;                        ///< name of this build in the results
    std::string mutate;                       ///< with --bisect, --random: the defect of one backend; empty: none
    std::string bisect;                       ///< the case to bisect; empty: run
    std::vector<std::filesystem::path> merge; ///< folders of results; empty: run
    std::filesystem::path against;            ///< folder of another report (Against.h); empty: none
    bool exact = true;                        ///< --set exact=off: the engine's shaders without it
    std::vector<std::pair<std::string, std::string>> quality; ///< --set NAME=VALUE: overrides every case
    uint32_t random = 0; ///< generated materials to draw (random/RandomRun.h); 0: run the scenes
    bool reduce = true;  ///< --random: find a small material that fails like a large one
    uint64_t seed = 1;   ///< of the first one
    bool list = false;
};

/// No value: the help text was requested and has been printed.
Result<std::optional<Options>> parseOptions(int argc, const char* const* argv);

} // namespace filament_core::conformance
