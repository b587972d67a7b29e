// SPDX-License-Identifier: Apache-2.0
/// What nodes carry: renderables and lights whose object space is the space of a node.
///   In      handles of the same scene.   Out: world columns of renderables and records of lights; placeAttached()
///           updates them whenever a node has moved.
///   Thread  the app thread, except placeAttached(): several threads at once, each with its own nodes.
///   Fails   a stale handle is an assertion, and so is attaching something twice.
#pragma once

#include "filament_core/scene/SceneData.h"

namespace filament_core::scene {

/// From now on the node gives the renderable its transform; the renderable's own transform is discarded.
void attach(SceneData& scene, Renderable renderable, Node node);
/// The current position and direction of the light's record are taken as being in the node's space.
void attach(SceneData& scene, Light light, Node node);
/// Replaces a light; if it is attached, its position and direction are in the node's space.
void setLight(SceneData& scene, Light light, LightRecord const& record);

/// The node it is attached to; none: it has its own transform.
Node nodeOf(SceneData const& scene, Renderable renderable);
Node nodeOf(SceneData const& scene, Light light);

/// Of all renderables attached to the node or to a node below it.
void setLightChannels(SceneData& scene, Node node, uint8_t channels);
void setLayers(SceneData& scene, Node node, uint8_t select, uint8_t layers);
void setDrawOrder(SceneData& scene, Node node, DrawOrder place);
void setVisible(SceneData& scene, Node node, bool isVisible);

/// Whether picks hit the node and what is below it; a node is hit only if all above it are.
void setPickable(SceneData& scene, Node node, PickAim aim, bool isHit);
/// With all above.
bool isPickable(SceneData const& scene, Node node, PickAim aim);

/// Removes the node, its descendants, and every renderable, light and skin attached to them. Returns the indices of the
/// removed nodes.
std::vector<uint32_t> removeNode(SceneData& scene, Node node);

/// Moves everything attached to the node in `slot` to the place that the last update gave the node.
void placeAttached(SceneData& scene, uint32_t slot);

} // namespace filament_core::scene
