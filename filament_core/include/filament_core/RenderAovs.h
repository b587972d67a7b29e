// SPDX-License-Identifier: Apache-2.0
/// renderAovs(): arbitrary output variables of a view as images, and as one OpenEXR file.
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

/// A layer of an OpenEXR file for saveExr(), named as toString() does: "normal.X", "normal.Y", "normal.Z". `image` must
/// live until it is saved.
ExrLayer layerOf(Aov aov, Image const& image);

} // namespace filament_core
