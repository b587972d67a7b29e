// SPDX-License-Identifier: Apache-2.0
/// SceneParts: what was added to a scene, as Python holds it. Each part keeps its scene, and knows when it was removed.
#pragma once

#include "python/Bindings.h"

#include <filament_core/Environment.h>

#include <optional>
#include <string>

namespace filament_core::python {

using SceneClass = py::class_<SceneObject, std::shared_ptr<SceneObject>>;

struct ShapeObject {
    std::shared_ptr<SceneObject> scene;
    std::shared_ptr<MeshObject> mesh;
    std::string name;
    Renderable renderable; ///< none: removed

    /// Raises ClosedError once it was removed.
    Renderable live() const {
        if (!renderable) raiseClosedError("the shape was removed from its scene");
        return renderable;
    }
};

struct LightObject {
    std::shared_ptr<SceneObject> scene;
    Light light; ///< none: removed

    Light live() const {
        if (!light) raiseClosedError("the light was removed from its scene");
        return light;
    }
};

struct CopyObject {
    std::shared_ptr<SceneObject> scene;
    std::shared_ptr<ModelObject> model;
    Node root; ///< none: removed
    std::shared_ptr<Held<Animator>> animator;

    Node live() const {
        if (!root) raiseClosedError("the copy was removed from its scene");
        return root;
    }
    ModelCopy parts() const { return valueOf(ModelCopy::of(**scene, live())); }
};

struct ProbeObject {
    std::shared_ptr<SceneObject> scene;
    ReflectionProbe probe{};                    ///< none: removed
    std::optional<Environment> captured{};      ///< its light, if it is the probe's own
    std::shared_ptr<EnvironmentObject> given{}; ///< otherwise

    ReflectionProbe live() const {
        if (!probe) raiseClosedError("the reflection probe was removed from its scene");
        return probe;
    }
};

/// Scene.add_reflection_probe(), and the class ReflectionProbe.
void bindProbes(py::module_& module, SceneClass& scene);
/// Scene.add(), and the class ModelCopy.
void bindModelCopies(py::module_& module, SceneClass& scene);
/// Scene.identify() and its like, and the class Identified.
void bindIds(py::module_& module, SceneClass& scene);

} // namespace filament_core::python
