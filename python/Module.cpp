// SPDX-License-Identifier: Apache-2.0
// The extension module filament_core._core; filament_core/__init__.py is what programs import.
#include "python/SceneFiles.h"

PYBIND11_MODULE(_core, module) {
    using namespace filament_core::python;
    module.doc() = "The engine of filament_core: import filament_core instead.";
    bindErrors(module);
    EngineClass engine = bindEngine(module);
    bindView(module);
    bindMaterials(module, engine);
    bindMeshes(module, engine);
    bindScene(module);
    bindRenderer(module);
    bindSceneFiles(module);
    bindCompare(module);
}
