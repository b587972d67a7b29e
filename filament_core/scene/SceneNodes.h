// SPDX-License-Identifier: Apache-2.0
/// What nodes carry: renderables and lights whose object space is the space of a node.
///   In      handles of the same scene.   Out: world columns of renderables and records of lights, kept in step with
///           their nodes by placeAttached() whenever a node has moved.
///   Thread  the app thread, except placeAttached(): several threads at once, each with nodes of its own.
///   Fails   a stale handle is an assertion; so is attaching what hangs at a node already.
#pragma once

#include "filament_core/scene/SceneData.h"

namespace filament::scene {

/// From now on the renderable stands where the node stands; what it had as its own transform is forgotten.
void attach(SceneData& scene, Renderable renderable, Node node);
/// Position and direction of the light's record, as they are now, become those in the node's space.
void attach(SceneData& scene, Light light, Node node);

/// The node it hangs at; none: it has a transform of its own.
Node nodeOf(SceneData const& scene, Renderable renderable);
Node nodeOf(SceneData const& scene, Light light);

/// The node, all nodes below it, and every renderable, light and skin that hangs at one of them.
void removeNode(SceneData& scene, Node node);

/// Moves what hangs at the node in `slot` to where the node was found by the last update.
void placeAttached(SceneData& scene, uint32_t slot);

} // namespace filament::scene
