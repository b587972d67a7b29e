// SPDX-License-Identifier: Apache-2.0
/// loadLightImage: an image that a light multiplies with its light, such as SpotLight::cookie.
///   In      every file of loadImage(): PNG, JPEG, WebP, AVIF, KTX2, DDS, HDR and EXR.
///   Memory  of the engine, and on the device while it is in view: 4 B a texel and a third more, at most 1.4 MiB.
///   Errors  those of loadImage(), and InvalidArgument for a size that does not fit the shape.
///   Thread  the app thread.
#pragma once

#include <filament_core/Engine.h>

#include <filesystem>

namespace filament_core {

/// Destroy it with Engine::destroy(), or let Owned<LightImage> do it; lights keep what they need of it.
Result<LightImage> loadLightImage(Engine& engine, std::filesystem::path const& path,
                                  LightImageShape shape = LightImageShape::Projected);

} // namespace filament_core
