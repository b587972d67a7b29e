// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/Ktx2Texels.h"

#include "filament_core/assets/blocks/BlockTexels.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace filament_core::assets {
namespace {

constexpr std::array kOrderOfTexels{ 'r', 'g', 'b', 'a' };

template <class Component>
void swizzle(std::array<char, 4> const& order, Component one, std::span<std::byte> texels) {
    std::array<Component, 6> from{ 0, 0, 0, 0, 0, one }; // r g b a 0 1
    std::array<size_t, 4> indices;
    for (size_t c = 0; c < 4; ++c) indices[c] = std::string_view("rgba01").find(order[c]);
    for (size_t at = 0; at < texels.size(); at += 4 * sizeof(Component)) {
        std::array<Component, 4> texel;
        std::memcpy(from.data(), &texels[at], sizeof(texel));
        for (size_t c = 0; c < 4; ++c) texel[c] = from[indices[c]];
        std::memcpy(&texels[at], texel.data(), sizeof(texel));
    }
}

void flipRows(size_t rowBytes, std::span<std::byte> layer) {
    for (size_t top = 0, bottom = layer.size(); top + 2 * rowBytes <= bottom; top += rowBytes, bottom -= rowBytes)
        std::swap_ranges(&layer[top], &layer[top] + rowBytes, &layer[bottom - rowBytes]);
}

void flipColumns(size_t rowBytes, size_t texelBytes, std::span<std::byte> layer) {
    for (size_t row = 0; row < layer.size(); row += rowBytes) {
        for (size_t left = 0, right = rowBytes; left + 2 * texelBytes <= right; left += texelBytes, right -= texelBytes)
            std::swap_ranges(&layer[row + left], &layer[row + left] + texelBytes, &layer[row + right - texelBytes]);
    }
}

} // namespace

bool isArranged(Ktx2File const& file) { return file.swizzle != kOrderOfTexels || file.isFlippedX || file.isFlippedY; }

void arrangeKtx2(Ktx2File const& file, Image const& image, uint32_t level, std::span<std::byte> texels) {
    const size_t texelBytes = backend::formatInfo(image.format).bytesPerBlock;
    if (file.swizzle != kOrderOfTexels) {
        if (texelBytes == 4) swizzle<uint8_t>(file.swizzle, 255, texels);
        if (texelBytes == 8) swizzle<uint16_t>(file.swizzle, blocks::TexelHalf::kOne, texels);
        if (texelBytes == 16) swizzle<float>(file.swizzle, 1, texels);
    }
    const size_t rowBytes = std::max(image.width >> level, 1u) * texelBytes, layerBytes = texels.size() / image.layers;
    for (uint32_t layer = 0; layer < image.layers; ++layer) {
        const auto part = texels.subspan(layer * layerBytes, layerBytes);
        if (file.isFlippedY) flipRows(rowBytes, part);
        if (file.isFlippedX) flipColumns(rowBytes, texelBytes, part);
    }
}

} // namespace filament_core::assets
