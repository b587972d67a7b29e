// SPDX-License-Identifier: Apache-2.0
/// Scene::Impl: the arrays of a scene and the engine whose handles they came from.
#pragma once

#include "filament_core/engine/LightShapes.h"
#include "filament_core/engine/gltf/CopiesOfModels.h"
#include "filament_core/prepare/UpdateTransforms.h"
#include "filament_core/scene/SceneData.h"

#include <filament_core/Scene.h>

#include <utility>
#include <vector>

namespace filament_core {

struct Scene::Impl {
    explicit Impl(Engine& owner) : engine(owner.impl()), link(owner) {
        data.versions = &engine.contentVersions;
        engine.scenes.push_back(this);
    }
    ~Impl() {
        if (!link.isAlive()) return;
        engine::destroyLightShapes(engine, data);
        std::erase(engine.scenes, this);
        engine.aUseEnded = true;
    }

    /// A renderable whose bounds are those of its vertices.
    struct FollowedBounds {
        Renderable renderable;
        VertexBuffer vertices;
    };

    /// The data after all changes of nodes and material instances, from which frames and bounds are computed.
    scene::SceneData const& upToDate() const {
        if (std::exchange(rasterChanges, engine.rasterChanges) != engine.rasterChanges) {
            data.renderables.drawables.updateUses();
        }
        prepare::updateTransforms(engine.jobs, data);
        if (!data.lightShapes.empty()) engine::placeLightShapes(engine, data);
        if (boundsChanges != engine.boundsChanges) followVertices();
        return data;
    }

    /// The same, once a frame: what rests is taken into blocks.
    scene::SceneData const& settled() const {
        upToDate();
        scene::settle(data.renderables);
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

    /// Those that setEnvironment() added.
    void removeEnvironmentLights() {
        for (const Light light : std::exchange(environmentLights, {})) scene::removeLight(changedUses(), light);
    }

    /// Ends the process if it lacks what the material reads, or its indices are not in the index buffer.
    scene::Geometry geometryOf(GeometryDesc const& desc, scene::Material const& material) const;
    /// Those that it names; otherwise those of its vertices, or of the origin if they have no positions.
    scene::MinMax boundsOf(GeometryDesc const& desc) const;
    /// From now on the renderable's bounds are those of its vertices, unless `desc` names others.
    void follow(Renderable renderable, GeometryDesc const& desc);
    /// Updates renderables without explicit bounds to the bounds of their vertices.
    void followVertices() const;

    Engine::Impl& engine; ///< while the link is alive
    engine::EngineLink link;
    mutable scene::SceneData data; ///< data derived from nodes is computed on demand
    mutable uint64_t rasterChanges = 0;
    std::vector<FollowedBounds> followed; ///< by the index of the renderable
    mutable uint64_t boundsChanges = 0;   ///< of the engine, that `followed` have seen
    uint64_t changes = 0;                 ///< by the app
    engine::CopiesOfModels copies;
    /// Of the frames that are drawn meanwhile: members of prepare::ViewInput. renderShares() sets and resets it.
    struct Dark {
        std::span<const uint8_t> lights{};
        bool environment = false;
    };
    mutable Dark dark{};
    std::vector<Light> environmentLights; ///< that setEnvironment() added
};

} // namespace filament_core
