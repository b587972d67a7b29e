// SPDX-License-Identifier: Apache-2.0
/// Image: pixels in memory, tightly packed, row 0 at the top; read from files and written to them.
///   Thread  any; plain values. An image is decoded on the calling thread.
#pragma once

#include <filament_core/DisplayTransform.h>
#include <filament_core/Format.h>
#include <filament_core/Objects.h>
#include <filament_core/Result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core {

struct Image {
    uint32_t width = 0, height = 0;
    Format format = Format::RGBA8; ///< Renderer returns RGBA8, RGBA8Srgb, RGB10A2 (display) or RGBA16F (scene-linear)
    std::vector<std::byte> pixels{};
};

/// Meaning of the numbers in an image.
enum class ImageContent : uint8_t {
    Color, ///< codes of sRGB in PNG, JPEG, WebP and AVIF: base colours, what is shown
    Data,  ///< themselves: normals, roughness, occlusion, heights
};

struct ImageLoadOptions {
    ImageContent content = ImageContent::Color;
    bool fullFloats = false; ///< RGBA32F instead of RGBA16F: all 16 bits of heights, radiances above 65504
};

/// An image file; its first bytes determine the format, not its name.
///   8 bits     of PNG, JPEG, WebP, AVIF: RGBA8Srgb, or RGBA8 of data. Missing alpha is 255; grey is copied to all
///              colours; colour profiles are ignored; alpha is not multiplied in.
///   10 to 16   bits of PNG, AVIF: RGBA16F, colours as linear light, data as code / 65535.
///   KTX2, DDS  the first level: RGBA8Srgb or RGBA8, as the file says; RGBA16F where 8 bits do not hold it.
///   HDR, EXR   RGBA16F: linear, without alpha. Negative or not a number becomes 0; what a half cannot hold, 65504.
///   Limits     16384 a side; of AVIF, HDR, EXR 2^26 pixels; single-part EXR, scan lines or tiles; no cubes, arrays of
///              KTX2 and DDS.
///   Fails      NotFound, Unreadable, Corrupt, Unsupported, OutOfMemory: one line with the file, the reason and the
///              cure.
Result<Image> loadImage(std::filesystem::path const& path, ImageLoadOptions const& options = {});
/// From memory. `name` is used in messages.
Result<Image> loadImage(std::span<const std::byte> file, std::string_view name, ImageLoadOptions const& options = {});

/// Its texture, with all of its mips: for Engine::create(). Refers to the pixels of the image, which must live and stay
/// as they are until create() returns.
TextureDesc textureOf(Image const& image, std::string_view name = {});

/// RGBA8, RGBA8Srgb (the same codes), or RGB10A2 as 16 bits a channel without alpha; codes of `space`, which the file
/// names (sRGB; cICP, gAMA, cHRM). Errors: Unreadable with path and reason.
Result<void> savePng(std::filesystem::path const& path, Image const& image, OutputSpace space = OutputSpace::Srgb);
/// RGBA16F only, stored as half floats; linear Rec. 709, which the file says.
Result<void> saveExr(std::filesystem::path const& path, Image const& image);

/// Channels of an image in an OpenEXR file of several layers: "name.X", "name.Y", or "X", "Y" without a name.
struct ExrLayer {
    std::string name{};
    Image const* image = nullptr;                 ///< RGBA16F or RGBA32F
    std::span<const std::string_view> channels{}; ///< names of red and those after it, at most four
};

/// One part of scan lines, compressed without loss; samples keep their bits. Errors: InvalidArgument (images of
/// different sizes or of other formats; no channel; names of more than 31 letters, or there twice), Unreadable with
/// path and reason.
Result<void> saveExr(std::filesystem::path const& path, std::span<const ExrLayer> layers);

} // namespace filament_core
