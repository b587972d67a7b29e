// SPDX-License-Identifier: Apache-2.0
/// glTF materials as instances of the engine's glTF materials: a package by shading and blending, specialised to
/// exactly the maps that the material uses. Equal specialisations share one material.
#pragma once

#include "filament_core/assets/ModelData.h"
#include "filament_core/engine/ModelImpl.h"

#include <map>
#include <string>

namespace filament {

class GltfMaterials {
public:
    /// `textures[i]` is images[i] of the model.
    GltfMaterials(Engine::Impl& engine, Model::Impl& model, std::span<const Texture> textures)
            : mEngine(engine), mModel(model), mTextures(textures) {}

    MaterialInstance instanceFor(assets::MaterialData const& material, bool hasVertexColor);

private:
    Material materialFor(assets::MaterialData const& material, bool hasVertexColor);
    void setParameters(MaterialInstance instance, assets::MaterialData const& material);

    Engine::Impl& mEngine;
    Model::Impl& mModel;
    std::span<const Texture> mTextures;
    std::map<std::string, Material> mMaterials; ///< by package and constants
};

} // namespace filament
