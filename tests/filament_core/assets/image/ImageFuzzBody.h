// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay test: for any bytes, decoding a picture gives an error with the picture's name,
/// or as many pixels as the header says; and the same twice.
#pragma once

#include "base/Assert.h"
#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/ImageSize.h"

#include <span>

namespace filament::assets::test {

inline constexpr uint64_t kMaxFuzzedPixels = 1u << 20;

/// Returns whether it was a picture.
inline bool fuzzImage(std::span<const std::byte> bytes) {
    const uint2 size = imageSize(bytes);
    if (uint64_t{ size.x } * size.y > kMaxFuzzedPixels) return false; // only slow
    const Result<Image> image = decodeImage(bytes, "fuzzed");
    if (!image) {
        FILAMENT_ASSERT(image.error().message.starts_with("image 'fuzzed' "), "an error names its picture");
        return false;
    }
    FILAMENT_ASSERT(image->data.size() == image->levelBytes(0), "every pixel is there");
    const Result<Image> again = decodeImage(bytes, "fuzzed");
    FILAMENT_ASSERT(again.ok() && again->data == image->data, "decoding twice gives the same pixels");
    return true;
}

} // namespace filament::assets::test
