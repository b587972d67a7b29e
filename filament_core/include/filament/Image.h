// SPDX-License-Identifier: Apache-2.0
/// Image: pixels in memory, tightly packed, row 0 at the top.
#pragma once

#include <filament/ColorGrading.h>
#include <filament/Format.h>
#include <filament/Result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace filament {

struct Image {
    uint32_t width = 0, height = 0;
    Format format = Format::RGBA8; ///< Renderer returns RGBA8 or RGB10A2 (display) or RGBA16F (scene-linear)
    std::vector<std::byte> pixels{};
};

/// RGBA8, or RGB10A2 as 16 bits a channel without alpha; codes of ColorGrading::outputSpace, which the file names (sRGB;
/// cICP, gAMA, cHRM). Errors: Unreadable with path and reason.
Result<void> savePng(std::filesystem::path const& path, Image const& image, OutputSpace space = OutputSpace::Srgb);
/// RGBA16F only, stored as half floats; linear Rec. 709, which the file says.
Result<void> saveExr(std::filesystem::path const& path, Image const& image);

} // namespace filament
