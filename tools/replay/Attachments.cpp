// SPDX-License-Identifier: Apache-2.0
#include "tools/replay/Attachments.h"

#include "backend/api/Format.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "toolkit/pictures/Pixels.h"

namespace filament_core::replay {
namespace {

Result<void> makeFolder(std::filesystem::path const& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error) return {};
    return fail(ErrorCode::Unreadable, "cannot make the folder '{}': {}; choose another one", folder.string(),
                error.message());
}

Result<void> writeFloats(std::filesystem::path const& path, backend::CapturedAttachment const& attachment) {
    std::vector<float3> pixels(size_t{ attachment.width } * attachment.height);
    for (size_t i = 0; i < pixels.size(); ++i) {
        const std::array<float, 4> value = tools::texel(attachment.format, attachment.bytes, i);
        pixels[i] = { value[0], value[1], value[2] };
    }
    return assets::writeExr(path, attachment.width, attachment.height, pixels, assets::ExrPrecision::Float);
}

} // namespace

std::string fileStem(std::string_view name) {
    constexpr size_t kMost = 64;
    std::string stem;
    for (const char c : name.substr(0, kMost)) {
        const bool isPlain =
                (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
        if (isPlain)
            stem += c;
        else if (!stem.ends_with('_')) // "color + tone map" is color_tone_map
            stem += '_';
    }
    return stem;
}

Result<std::filesystem::path> saveAttachment(std::filesystem::path const& folder, std::string const& stem,
                                             backend::CapturedAttachment const& attachment) {
    if (Result<void> made = makeFolder(folder); !made) return made.error();
    if (attachment.bytes.size() != backend::imageBytes(attachment.format, attachment.width, attachment.height))
        return fail(ErrorCode::Internal, "attachment '{}' was not read back", attachment.name);
    const bool isPng = attachment.format == Format::RGBA8 || attachment.format == Format::RGBA8Srgb;
    std::filesystem::path path = folder / (stem + (isPng ? ".png" : ".exr"));
    const Result<void> written =
            isPng ? assets::writePng(path, attachment.width, attachment.height, attachment.bytes)
            : attachment.format == Format::RGBA16F
                    ? assets::writeExr(path, attachment.width, attachment.height, std::span(attachment.bytes))
                    : writeFloats(path, attachment);
    if (!written) return written.error();
    return path;
}

Result<std::filesystem::path> savePicture(std::filesystem::path const& folder, std::string const& stem,
                                          record::FramePicture const& picture) {
    if (Result<void> made = makeFolder(folder); !made) return made.error();
    const bool isLight = picture.image.format == Format::RGBA16F;
    std::filesystem::path path = folder / (stem + (isLight ? ".exr" : ".png"));
    const Result<void> written = isLight ? saveExr(path, picture.image) : savePng(path, picture.image, picture.space);
    if (!written) return written.error();
    return path;
}

} // namespace filament_core::replay
