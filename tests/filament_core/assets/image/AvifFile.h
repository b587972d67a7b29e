// SPDX-License-Identifier: Apache-2.0
/// AvifFile: AVIF files for tests, whose planes are stored without loss.
#pragma once

#include "base/math/Math.h"

#include <avif/avif.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace filament_core::assets::test {

struct AvifFile {
    uint32_t width = 4, height = 4, depth = 8;
    avifPixelFormat format = AVIF_PIXEL_FORMAT_YUV444;
    avifRange range = AVIF_RANGE_FULL;
    avifMatrixCoefficients matrix = AVIF_MATRIX_COEFFICIENTS_IDENTITY;
    avifColorPrimaries primaries = AVIF_COLOR_PRIMARIES_BT709;
    avifTransferCharacteristics transfer = AVIF_TRANSFER_CHARACTERISTICS_SRGB;
    bool hasAlpha = false, isPremultiplied = false;
    uint32_t pictures = 1;
    std::function<void(avifImage&)> change{}; ///< of the image before it is written
    /// Planes are luma, chroma, chroma, alpha; of the identity green, blue, red, alpha.
    std::function<uint32_t(uint32_t plane, uint2 at)> code = [](uint32_t plane, uint2 at) {
        return 40 * plane + 7 * at.x + 11 * at.y + 10;
    };

    using Image = std::unique_ptr<avifImage, decltype(&avifImageDestroy)>;

    Image image() const {
        Image image(avifImageCreate(width, height, depth, format), &avifImageDestroy);
        image->yuvRange = range, image->matrixCoefficients = matrix;
        image->colorPrimaries = primaries, image->transferCharacteristics = transfer;
        image->alphaPremultiplied = isPremultiplied;
        // libavif 1.x returns a result, 0.11 nothing; without planes or a file the test fails
        static_cast<void>(avifImageAllocatePlanes(image.get(), AVIF_PLANES_YUV));
        if (hasAlpha) static_cast<void>(avifImageAllocatePlanes(image.get(), AVIF_PLANES_A));
        for (uint32_t plane = 0; plane < 3; ++plane) {
            const bool isSmallX = plane > 0 && format != AVIF_PIXEL_FORMAT_YUV444;
            const bool isSmallY = plane > 0 && format == AVIF_PIXEL_FORMAT_YUV420;
            if (image->yuvPlanes[plane])
                fill(image->yuvPlanes[plane], image->yuvRowBytes[plane], plane,
                     { isSmallX ? (width + 1) / 2 : width, isSmallY ? (height + 1) / 2 : height });
        }
        if (hasAlpha) fill(image->alphaPlane, image->alphaRowBytes, 3, { width, height });
        if (change) change(*image);
        return image;
    }

    std::vector<std::byte> file() const {
        const Image picture = image();
        const std::unique_ptr<avifEncoder, decltype(&avifEncoderDestroy)> encoder(avifEncoderCreate(),
                                                                                  &avifEncoderDestroy);
        encoder->speed = 10, encoder->maxThreads = 1;
        encoder->minQuantizer = encoder->maxQuantizer = encoder->minQuantizerAlpha = encoder->maxQuantizerAlpha =
                AVIF_QUANTIZER_LOSSLESS;
        for (uint32_t i = 0; i < pictures; ++i)
            static_cast<void>(
                    avifEncoderAddImage(encoder.get(), picture.get(), 1,
                                        pictures == 1 ? AVIF_ADD_IMAGE_FLAG_SINGLE : AVIF_ADD_IMAGE_FLAG_NONE));
        avifRWData data = AVIF_DATA_EMPTY;
        static_cast<void>(avifEncoderFinish(encoder.get(), &data));
        const auto bytes = std::as_bytes(std::span(data.data, data.size));
        std::vector<std::byte> file(bytes.begin(), bytes.end());
        avifRWDataFree(&data);
        return file;
    }

private:
    void fill(uint8_t* bytes, size_t rowBytes, uint32_t plane, uint2 size) const {
        for (uint32_t y = 0; y < size.y; ++y) {
            for (uint32_t x = 0; x < size.x; ++x) {
                const uint32_t value = code(plane, { x, y }) & ((1u << depth) - 1);
                if (depth == 8)
                    bytes[y * rowBytes + x] = static_cast<uint8_t>(value);
                else
                    reinterpret_cast<uint16_t*>(bytes + y * rowBytes)[x] = static_cast<uint16_t>(value);
            }
        }
    }
};

} // namespace filament_core::assets::test
