// SPDX-License-Identifier: Apache-2.0
/// Skins and morph weights of a scene, kept in step with its nodes and its renderables.
///   Thread  the app thread, except updateSkin(): several threads at once, each with skins of its own.
///   Fails   a stale handle is an assertion.
#pragma once

#include "filament_core/scene/SceneData.h"

#include <span>

namespace filament::scene {

/// The skin ends with `data.node`, if that is one.
Skin addSkin(SceneData& scene, SkinData data);
void removeSkin(SceneData& scene, Skin skin);

/// Of a skin without joints.
void setBones(SceneData& scene, Skin skin, std::span<const float4x4> objectFromBind);

/// What is missing counts as 0, what is beyond the targets is left out; nothing happens to a renderable without any.
void setMorphWeights(SceneData& scene, Renderable renderable, std::span<const float> weights);

/// Whether one of the joints of the skin, or its node, was moved by the update of the nodes that runs.
bool hasMoved(SceneData const& scene, SkinData const& skin);

/// Bones from where the joints are, then bounds and placement of all that the skin moves. A joint that was removed
/// leaves its bone where it was.
void updateSkin(SceneData& scene, SkinData& skin);

/// Bounds and placement of one deformed renderable.
void placeDeformed(SceneData& scene, uint32_t deformation);

} // namespace filament::scene
