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
    static constexpr uint32_t kRoot = ~0u; ///< the node that a copy of the model hangs below

    struct PartNode {
        std::string name;
        uint32_t parent = kRoot; ///< into `nodes`, before this one
        double4x4 parentFromNode{ 1.0 };
    };
    struct PartRenderable {
        RenderableDesc desc;   ///< its node is that of a copy: none yet
        uint32_t node = kRoot; ///< into `nodes`
    };
    struct PartLight {
        std::variant<SunLight, PointLight, SpotLight> light; ///< in the node's space
        uint32_t node = kRoot;
    };

    explicit Impl(Engine& owner) : engine(owner.impl()) {}
    ~Impl();

    Engine::Impl& engine;
    std::string name;
    std::vector<PartNode> nodes; ///< parents before children
    std::vector<PartRenderable> renderables;
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
