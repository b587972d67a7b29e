// SPDX-License-Identifier: Apache-2.0
/// glTF materials as instances of the engine's glTF materials: a package by shading and blending, specialised to
/// exactly the maps that the material uses. Equal specialisations share one material.
#pragma once

#include "filament_core/engine/gltf/GltfMaterialSettings.h"
#include "filament_core/engine/gltf/ModelImpl.h"
#include "filament_core/engine/gltf/ReadMaterials.h"

#include <map>
#include <string>

namespace filament_core {

class GltfMaterials {
public:
    /// `textures[i]` is images[i] of the model after uploading. `ready`: of the model, by readMaterials().
    GltfMaterials(Engine::Impl& engine, Model::Impl& model, std::vector<Texture> const& textures,
                  GltfReadyMaterials ready, bool hasSections)
            : mEngine(engine), mModel(model), mTextures(textures), mReady(std::move(ready)),
              mMaxMaps(choiceOf(engine).maxMaps), mHasSections(hasSections) {}

    /// `sectionPlanes`: of GltfLoadOptions.
    static GltfMaterialChoice choiceOf(Engine::Impl const& engine, bool sectionPlanes = false);

    /// `scale`: metres in the file's scene per metre of the mesh; it scales the thickness of volumes.
    MaterialInstance instanceFor(assets::MaterialData const& material, GltfVertices const& vertices, float scale);

private:
    Material materialFor(GltfMaterialSettings const& settings);

    Engine::Impl& mEngine;
    Model::Impl& mModel;
    std::vector<Texture> const& mTextures;
    GltfReadyMaterials mReady; ///< that no instance has yet
    size_t mMaxMaps;
    bool mHasSections;
    std::map<std::string, Material> mMaterials; ///< by package and constants
};

} // namespace filament_core
