// SPDX-License-Identifier: Apache-2.0
/// Scene::Impl: the arrays of a scene and the engine whose handles they came from.
#pragma once

#include "filament_core/engine/gltf/ModelImpl.h"
#include "filament_core/prepare/UpdateTransforms.h"
#include "filament_core/scene/SceneData.h"

#include <filament/Scene.h>

#include <utility>

namespace filament {

struct Scene::Impl {
    explicit Impl(Engine& owner) : engine(owner.impl()), link(owner) { engine.scenes.push_back(this); }
    ~Impl() {
        if (!link.isAlive()) return;
        std::erase(engine.scenes, this);
        engine.aUseEnded = true;
    }

    /// The parts of one copy of a model, for changes to the whole copy. Only for models with variants.
    struct ModelCopy {
        Node root;
        std::shared_ptr<const Model::Impl> model;
        std::vector<Renderable> renderables; ///< parallel to the model's; some may have been removed
    };

    /// The data after all changes of nodes and material instances, from which frames and bounds are computed.
    scene::SceneData const& upToDate() const {
        if (std::exchange(rasterChanges, engine.rasterChanges) != engine.rasterChanges) {
            data.renderables.drawables.updateOrders();
        }
        prepare::updateTransforms(engine.jobs, data);
        return data;
    }

    /// The data, to be changed.
    scene::SceneData& changed() {
        ++changes;
        return data;
    }

    /// The same, to remove or replace what is in it.
    scene::SceneData& changedUses() {
        engine.aUseEnded = true;
        return changed();
    }

    Engine::Impl& engine; ///< while the link is alive
    engine::EngineLink link;
    mutable scene::SceneData data; ///< data derived from nodes is computed on demand
    mutable uint64_t rasterChanges = 0;
    uint64_t changes = 0; ///< by the app
    std::vector<ModelCopy> copies;
};

} // namespace filament
