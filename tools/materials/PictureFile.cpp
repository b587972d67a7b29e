// SPDX-License-Identifier: Apache-2.0
#include "tools/materials/PictureFile.h"

#include "base/Result.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageDecoder.h"

#include <algorithm>

namespace filament::tools {

Result<Owned<Texture>> loadPictureTexture(Engine& engine, std::filesystem::path const& path) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(path);
    if (!bytes) return bytes.error();
    const Result<assets::Image> image = assets::decodeImage(*bytes, path.string());
    if (!image) return image.error();
    const uint32_t largest = engine.device().maxTextureSize;
    if (std::max(image->width, image->height) > largest) {
        return fail(ErrorCode::Unsupported, "'{}' has {} x {} pixels, and the device takes {} a side; make it smaller",
                    path.string(), image->width, image->height, largest);
    }
    return engine.own(engine.create(TextureDesc{ .format = Format::RGBA8Srgb,
                                                 .width = image->width,
                                                 .height = image->height,
                                                 .generateMips = true,
                                                 .pixels = image->data,
                                                 .name = path.filename().string() }));
}

} // namespace filament::tools
