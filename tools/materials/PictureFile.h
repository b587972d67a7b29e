// SPDX-License-Identifier: Apache-2.0
/// loadPictureTexture: a picture of sRGB colours as a texture with all of its mip levels.
///   In      a .png or .jpg file.
///   Thread  that of the engine.
///   Fails   NotFound, Unreadable, Corrupt, Unsupported: one line with the path and the reason.
#pragma once

#include <filament/Engine.h>

#include <filesystem>

namespace filament::tools {

Result<Owned<Texture>> loadPictureTexture(Engine& engine, std::filesystem::path const& path);

} // namespace filament::tools
