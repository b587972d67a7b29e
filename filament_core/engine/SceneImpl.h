// SPDX-License-Identifier: Apache-2.0
/// Scene::Impl: the arrays of a scene and the engine whose handles they came from.
#pragma once

#include "filament_core/engine/gltf/ModelImpl.h"
#include "filament_core/prepare/UpdateTransforms.h"
#include "filament_core/scene/SceneData.h"

#include <filament/Scene.h>

namespace filament {

struct Scene::Impl {
    /// What a copy of a model is made of, for what changes it as a whole. Only of models with variants.
    struct ModelCopy {
        Node root;
        Model::Impl const* model = nullptr;
        std::vector<Renderable> renderables; ///< parallel to the model's; some may be removed already
    };

    /// The data after all changes of nodes: what frames and bounds are made from.
    scene::SceneData const& upToDate() const {
        prepare::updateTransforms(engine.jobs, data);
        return data;
    }

    Engine::Impl& engine;
    mutable scene::SceneData data; ///< what is derived from nodes is written when somebody asks for it
    std::vector<ModelCopy> copies;
};

} // namespace filament
