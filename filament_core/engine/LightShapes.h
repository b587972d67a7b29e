// SPDX-License-Identifier: Apache-2.0
/// LightShapes: rectangles, discs and tubes that are drawn (RectLight::isVisible), each as a renderable of the scene
/// that the app has no handle of, with the light's luminance and its image.
///   Thread  the app thread.
///   Memory  a renderable and a material instance for each such light, of an image a texture; one mesh an engine, made
///           at the first.
///   Cost    without such a light a test of an empty list each frame.
#pragma once

#include "filament_core/engine/EngineImpl.h"
#include "filament_core/scene/SceneData.h"

#include <filament_core/Scene.h>

namespace filament_core::engine {

/// After the app added or replaced a light: begins, changes or ends what is drawn of it.
void updateLightShape(Scene::Impl& scene, Light light);
/// Moves what is drawn to where the lights are now, and ends what is drawn of lights that were removed.
void placeLightShapes(Engine::Impl& engine, scene::SceneData& data);
/// Of a scene or an engine that ends: what the engine holds of them.
void destroyLightShapes(Engine::Impl& engine, scene::SceneData& data);

} // namespace filament_core::engine
