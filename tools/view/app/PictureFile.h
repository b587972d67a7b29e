// SPDX-License-Identifier: Apache-2.0
/// PictureFile: the formats that images of a viewer are saved in.
///   Thread  any.   Fails: savePicture(): Unreadable with the path and the reason.
#pragma once

#include <filament_core/Image.h>

#include <filesystem>
#include <optional>

namespace filament_core::view {

enum class PictureFormat : uint8_t {
    Png, ///< what is shown: RGBA8, as the document grades it
    Exr, ///< light before the tone mapper: RGBA16F
};

inline const char* endingOf(PictureFormat format) { return format == PictureFormat::Exr ? ".exr" : ".png"; }
/// By the ending, in any case; none: another one.
std::optional<PictureFormat> pictureFormatOf(std::filesystem::path const& file);
/// Of the image that is drawn for it.
inline Format imageFormatOf(PictureFormat format) {
    return format == PictureFormat::Exr ? Format::RGBA16F : Format::RGBA8;
}
inline Result<void> savePicture(std::filesystem::path const& file, Image const& image, OutputSpace space) {
    return image.format == Format::RGBA16F ? saveExr(file, image) : savePng(file, image, space);
}

} // namespace filament_core::view
