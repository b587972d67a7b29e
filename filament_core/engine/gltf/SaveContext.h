// SPDX-License-Identifier: Apache-2.0
/// SaveContext: what the steps of saveGltf() share: the scene, the files of its models, and the file in the making.
///   Thread  the app thread.
#pragma once

#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/gltf/GltfMerge.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/engine/gltf/ModelImpl.h"

#include <filament_core/SaveGltf.h>

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace filament_core::engine {

/// The file of a model; its place in GltfMerge::sources is its place in SaveContext::sources.
struct SavedSource {
    Model::Impl const* model = nullptr;
    assets::GltfDocument document; ///< of the file, without its buffers
};

struct SaveContext {
    explicit SaveContext(Scene::Impl const& ofScene) : scene(ofScene), engine(ofScene.engine) {}

    Scene::Impl const& scene;
    Engine::Impl& engine;
    assets::GltfMerge merge{};
    std::vector<SavedSource> sources{};

    template <class... Args>
    void warn(fmt::format_string<Args...> format, Args&&... args) {
        merge.warnings.push_back(fmt::format(format, std::forward<Args>(args)...));
    }

    scene::Drawable const& drawableOf(Renderable renderable) const {
        scene::Renderables const& all = scene.data.renderables;
        return all.drawables[all.drawable[all.index.at(renderable)]];
    }
    /// Null: it has neither a skin nor morph targets.
    scene::Deformation const* deformationOf(Renderable renderable) const {
        scene::Renderables const& all = scene.data.renderables;
        const uint32_t slot = scene::deformationAt(all, all.index.at(renderable));
        return slot == scene::kNotDeformed ? nullptr : &scene.data.deformations.all()[slot];
    }
    bool isHidden(Renderable renderable) const {
        scene::Renderables const& all = scene.data.renderables;
        return (all.flags[all.index.at(renderable)] & scene::kHidden) != 0;
    }
};

/// The object behind a handle of the device, live or retired; null: it has none.
template <class Tag, class State, class Handle>
State const* stateBehind(HandleTable<Tag, State>& table, Handle handle) {
    State const* found = nullptr;
    table.forEachHeld([&](auto, State const& state) {
        if (state.handle == handle) found = &state;
    });
    return found;
}

/// What a material instance is in the file.
struct SavedMaterial {
    uint32_t source = assets::kNone;   ///< a material of a file as it is: its source
    uint32_t material = assets::kNone; ///< ... and its place there; none: glTF's default material
    uint32_t changed = assets::kNone;  ///< else: into GltfMerge::materials
    bool isShown = true;               ///< false: glTF has nothing like it
};

/// Materials of the scene, each once.
class SavedMaterials {
public:
    explicit SavedMaterials(SaveContext& context) : mContext(context) {}
    /// The instances of a copy, before they are asked for. `source`: that of its model.
    void know(CopyOfModel const& copy, uint32_t source);
    Result<SavedMaterial> find(scene::MaterialInstance const& instance);
    /// The same as an entry of GltfMerge::materials, for meshes of other files.
    Result<uint32_t> entryOf(scene::MaterialInstance const& instance);

private:
    struct Origin {
        uint32_t source = assets::kNone;
        Model::Impl::InstanceOrigin const* origin = nullptr;
        bool isAnimated = false;
    };
    Result<SavedMaterial> ofFile(scene::MaterialInstance const& instance, Origin const& origin);
    Result<SavedMaterial> own(scene::MaterialInstance const& instance);
    Result<std::optional<uint32_t>> imageOf(scene::TextureBinding const& binding, std::string const& user);

    SaveContext& mContext;
    std::unordered_map<scene::MaterialInstance const*, Origin> mOrigins;
    std::unordered_map<scene::MaterialInstance const*, SavedMaterial> mKnown;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> mEntries; // source and material -> GltfMerge::materials
    std::map<uint64_t, uint32_t> mImages;                       // by texture
};

/// Meshes that the program made, read back from the device.
class SavedGeometry {
public:
    explicit SavedGeometry(SaveContext& context) : mContext(context) {}
    /// Of others than triangles the mode is written, too; with what its skin and morph targets need. Empty: it has no
    /// positions.
    Result<assets::GltfMergePrimitive> read(Renderable renderable);

private:
    Result<void> addTargets(scene::MorphTargets const& morph, std::span<const uint32_t> used,
                            assets::GltfMergePrimitive& primitive);
    Result<std::vector<std::byte> const*> bytesOf(backend::BufferHandle buffer, uint64_t bytes);

    SaveContext& mContext;
    std::map<uint64_t, std::vector<std::byte>> mBuffers, mDeltas;
};

/// Skins that the program made, as joints and inverse bind matrices.
class SavedSkins {
public:
    explicit SavedSkins(SaveContext& context) : mContext(context) {}
    /// Where a node of the scene is among GltfMerge::nodes; `isItself`: else what is below it is there.
    void know(Node node, uint32_t written, bool isItself) { mWritten[node.index()] = { written, isItself }; }
    /// It deforms the mesh of a node of the file, which is below `parent`.
    void use(Skin skin, uint32_t node, uint32_t parent) { mUses.push_back({ skin, node, parent }); }
    /// After all nodes.
    void finish();

private:
    struct Place {
        uint32_t written = assets::kNone;
        bool isItself = false;
    };
    struct Use {
        Skin skin{};
        uint32_t node = assets::kNone, parent = assets::kNone;
    };
    assets::GltfMergeSkin skinOf(scene::SkinRecord const& record, uint32_t parent);
    uint32_t addBone(size_t number, uint32_t parent);

    SaveContext& mContext;
    std::unordered_map<uint32_t, Place> mWritten; // by slot of the node
    std::vector<Use> mUses;
};

/// Pixels of a level of a texture.
Result<std::vector<std::byte>> readBack(Engine::Impl& engine, TextureState const& texture);
Result<std::vector<std::byte>> readBack(Engine::Impl& engine, backend::BufferHandle buffer, uint64_t bytes);

/// A light in the space of its node, or in the world, as a node of its own. Its name says what it is if it has none.
assets::GltfMergeNode savedLight(SaveContext& context, scene::LightRecord const& record, std::string const& name);
/// In every member.
bool isSameLight(scene::LightRecord const& a, scene::LightRecord const& b);

/// The environment and the cameras of the options.
void saveSurroundings(SaveContext& context, GltfSaveOptions const& options);

/// Nodes, and all that is attached to them.
Result<void> saveNodes(SaveContext& context, GltfSaveOptions const& options);

} // namespace filament_core::engine
