// SPDX-License-Identifier: Apache-2.0
/// loadPictureTexture: an image of sRGB colours as a texture with all of its mip levels.
///   In      a .png or .jpg file.
///   Thread  that of the engine.
///   Fails   NotFound, Unreadable, Corrupt, Unsupported: one line with the path and the reason.
#pragma once

#include "filament_core/assets/image/Image.h"

#include <filament_core/Engine.h>

#include <filesystem>

namespace filament_core::tools {

/// The two parts of it: the first on any thread.
Result<assets::Image> readPictureFile(std::filesystem::path const& path);
Result<Owned<Texture>> makePictureTexture(Engine& engine, assets::Image const& picture,
                                          std::filesystem::path const& path);

Result<Owned<Texture>> loadPictureTexture(Engine& engine, std::filesystem::path const& path);

} // namespace filament_core::tools
