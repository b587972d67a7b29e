// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/TexturePacking.h"

#include "base/Assert.h"
#include "filament_core/assets/image/ChannelTransfer.h"

#include <algorithm>
#include <array>

namespace filament_core::assets {
namespace {

constexpr size_t kPackedChannels = 4, kPackedAlpha = 3;

/// Between texels `first` and `second`, with weight / total of the second.
struct Tap {
    uint32_t first = 0, second = 0;
    uint64_t weight = 0, total = 1;

    uint64_t blend(uint64_t a, uint64_t b) const { return (a * (total - weight) + b * weight + total / 2) / total; }
};

/// The position of the centre of texel i of `size` among `sourceSize` texels.
Tap tapOf(uint32_t i, uint32_t size, uint32_t sourceSize) {
    const uint64_t total = 2 * uint64_t{ size };
    const uint64_t scaled = (2 * uint64_t{ i } + 1) * sourceSize; // in units of 1 / total, from the edge
    const uint64_t position = scaled > size ? scaled - size : 0;  // from the centre of the first texel
    const uint32_t last = sourceSize - 1;
    const uint32_t first = std::min(static_cast<uint32_t>(position / total), last);
    return { first, std::min(first + 1, last), position % total, total };
}

Image resized(Image const& source, uint32_t width, uint32_t height, bool isColor) {
    Image image{ .width = width, .height = height, .data = {} };
    image.data.resize(image.levelBytes(0));
    const auto texel = [&](uint32_t x, uint32_t y, size_t c, ChannelTransfer const& transfer) -> uint64_t {
        const auto code = static_cast<size_t>(source.data[(size_t{ y } * source.width + x) * kPackedChannels + c]);
        return transfer.linearFromCode[code];
    };
    std::byte* out = image.data.data();
    for (uint32_t y = 0; y < height; ++y) {
        const Tap v = tapOf(y, height, source.height);
        for (uint32_t x = 0; x < width; ++x) {
            const Tap h = tapOf(x, width, source.width);
            for (size_t c = 0; c < kPackedChannels; ++c, ++out) {
                ChannelTransfer const& transfer = isColor && c < kPackedAlpha ? colorTransfer() : dataTransfer();
                const uint64_t top =
                        h.blend(texel(h.first, v.first, c, transfer), texel(h.second, v.first, c, transfer));
                const uint64_t bottom =
                        h.blend(texel(h.first, v.second, c, transfer), texel(h.second, v.second, c, transfer));
                *out = std::byte{ transfer.codeFromLinear[v.blend(top, bottom)] };
            }
        }
    }
    return image;
}

Image withSize(Image image, uint32_t width, uint32_t height, bool isColor) {
    if (image.width == width && image.height == height) return image;
    return resized(image, width, height, isColor);
}

} // namespace

Image packImages(Image first, Image second, PackLayout layout) {
    for (Image const* image : { &first, &second }) {
        FILAMENT_ASSERT(image->format == backend::Format::RGBA8 && image->levels == 1 && image->layers == 1 &&
                                !image->data.empty() && image->data.size() == image->levelBytes(0),
                        "packImages takes two RGBA8 images of one level");
    }
    const uint32_t width = std::max(first.width, second.width), height = std::max(first.height, second.height);
    const bool isColor = layout == PackLayout::ColorAlpha;
    Image packed = withSize(std::move(first), width, height, isColor);
    const Image other = withSize(std::move(second), width, height, false);
    const size_t taken = isColor ? kPackedAlpha : 1;
    for (size_t i = taken; i < packed.data.size(); i += kPackedChannels) packed.data[i] = other.data[i];
    return packed;
}

} // namespace filament_core::assets
