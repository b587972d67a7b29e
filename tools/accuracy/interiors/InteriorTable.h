// SPDX-License-Identifier: Apache-2.0
/// InteriorTable: how near each way of lighting a room comes to the path tracer, and what it costs.
///   Error  that of toolkit/pictures/BlockErrors.h, and so is the noise.
///   Time   of frames, in turns: in each round every technique draws the same camera, and ratios to the environment
///          alone are formed within the round; medians of rounds.
///   Thread one at a time.
///   Fails  errors of loaders, bakes and devices. A case whose assets are missing is skipped, with the reason.
#pragma once

#include "tools/accuracy/Results.h"
#include "tools/accuracy/Statistics.h"
#include "tools/accuracy/interiors/InteriorFiles.h"

#include <filament_core/Engine.h>

#include <array>
#include <map>

namespace filament_core::accuracy {

struct TechniqueResult {
    std::vector<double> errors;             ///< of each camera
    std::map<std::string, Estimate> ratios; ///< of each backend: time over the environment's
    std::vector<Picture> pictures;          ///< of each camera, scene-linear
};

struct InteriorResult {
    std::string name, title;
    std::array<TechniqueResult, kLightTechniques> techniques;
    std::vector<double> noise;                    ///< of each camera
    std::vector<Picture> traced;                  ///< of each camera
    double error(LightTechnique technique) const; ///< root mean square over the cameras
    double meanNoise() const;                     ///< root mean square of the noise
    LightTechnique best() const;                  ///< with the least error
    /// How many times nearer than the environment alone the best one is.
    double gain() const { return error(LightTechnique::Environment) / error(best()); }
};

struct InteriorResults {
    std::string machine, commit, date;
    std::vector<InteriorResult> interiors;
    std::vector<Skipped> skipped;
};

struct InteriorOptions {
    std::vector<std::string> chosen{}; ///< names; empty: all
    std::vector<Backend> backends{ Backend::Vulkan, Backend::Gles };
    uint2 timedSize{ 960, 540 };
    uint32_t rounds = 15; ///< 0: no times
    InteriorSettings settings{};
    SceneFolders folders{};
};

Result<InteriorResults> measureInteriors(InteriorOptions const& options,
                                         std::function<void(std::string const& what, double done)> const& progress);

} // namespace filament_core::accuracy
