// SPDX-License-Identifier: Apache-2.0
/// CopiesOfModels: the objects that Scene::add(model) created, by the root of the copy.
///   Out     handles in the order of the parts of the model; those of parts that the program has removed are dead.
///   Memory  handles of every node, renderable and light of a copy. Looking up and removing are O(1).
///   Life    materials of a copy's own end with its record, after its renderables.
///   Thread  app.   Fails: add(): std::bad_alloc.
#pragma once

#include "filament_core/engine/gltf/ModelImpl.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace filament_core::engine {

/// A material instance that replaces a shared one in one copy. Destroyed at its end.
class OwnMaterial {
public:
    OwnMaterial(Engine::Impl& engine, MaterialInstance shared);
    OwnMaterial(OwnMaterial&& other) noexcept
            : shared(other.shared), instance(std::exchange(other.instance, {})), mEngine(other.mEngine),
              mLink(std::move(other.mLink)) {}
    OwnMaterial& operator=(OwnMaterial&&) = delete;
    ~OwnMaterial();

    MaterialInstance shared;   ///< of the model
    MaterialInstance instance; ///< with the same parameters at first

private:
    Engine::Impl* mEngine; ///< while the link is alive
    EngineLink mLink;
};

/// The visible parts of a copy. All is empty until an animation or a level of detail changes it.
struct ShownParts {
    std::vector<assets::LightData> lights; ///< as an animation left those of the file
    std::vector<uint8_t> isVisible;        ///< by node of the model: of its own, as an animation left it
    std::vector<uint8_t> isOtherLevel;     ///< by node of the model: another level of the same thing is shown
    std::vector<uint32_t> levels; ///< by entry of Model::Impl::levels: which one is shown; as many as it has: none
    std::vector<uint8_t> isShown; ///< by node of the model: with all above
    std::vector<Box> boxes;       ///< scratch of chooseLevels(), by node of the model
};

struct CopyOfModel {
    Node root;
    std::shared_ptr<const Model::Impl> model;
    std::vector<Node> nodes;             ///< parallel to the model's
    std::vector<Renderable> renderables; ///< parallel to the model's
    std::vector<Light> lights;           ///< parallel to the model's
    std::vector<OwnMaterial> own{};
    std::vector<assets::CameraData> cameras{}; ///< as an animation left those of the file; empty: as they are there
    ShownParts parts{};
    std::string variant{};

    /// The copy's own instance instead of a shared one, if it has one.
    MaterialInstance shown(MaterialInstance shared) const;
};

class CopiesOfModels {
public:
    void add(CopyOfModel copy) { mCopies.insert_or_assign(copy.root.index(), std::move(copy)); }
    /// Null: no copy has this root.
    CopyOfModel* find(Node root) {
        const auto found = mCopies.find(root.index());
        return found != mCopies.end() && found->second.root == root ? &found->second : nullptr;
    }
    CopyOfModel const* find(Node root) const { return const_cast<CopiesOfModels*>(this)->find(root); }
    /// The node with this index was removed, whatever it was.
    void remove(uint32_t node) { mCopies.erase(node); }

private:
    std::unordered_map<uint32_t, CopyOfModel> mCopies; // by the index of the root
};

/// The copy's own instance of a shared one of its model, made where it has none; renderables of the copy that show the
/// shared one show the own one from now on.
MaterialInstance ownInstance(Scene::Impl& scene, CopyOfModel& copy, MaterialInstance shared);

/// Scene::setVariant().
Result<void> setVariant(Scene::Impl& scene, CopyOfModel& copy, std::string_view variant);

} // namespace filament_core::engine
