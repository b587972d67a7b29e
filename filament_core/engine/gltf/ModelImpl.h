// SPDX-License-Identifier: Apache-2.0
/// Model::Impl: the result of loadGltf, owned until the model is destroyed.
#pragma once

#include "filament_core/assets/files/PathInside.h"
#include "filament_core/assets/gltf/Animation.h"
#include "filament_core/assets/gltf/ModelData.h"
#include "filament_core/assets/gltf/NodePose.h"
#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/gltf/GltfMaterialSettings.h"

#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>
#include <filament_core/Light.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace filament_core {

struct Model::Impl {
    static constexpr uint32_t kRoot = ~0u; ///< the node that a copy of the model is attached to

    static constexpr uint32_t kNoSkin = ~0u;

    struct PartNode {
        std::string name;
        uint32_t parent = kRoot; ///< into `nodes`, before this one
        double4x4 parentFromNode{ 1.0 };
        assets::NodePose pose{};         ///< the local transform, decomposed
        bool isVisible = true;           ///< of its own, at rest
        bool isSelectable = true;        ///< of its own, at rest
        bool isHoverable = true;         ///< of its own, at rest
        uint32_t visibleWith = kRoot;    ///< another node that hides it, before this one
        uint32_t ofFile = assets::kNone; ///< the node of the file that it is, or whose mesh it carries
        bool carriesMesh = false;        ///< assets::NodeData
        bool isCoarserLevel = false;     ///< assets::NodeData
    };
    struct PartSkin {
        uint32_t node = kRoot;        ///< into `nodes`: the node that the renderables are attached to
        std::vector<uint32_t> joints; ///< into `nodes`
        std::vector<float4x4> jointFromBind;
    };
    struct PartVariant {
        uint32_t variant = 0; ///< into `variants`
        MaterialInstance material;
    };
    struct PartRenderable {
        RenderableDesc desc;     ///< its node and skin are those of a copy: none yet
        uint32_t node = kRoot;   ///< into `nodes`
        uint32_t skin = kNoSkin; ///< into `skins`
        uint32_t ofNode =
                kRoot; ///< into `nodes`: the node of the file; `node` may be one below it that scales positions
        std::vector<PartVariant> variants;
        std::vector<std::string> targetNames; ///< of its morph targets, as far as the file names them
    };
    struct PartLight {
        LightDesc light; ///< in the node's space
        uint32_t node = kRoot;
        std::string name;    ///< of the light, not of its node
        uint32_t source = 0; ///< into `lightsOfFile`
    };
    struct PartCamera {
        assets::CameraData camera;
        uint32_t node = kRoot;
        uint32_t source = 0; ///< into `camerasOfFile`
    };
    struct AnimatedInstance {
        MaterialInstance instance;
        GltfVertices vertices;
        float scale = 1;
        std::vector<uint32_t> targets; ///< those of AnimatedMaterial::properties that it has
    };
    struct AnimatedMaterial {
        assets::MaterialData data;        ///< at rest
        std::vector<uint32_t> properties; ///< into `properties`
        std::vector<AnimatedInstance> instances;
    };

    /// What saveGltf() needs to find what the program changed of an instance of a material of the file.
    struct InstanceOrigin {
        MaterialInstance instance;
        uint32_t material = assets::kNone; ///< of the file; none: glTF's default material
        GltfVertices vertices;
        float scale = 1;
        std::vector<backend::TextureHandle> textures; ///< scene::MaterialInstance::textures, as it was loaded
    };
    /// Where the file is.
    struct Source {
        std::filesystem::path path{}; ///< absolute; empty: the file was in memory
        uint64_t bytes = 0;           ///< as it was read
        int64_t changedAt = 0;        ///< when it was written last
        assets::FilesFrom files = assets::FilesFrom::Folder;
    };

    explicit Impl(Engine& owner) : engine(owner.impl()), link(owner) {}
    ~Impl();

    Engine::Impl& engine; ///< while the link is alive
    engine::EngineLink link;
    std::string name;
    std::vector<PartNode> nodes; ///< parents before children
    size_t fileNodes = 0;        ///< the first ones are nodes of the file; those that scale positions follow
    std::vector<PartSkin> skins;
    std::vector<PartRenderable> renderables;
    std::vector<assets::AnimationData> animations; ///< their nodes are those of `nodes`
    std::vector<PartLight> lights;
    std::vector<PartCamera> cameras;

    std::vector<assets::LevelsData> levels;      ///< their nodes are those of `nodes`
    std::vector<uint8_t> mayChange;              ///< by node: whether an animation or a level can show or hide it
    std::vector<assets::LightData> lightsOfFile; ///< empty if neither levels nor animations show or change lights

    // KHR_animation_pointer: empty without it
    std::vector<assets::AnimatedProperty> properties; ///< channels refer to them; materials: into `animatedMaterials`
    std::vector<AnimatedMaterial> animatedMaterials;
    std::vector<assets::CameraData> camerasOfFile;

    Source source;
    std::vector<InstanceOrigin> origins;

    std::vector<std::string> variants, warnings;
    Box bounds;
    std::optional<Environment> environment;

    std::vector<Texture> textures;
    std::vector<LightProfile> profiles;
    std::vector<LightImage> lightImages;
    std::vector<MorphTargets> morphTargets;
    std::vector<VertexBuffer> vertexBuffers;
    std::vector<uint32_t> vertexVersions; ///< of these vertices, as they were loaded: scene::ContentVersions
    std::vector<IndexBuffer> indexBuffers;
    std::vector<Material> materials;
    std::vector<MaterialInstance> instances;
};

namespace engine {

/// A model for something of `engine`, which keeps it. Ends the process if it was moved from, or is of another engine.
std::shared_ptr<const Model::Impl> shareOf(Model const& model, Engine::Impl const& engine);

} // namespace engine
} // namespace filament_core
