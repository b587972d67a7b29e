// SPDX-License-Identifier: Apache-2.0
/// ScenePasses: "postProcess" of a scene file, the passes of View::postProcess.
///   In      SceneFilePass: the material is a .mat file, relative to the scene file; textures have the names of
///           MaterialPictures.h, or "drawn:FILE.json" (DrawnTexture.h).
///   Fails   NotFound or InvalidArgument naming material and value; errors of the compiler.
#pragma once

#include "toolkit/materials/MaterialPictures.h"
#include "toolkit/materials/MaterialValues.h"
#include "toolkit/scenes/DrawnTexture.h"

#include <filament_core/Renderer.h>
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

    /// What passes draw into textures of the passes above. Mesh passes see the scene as `view` does.
    void drawTextures(Renderer& renderer, Scene const& scene, View const& view) const;

private:
    struct Draw {
        RenderTarget target{};
        MeshPass pass{};
        bool drawsMeshes = false;
        Layers layers = kAllLayers;
    };
    using Values = std::span<const std::pair<std::string, std::string>>;

    Result<MaterialInstance> add(Engine& engine, std::filesystem::path const& file, Values values);
    /// A texture by its name.
    Result<MaterialPicture> picture(Engine& engine, std::filesystem::path const& folder, std::string const& name);
    Result<MaterialPicture> drawn(Engine& engine, std::filesystem::path const& file);

    std::vector<Owned<Material>> mMaterials;
    std::vector<Owned<MaterialInstance>> mInstances;
    std::vector<MaterialPicture> mPictures;
    std::vector<Owned<RenderTarget>> mTargets;
    std::vector<Draw> mDraws;
    std::vector<PostProcessPass> mPasses;
};

} // namespace filament_core::tools
