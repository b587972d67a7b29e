// SPDX-License-Identifier: Apache-2.0
/// Model::Impl: what loadGltf made, owned until the model is destroyed.
#pragma once

#include "filament_core/engine/EngineImpl.h"

#include <filament/Gltf.h>
#include <filament/Light.h>

#include <variant>
#include <vector>

namespace filament {

struct Model::Impl {
    using PartLight = std::variant<SunLight, PointLight, SpotLight>; ///< in model space

    explicit Impl(Engine& owner) : engine(owner.impl()) {}
    ~Impl();

    Engine::Impl& engine;
    std::string name;
    std::vector<RenderableDesc> parts; ///< worldFromObject holds modelFromObject
    std::vector<PartLight> lights;
    std::vector<std::string> warnings;
    Box bounds;

    std::vector<Texture> textures;
    std::vector<VertexBuffer> vertexBuffers;
    std::vector<IndexBuffer> indexBuffers;
    std::vector<Material> materials;
    std::vector<MaterialInstance> instances;
};

} // namespace filament
