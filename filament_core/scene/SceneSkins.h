// SPDX-License-Identifier: Apache-2.0
/// Skins and morph weights of a scene, kept in step with its nodes and renderables.
///   Thread  the app thread, except updateSkin(): several threads at once, each with its own skins.
///   Fails   a stale handle is an assertion.
#pragma once

#include "filament_core/scene/SceneData.h"

#include <span>

namespace filament_core::scene {

/// The skin ends with `data.node`, if that is one.
Skin addSkin(SceneData& scene, SkinRecord data);
void removeSkin(SceneData& scene, Skin skin);

/// For a skin without joints.
void setBones(SceneData& scene, Skin skin, std::span<const float4x4> objectFromBind);

/// Missing weights count as 0, surplus ones are ignored; does nothing for a renderable without morph targets.
void setMorphWeights(SceneData& scene, Renderable renderable, std::span<const float> weights);

/// Whether one of the joints of the skin, or its node, was moved by the update of the nodes that runs.
bool hasMoved(SceneData const& scene, SkinRecord const& skin);

/// Bones from where the joints are, then bounds and placement of all that the skin moves. A joint that was removed
/// leaves its bone where it was.
void updateSkin(SceneData& scene, SkinRecord& skin);

/// Bounds and placement of one deformed renderable.
void placeDeformed(SceneData& scene, uint32_t deformation);

} // namespace filament_core::scene
