// SPDX-License-Identifier: Apache-2.0
/// Skins and morph weights of a scene, kept in step with its nodes and renderables.
///   Thread  the app thread, except updateSkin(): several threads at once, each with its own skins.
///   Fails   a stale handle is an assertion.
#pragma once

#include "filament_core/scene/SceneData.h"

#include <span>

namespace filament::scene {

/// Removing `data.node`, if there is one, removes the skin.
Skin addSkin(SceneData& scene, SkinData data);
void removeSkin(SceneData& scene, Skin skin);

/// For a skin without joints.
void setBones(SceneData& scene, Skin skin, std::span<const float4x4> objectFromBind);

/// Missing weights count as 0, surplus ones are ignored; does nothing for a renderable without morph targets.
void setMorphWeights(SceneData& scene, Renderable renderable, std::span<const float> weights);

/// Whether the running update of the nodes has moved one of the skin's joints or its node.
bool hasMoved(SceneData const& scene, SkinData const& skin);

/// Computes the bones from their joints, then bounds and placement of everything that the skin moves. If a joint was
/// removed, its bone keeps its last pose.
void updateSkin(SceneData& scene, SkinData& skin);

/// Bounds and placement of one deformed renderable.
void placeDeformed(SceneData& scene, uint32_t deformation);

} // namespace filament::scene
