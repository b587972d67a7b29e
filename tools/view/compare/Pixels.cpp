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

std::optional<Image> partOf(Image const& image, uint2 offset, uint2 size) {
    const bool fits = size.x <= image.width && offset.x <= image.width - size.x && size.y <= image.height &&
                      offset.y <= image.height - size.y;
    if (!fits || image.pixels.size() != size_t{ image.width } * image.height * 4) return std::nullopt;
    Image part{ .width = size.x, .height = size.y, .format = image.format };
    part.pixels.reserve(size_t{ size.x } * size.y * 4);
    for (uint32_t y = 0; y < size.y; ++y) {
        const auto row =
                image.pixels.begin() + static_cast<ptrdiff_t>((size_t{ offset.y + y } * image.width + offset.x) * 4);
        part.pixels.insert(part.pixels.end(), row, row + static_cast<ptrdiff_t>(size_t{ size.x } * 4));
    }
    return part;
}

} // namespace filament::view
