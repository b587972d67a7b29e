// SPDX-License-Identifier: Apache-2.0
#include "toolkit/materials/PictureFile.h"

#include "base/Result.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageDecoder.h"

#include <algorithm>

namespace filament_core::tools {

Result<assets::Image> readPictureFile(std::filesystem::path const& path) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(path);
    if (!bytes) return bytes.error();
    return assets::decodeImage(*bytes, path.string());
}

Result<Owned<Texture>> makePictureTexture(Engine& engine, assets::Image const& picture,
                                          std::filesystem::path const& path) {
    const uint32_t largest = engine.device().maxTextureSize;
    if (std::max(picture.width, picture.height) > largest) {
        return fail(ErrorCode::Unsupported, "'{}' has {} x {} pixels, and the device takes {} a side; make it smaller",
                    path.string(), picture.width, picture.height, largest);
    }
    return engine.own(engine.create(TextureDesc{ .format = Format::RGBA8Srgb,
                                                 .width = picture.width,
                                                 .height = picture.height,
                                                 .generateMips = true,
                                                 .pixels = picture.data,
                                                 .name = path.filename().string() }));
}

Result<Owned<Texture>> loadPictureTexture(Engine& engine, std::filesystem::path const& path) {
    const Result<assets::Image> picture = readPictureFile(path);
    if (!picture) return picture.error();
    return makePictureTexture(engine, *picture, path);
}

} // namespace filament_core::tools
