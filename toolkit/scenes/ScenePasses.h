// SPDX-License-Identifier: Apache-2.0
/// ScenePasses: "postProcess" of a scene file, the passes of View::postProcess.
///   In      SceneFilePass: the material is a .mat file, relative to the scene file; textures have the names of
///           MaterialPictures.h.
///   Fails   NotFound or InvalidArgument naming material and value; errors of the compiler.
#pragma once

#include "toolkit/materials/MaterialPictures.h"
#include "toolkit/materials/MaterialValues.h"

#include <filament_core/SceneFile.h>

#include <span>
#include <string>
#include <vector>

namespace filament_core::tools {

/// The passes of a scene, and what they are made of.
class ScenePasses {
public:
    static Result<ScenePasses> make(Engine& engine, std::filesystem::path const& folder,
                                    std::span<const SceneFilePass> passes);
    std::span<const PostProcessPass> passes() const { return mPasses; }

private:
    Result<void> add(Engine& engine, std::filesystem::path const& folder, SceneFilePass const& pass);

    std::vector<Owned<Material>> mMaterials;
    std::vector<Owned<MaterialInstance>> mInstances;
    std::vector<MaterialPicture> mPictures;
    std::vector<PostProcessPass> mPasses;
};

} // namespace filament_core::tools
