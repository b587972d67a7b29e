// SPDX-License-Identifier: Apache-2.0
/// glTF materials as instances of the engine's glTF materials: a package by shading and blending, specialised to
/// exactly the maps that the material uses. Equal specialisations share one material.
#pragma once

#include "filament_core/engine/gltf/GltfMaterialSettings.h"
#include "filament_core/engine/gltf/ModelImpl.h"

#include <map>
#include <string>

namespace filament {

class GltfMaterials {
public:
    /// `textures[i]` is images[i] of the model after uploading.
    GltfMaterials(Engine::Impl& engine, Model::Impl& model, std::vector<Texture> const& textures)
            : mEngine(engine), mModel(model), mTextures(textures) {}

    /// `scale`: metres in the file's scene per metre of the mesh; it scales the thickness of volumes.
    MaterialInstance instanceFor(assets::MaterialData const& material, bool hasVertexColor, float scale);

private:
    size_t maxMaps() const;
    Material materialFor(GltfMaterialSettings const& settings);

    Engine::Impl& mEngine;
    Model::Impl& mModel;
    std::vector<Texture> const& mTextures;
    std::map<std::string, Material> mMaterials; ///< by package and constants
};

} // namespace filament
