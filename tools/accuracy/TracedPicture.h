// SPDX-License-Identifier: Apache-2.0
/// TracedPicture: a scene file through tools/reference: the point in the middle of each pixel, which is what a
/// rasteriser without anti-aliasing shades.
///   Thread  any; works on the job system.
///   Fails   what the loaders and tools/reference say.
#pragma once

#include "tools/accuracy/Picture.h"
#include "tools/accuracy/TracedMaterial.h"
#include "tools/conformance/SceneAssets.h"
#include "tools/reference/Reference.h"

namespace filament::accuracy {

/// Model, lights and environment of a scene file, as the path tracer takes them. `features`: what its material has.
Result<reference::ReferenceScene> referenceSceneOf(conformance::SceneSpec const& spec,
                                                   conformance::SceneFolders const& folders, jobs::JobSystem& jobs,
                                                   MaterialFeatures* features = nullptr);

/// The terms that a set of choices stands for.
reference::BsdfModel bsdfOf(Quality const& quality);

struct TracedPicture {
    Picture picture;
    double relativeError = 0; ///< standard error of the picture, relative to its mean
};

/// One reflection of light that nothing blocks. `view`: of the engine's picture.
Result<TracedPicture> trace(reference::ReferenceScene const& scene, View const& view, uint32_t samplesPerPixel,
                            jobs::JobSystem& jobs);

} // namespace filament::accuracy
