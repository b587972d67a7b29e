// SPDX-License-Identifier: Apache-2.0
/// SceneAssets: from the words of a scene file to files, lights and a camera: for every program that draws such scenes.
///   Model        objects to build, "showcase", "asset:PATH", or a path beside the scene file.
///   Environment  "sky" (analytic, without its sun), "white" (radiance 1 everywhere), "studio" (dim, with four
///                lamps of up to 300 times its radiance), "showcase", or a path as above.
///   Memory       what is built is written once into the folder `work`; several processes may do so at once.
///   Thread       any.
///   Fails        what the builders and the file system say. An asset that is not there: see missingFile().
#pragma once

#include "tools/conformance/SceneFile.h"

#include <filament/Box.h>

namespace filament::conformance {

/// Where built files go, and where "asset:" begins; empty: nowhere.
struct SceneFolders {
    std::filesystem::path work, assets;
};

/// The first file of a case that does not exist; empty: all are there.
std::string missingFile(SceneSpec const& spec, std::filesystem::path const& assets);

Result<std::filesystem::path> modelFile(SceneSpec const& spec, SceneFolders const& folders);
/// Empty: the case has no environment.
Result<std::filesystem::path> environmentFile(SceneSpec const& spec, SceneFolders const& folders);

/// The lights of the case where they stand, its origin added.
std::vector<LightSpec> placedLights(SceneSpec const& spec);
/// Where each copy of the model stands.
std::vector<double4x4> placedCopies(SceneSpec const& spec);
/// `bounds`: of the whole scene, for a case that does not say where its camera is.
Camera cameraOf(SceneSpec const& spec, Box const& bounds);

} // namespace filament::conformance
