// SPDX-License-Identifier: Apache-2.0
#include "tools/view/compare/Pixels.h"

#include "backend/api/Format.h"
#include "base/math/Half.h"

#include <cstring>

namespace filament::view {

Result<void> checkPicture(Image const& image) {
    const bool isPicture = image.format == Format::RGBA8 || image.format == Format::RGBA8Srgb ||
                           image.format == Format::RGB10A2 || image.format == Format::RGBA16F;
    if (!isPicture)
        return fail(ErrorCode::InvalidArgument,
                    "a picture of {} is not compared; give RGBA8, RGBA8Srgb, RGB10A2 or RGBA16F",
                    backend::formatInfo(image.format).name);
    const size_t bytes = pixelCount(image) * backend::formatInfo(image.format).bytesPerBlock;
    if (bytes > 0 && image.pixels.size() == bytes) return {};
    return fail(ErrorCode::InvalidArgument, "a picture of {}x{} pixels with {} bytes is none", image.width,
                image.height, image.pixels.size());
}

std::array<float, 4> pixelAt(Image const& image, size_t index) {
    std::array<float, 4> value{};
    if (image.format == Format::RGBA16F) {
        uint16_t halves[4];
        std::memcpy(halves, image.pixels.data() + 8 * index, sizeof halves);
        for (size_t c = 0; c < 4; ++c) value[c] = floatFromHalf(halves[c]);
        return value;
    }
    uint32_t word = 0;
    std::memcpy(&word, image.pixels.data() + 4 * index, sizeof word);
    const bool isTen = image.format == Format::RGB10A2;
    for (uint32_t c = 0; c < 4; ++c) {
        const uint32_t bits = !isTen ? 8 : c == 3 ? 2 : 10, largest = (1u << bits) - 1;
        const uint32_t shift = isTen ? 10 * c : 8 * c;
        value[c] = static_cast<float>(word >> shift & largest) / static_cast<float>(largest);
    }
    return value;
}

} // namespace filament::view
