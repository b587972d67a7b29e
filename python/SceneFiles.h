// SPDX-License-Identifier: Apache-2.0
/// SceneFiles: the class SceneFile.
#pragma once

#include "python/Bindings.h"

namespace filament_core::python {

void bindSceneFiles(py::module_& module);

} // namespace filament_core::python
