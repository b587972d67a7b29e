// SPDX-License-Identifier: Apache-2.0
/// Scene::Impl: the arrays of a scene and the engine whose handles they came from.
#pragma once

#include "filament_core/engine/EngineImpl.h"
#include "filament_core/scene/SceneData.h"

#include <filament/Scene.h>

namespace filament {

struct Scene::Impl {
    Engine::Impl& engine;
    scene::SceneData data;
};

} // namespace filament
