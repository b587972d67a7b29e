// SPDX-License-Identifier: Apache-2.0
/// SceneParts: what was added to a scene, as Python holds it. Each part keeps its scene, and knows when it was removed.
#pragma once

#include "python/Bindings.h"

namespace filament_core::python {

using SceneClass = py::class_<SceneObject, std::shared_ptr<SceneObject>>;

struct ShapeObject {
    std::shared_ptr<SceneObject> scene;
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

/// Scene.add(), and the class ModelCopy.
void bindModelCopies(py::module_& module, SceneClass& scene);

} // namespace filament_core::python
