// SPDX-License-Identifier: Apache-2.0
/// InteriorFiles: everything that the comparison of an interior reads: its model, with and without a lightmap, a grid,
/// probes, and the path tracer's images.
///   In      a case, and a folder. What the folder has already is kept where its settings are the same.
///   Bakes   filament-bake beside this program, as a child process; paths of probes and images in this one.
///   Thread  one at a time; works on the job system.
///   Fails   errors of loaders, files and child processes, with the log of the child.
///   Cost    minutes.
#pragma once

#include "jobsystem/JobSystem.h"
#include "toolkit/pictures/Picture.h"
#include "toolkit/scenes/SceneAssets.h"
#include "tools/accuracy/interiors/InteriorCases.h"

#include <functional>

namespace filament_core::accuracy {

using namespace tools; // the toolkit

struct InteriorSettings {
    uint2 size{ 240, 136 };          ///< of images, multiples of 8
    uint32_t mostSamples = 1u << 20; ///< a pixel, a texel and a probe, at most
    double coarseness = 1;           ///< divides the density of lightmaps and multiplies the spacing of grids
};

/// A traced image and its standard error, both scene-linear times exposure.
struct TracedInterior {
    Picture picture, standardError;
};

struct InteriorFiles {
    std::filesystem::path model, baked, environment, grid;
    std::vector<std::filesystem::path> probes; ///< of each of the case's
    std::vector<TracedInterior> traced;        ///< of each camera
};

/// `step`: what is done now.
Result<InteriorFiles> makeFiles(InteriorCase const& one, InteriorSettings const& settings, SceneFolders const& folders,
                                jobs::JobSystem& jobs, std::function<void(std::string const&)> const& step);

/// The case as a scene that a studio draws.
SceneSpec sceneOf(InteriorCase const& one, InteriorFiles const& files, LightTechnique technique, size_t camera,
                  uint2 size);

} // namespace filament_core::accuracy
