// SPDX-License-Identifier: Apache-2.0
/// ImageBasedLightFile: glTF files with an image-based light whose images are functions of face and pixel.
#pragma once

#include "filament_core/assets/gltf/GltfWriter.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <cstring>
#include <functional>

namespace filament_core::assets::test {

/// The four bytes of a pixel, R in the lowest.
using FacePixels = std::function<uint32_t(uint32_t level, uint32_t face, uint32_t x, uint32_t y)>;

inline Bytes facePicture(uint32_t size, GlbAlpha alpha, std::function<uint32_t(uint32_t x, uint32_t y)> const& pixel) {
    Bytes pixels(size_t{ size } * size * 4);
    for (uint32_t i = 0; i < size * size; ++i) {
        const uint32_t bits = pixel(i % size, i / size);
        std::memcpy(&pixels[size_t{ i } * 4], &bits, 4);
    }
    return glbImageFromPixels("face", size, size, pixels, alpha)->file;
}

inline size_t addImage(TestFile& file, Bytes const& picture) {
    file.root["images"].push_back({ { "bufferView", file.addView(picture) }, { "mimeType", "image/png" } });
    return file.root["images"].size() - 1;
}

/// Coefficients of a sky of radiance 1 everywhere.
inline Json whiteIrradiance() {
    Json rows = Json::array();
    const double white = 11.136655993663414; // pi * sqrt(4 pi)
    for (int i = 0; i < 9; ++i) rows.push_back(i == 0 ? Json{ white, white, white } : Json{ 0, 0, 0 });
    return rows;
}

/// A triangle whose scene names a light of this many levels.
inline TestFile fileWithLight(uint32_t size, uint32_t levels, FacePixels const& pixels,
                              GlbAlpha alpha = GlbAlpha::Always) {
    TestFile file = TestFile::triangle();
    Json images = Json::array();
    for (uint32_t level = 0; level < levels; ++level) {
        Json faces = Json::array();
        for (uint32_t face = 0; face < 6; ++face) {
            faces.push_back(addImage(file, facePicture(size >> level, alpha, [&](uint32_t x, uint32_t y) {
                                         return pixels(level, face, x, y);
                                     })));
        }
        images.push_back(faces);
    }
    file.root["extensionsUsed"] = { "EXT_lights_image_based" };
    file.root["extensionsRequired"] = { "EXT_lights_image_based" };
    file.root["extensions"]["EXT_lights_image_based"]["lights"] = {
        { { "irradianceCoefficients", whiteIrradiance() }, { "specularImageSize", size }, { "specularImages", images } }
    };
    file.root["scenes"][0]["extensions"]["EXT_lights_image_based"] = { { "light", 0 } };
    return file;
}

inline Json& lightOf(TestFile& file) { return file.root["extensions"]["EXT_lights_image_based"]["lights"][0]; }

} // namespace filament_core::assets::test
