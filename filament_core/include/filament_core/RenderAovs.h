// SPDX-License-Identifier: Apache-2.0
/// renderAovs(): arbitrary output variables of a view as images, and as one OpenEXR file; and what ids in them name.
///   Out     for each an image of RGBA32F, as View::size and Aov say.
///   Thread  the app thread, which waits for the pixels. Not while a frame is drawn. Histories and shadow maps of
///           other renderers are not touched.
///   Memory  16 B a pixel and image, and what a renderer of that size takes; all but the images is given back.
#pragma once

#include <filament_core/Aov.h>
#include <filament_core/Renderer.h>

#include <span>
#include <vector>

namespace filament_core {

/// `view.aov` and `view.viewport` are replaced; View::debugView must be None. An Aov may be there twice; None must not.
/// Fails as Renderer::waitPixels() and Engine::create() do.
Result<std::vector<Image>> renderAovs(Engine& engine, Scene const& scene, View const& view, std::span<const Aov> aovs);

/// The same by a renderer that the caller keeps, so that Aov::Motion counts from its last frame: of the call before
/// this one. Each Motion is a frame of its own, so a call has one at most, and no frame with light should lie in
/// between; frames of other AOVs leave the renderer's histories as they are.
Result<std::vector<Image>> renderAovs(Renderer& renderer, Scene const& scene, View const& view,
                                      std::span<const Aov> aovs);

/// What a number of Aov::ObjectId names in the scene as it is now: `renderable` or `light`, `node` and `primitive` of
/// the hit; the others are 0. No hit: no object has the number, or has it any more.
PickHit objectOf(Scene const& scene, uint32_t objectId);
/// What a number of Aov::MaterialId or MaterialInstanceId names, as long as the scene's renderables have the materials
/// that they had; none: there are not so many, or it was destroyed and is still drawn.
Material materialOf(Scene const& scene, uint32_t materialId);
MaterialInstance materialInstanceOf(Scene const& scene, uint32_t materialInstanceId);

/// A layer of an OpenEXR file for saveExr(), named as toString() does: "normal.X", "normal.Y", "normal.Z". `image` must
/// live until it is saved.
ExrLayer layerOf(Aov aov, Image const& image);

} // namespace filament_core
