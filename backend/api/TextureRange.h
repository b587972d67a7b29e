// SPDX-License-Identifier: Apache-2.0
/// TextureRange: some levels and layers of a texture.
///   Thread  any; plain values and pure functions.
#pragma once

#include <cstdint>

namespace filament_core::backend {

/// A count of 0 reaches to the last level or layer; the default is everything.
struct TextureRange {
    uint8_t level = 0, levelCount = 0;
    uint16_t layer = 0, layerCount = 0;
    friend bool operator==(TextureRange const&, TextureRange const&) = default;
};

/// One level of every layer.
constexpr TextureRange oneLevel(uint8_t level) { return { .level = level, .levelCount = 1 }; }
/// Every level of one layer.
constexpr TextureRange oneLayer(uint16_t layer) { return { .layer = layer, .layerCount = 1 }; }

/// The range with counts above 0, in a texture of so many levels and layers. One that begins beyond them keeps its 0.
constexpr TextureRange withCounts(TextureRange range, uint8_t levels, uint16_t layers) {
    if (range.levelCount == 0 && range.level < levels) range.levelCount = static_cast<uint8_t>(levels - range.level);
    if (range.layerCount == 0 && range.layer < layers) range.layerCount = static_cast<uint16_t>(layers - range.layer);
    return range;
}

/// Of ranges with counts: whether all of the range exists in such a texture.
constexpr bool exists(TextureRange const& range, uint8_t levels, uint16_t layers) {
    return range.levelCount > 0 && range.layerCount > 0 && range.level + range.levelCount <= levels &&
           range.layer + range.layerCount <= layers;
}

/// Of ranges with counts: whether they have a level and layer in common.
constexpr bool overlap(TextureRange const& a, TextureRange const& b) {
    return a.level < b.level + b.levelCount && b.level < a.level + a.levelCount && a.layer < b.layer + b.layerCount &&
           b.layer < a.layer + a.layerCount;
}

/// Of ranges with counts: whether `outer` has all of `inner`.
constexpr bool contains(TextureRange const& outer, TextureRange const& inner) {
    return outer.level <= inner.level && inner.level + inner.levelCount <= outer.level + outer.levelCount &&
           outer.layer <= inner.layer && inner.layer + inner.layerCount <= outer.layer + outer.layerCount;
}

} // namespace filament_core::backend
