// SPDX-License-Identifier: Apache-2.0
/// TracedPicture: draws a scene file with tools/reference, at the centre of each pixel, which is what a rasteriser
/// without anti-aliasing shades.
///   Thread  any; works on the job system.
///   Fails   errors of the loaders and of tools/reference.
#pragma once

#include "toolkit/pictures/Picture.h"
#include "toolkit/scenes/SceneAssets.h"
#include "tools/accuracy/TracedMaterial.h"
#include "tools/reference/Reference.h"

namespace filament_core::accuracy {

using namespace tools; // the toolkit

/// The model, lights and environment of a scene file, for the path tracer. `features`: those of its material.
Result<reference::ReferenceScene> referenceSceneOf(tools::SceneSpec const& spec, tools::SceneFolders const& folders,
                                                   jobs::JobSystem& jobs, MaterialFeatures* features = nullptr);

/// The terms that correspond to a set of choices.
reference::BsdfModel bsdfOf(Quality const& quality);

struct TracedPicture {
    Picture picture;
    double relativeError = 0; ///< standard error of the picture, relative to its mean
};

/// A single reflection of unoccluded light; with Quality::shadows, rays find what blocks that of suns, points and
/// spots. Integrator::Path: all light with every bounce. `view`: that of the engine's picture.
Result<TracedPicture> trace(reference::ReferenceScene const& scene, View const& view, uint32_t samplesPerPixel,
                            jobs::JobSystem& jobs,
                            reference::Integrator integrator = reference::Integrator::Unoccluded);

} // namespace filament_core::accuracy
