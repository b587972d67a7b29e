// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/MipMaps.h"

#include "base/Assert.h"
#include "base/math/Half.h"
#include "filament_core/assets/image/ChannelTransfer.h"
#include "filament_core/assets/image/MipTaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace filament_core::assets {
namespace {

constexpr uint32_t kChannels = 4;
constexpr uint32_t kAlpha = 3;

/// A level in 16-bit linear light.
struct Level {
    uint32_t width = 0, height = 0;
    std::vector<uint16_t> texels;
};

/// How the image stores its channels.
struct Encoding {
    ChannelTransfer const& color;
    ChannelTransfer const& alpha;
};

void decodeRow(std::byte const* codes, uint32_t width, Encoding const& encoding, uint16_t* texels) {
    for (uint32_t x = 0; x < width; ++x, codes += kChannels, texels += kChannels) {
        for (uint32_t c = 0; c < kAlpha; ++c) texels[c] = encoding.color.linearFromCode[static_cast<size_t>(codes[c])];
        texels[kAlpha] = encoding.alpha.linearFromCode[static_cast<size_t>(codes[kAlpha])];
    }
}

void encodeLevel(Level const& level, Encoding const& encoding, std::byte* codes) {
    for (size_t i = 0; i < level.texels.size(); i += kChannels) {
        for (size_t c = 0; c < kAlpha; ++c)
            codes[i + c] = std::byte{ encoding.color.codeFromLinear[level.texels[i + c]] };
        codes[i + kAlpha] = std::byte{ encoding.alpha.codeFromLinear[level.texels[i + kAlpha]] };
    }
}

/// Two rows to one, both sizes even: the plain mean of four. The compiler vectorises it.
void halveRows(uint16_t const* row0, uint16_t const* row1, uint32_t width, uint16_t* out) {
    for (uint32_t x = 0; x < width; ++x) {
        for (uint32_t c = 0; c < kChannels; ++c) {
            const uint32_t sum = uint32_t{ row0[c] } + row0[c + kChannels] + row1[c] + row1[c + kChannels];
            out[c] = static_cast<uint16_t>((sum + 2) >> 2);
        }
        row0 += 2 * kChannels, row1 += 2 * kChannels, out += kChannels;
    }
}

/// For any sizes: weighted means over up to 3 x 3 texels. `row(y)` returns row y of the source.
template <class Row>
void resampleRow(Row const& row, uint32_t y, uint32_t sourceWidth, uint32_t sourceHeight, uint32_t width,
                 uint16_t* out) {
    const MipTaps vertical = mipTapsOf(y, sourceHeight);
    std::array<uint16_t const*, 3> rows{};
    for (uint32_t i = 0; i < vertical.count; ++i) rows[i] = row(vertical.first + i);
    for (uint32_t x = 0; x < width; ++x, out += kChannels) {
        const MipTaps horizontal = mipTapsOf(x, sourceWidth);
        for (uint32_t c = 0; c < kChannels; ++c) {
            float sum = 0;
            for (uint32_t i = 0; i < vertical.count; ++i) {
                for (uint32_t j = 0; j < horizontal.count; ++j) {
                    const uint16_t texel = rows[i][(horizontal.first + j) * kChannels + c];
                    sum += vertical.weight<float>(i) * horizontal.weight<float>(j) * static_cast<float>(texel);
                }
            }
            out[c] = static_cast<uint16_t>(std::min(sum + 0.5f, 65535.0f));
        }
    }
}

/// `row(y)` returns row y of the source; the last three rows returned stay valid.
template <class Row>
Level halve(uint32_t sourceWidth, uint32_t sourceHeight, Row const& row) {
    Level level{ std::max(1u, sourceWidth / 2), std::max(1u, sourceHeight / 2), {} };
    level.texels.resize(size_t{ level.width } * level.height * kChannels);
    const bool isEven = sourceWidth % 2 == 0 && sourceHeight % 2 == 0;
    for (uint32_t y = 0; y < level.height; ++y) {
        uint16_t* out = &level.texels[size_t{ y } * level.width * kChannels];
        if (isEven) {
            halveRows(row(2 * y), row(2 * y + 1), level.width, out);
        } else {
            resampleRow(row, y, sourceWidth, sourceHeight, level.width, out);
        }
    }
    return level;
}

/// Computes level 1 from `codes`, an 8-bit level 0, decoding three rows at a time.
Level halveCodes(std::byte const* codes, uint32_t width, uint32_t height, Encoding const& encoding) {
    std::array<std::vector<uint16_t>, 3> decoded;
    for (auto& row : decoded) row.resize(size_t{ width } * kChannels);
    return halve(width, height, [&](uint32_t y) {
        std::vector<uint16_t>& row = decoded[y % 3];
        decodeRow(codes + size_t{ y } * width * kChannels, width, encoding, row.data());
        return row.data();
    });
}

Level halveLevel(Level const& level) {
    return halve(level.width, level.height,
                 [&](uint32_t y) { return &level.texels[size_t{ y } * level.width * kChannels]; });
}

/// Fills levels 1.. of one layer; `image` has room for them.
void fillLevels(Image& image, uint32_t layer, Encoding const& encoding) {
    const auto layerOf = [&](uint32_t level) {
        return &image.data[image.levelOffset(level) + layer * (image.levelBytes(level) / image.layers)];
    };
    if (image.levels == 1) return;
    // Each level is computed from the 16-bit light of the one before, not from its 8-bit codes: the rounding of all
    // levels would add up.
    Level level = halveCodes(layerOf(0), image.width, image.height, encoding);
    for (uint32_t i = 1; i < image.levels; ++i) {
        encodeLevel(level, encoding, layerOf(i));
        if (i + 1 < image.levels) level = halveLevel(level);
    }
}

/// The first level as 16-bit light.
Level lightOf(DeepImage const& base, bool isColor) {
    Level level{ base.width, base.height, base.codes };
    if (!isColor) return level;
    std::vector<float> const& light = lightOfDeepCodes();
    for (size_t i = 0; i < level.texels.size(); ++i) {
        if (i % kChannels != kAlpha)
            level.texels[i] = static_cast<uint16_t>(std::lround(light[base.codes[i]] * 65535.0f));
    }
    return level;
}

/// `count` numbers value(0), value(1), ...
template <class Value>
void encodeHalves(size_t count, Value const& value, std::byte* halves) {
    for (size_t i = 0; i < count; ++i) {
        const uint16_t half = halfFromFloat(value(i));
        std::memcpy(halves + i * sizeof(half), &half, sizeof(half));
    }
}

} // namespace

void dropLargeLevels(Image& image, uint32_t maxSize) {
    uint32_t dropped = 0;
    while (maxSize > 0 && (std::max(image.width, image.height) >> dropped) > maxSize) ++dropped;
    if (dropped == 0) return;
    // Another vector: that of the large levels would keep their memory as long as the small ones live.
    image.data = std::vector<std::byte>(image.data.begin() + static_cast<std::ptrdiff_t>(image.levelOffset(dropped)),
                                        image.data.end());
    image.width = std::max(1u, image.width >> dropped);
    image.height = std::max(1u, image.height >> dropped);
    image.levels -= dropped;
}

Image withMipMaps(DeepImage const& base, bool isColor, uint32_t maxSize) {
    FILAMENT_ASSERT(!base.codes.empty() && base.codes.size() == size_t{ kChannels } * base.width * base.height,
                    "the image must hold its pixels");
    Image image{ .width = base.width, .height = base.height, .format = backend::Format::RGBA16F, .data = {} };
    image.levels = backend::fullMipCount(image.width, image.height);
    image.data.resize(image.levelOffset(image.levels));
    std::vector<float> const& light = lightOfDeepCodes();
    const auto exact = [&](size_t i) {
        return isColor && i % kChannels != kAlpha ? light[base.codes[i]] : shareOfDeepCode(base.codes[i]);
    };
    encodeHalves(base.codes.size(), exact, image.data.data());
    Level level = lightOf(base, isColor);
    for (uint32_t i = 1; i < image.levels; ++i) {
        level = halveLevel(level);
        encodeHalves(
                level.texels.size(), [&](size_t at) { return shareOfDeepCode(level.texels[at]); },
                &image.data[image.levelOffset(i)]);
    }
    // Last: the remaining levels are averages of the larger ones that are removed here.
    dropLargeLevels(image, maxSize);
    return image;
}

Image withMipMaps(Image base, bool isColor, uint32_t maxSize) {
    FILAMENT_ASSERT(base.format == backend::Format::RGBA8 && base.levels == 1,
                    "withMipMaps takes an RGBA8 image of one level");
    FILAMENT_ASSERT(base.data.size() == base.levelBytes(0) && !base.data.empty(), "the image must hold its pixels");
    const Encoding encoding{ isColor ? colorTransfer() : dataTransfer(), dataTransfer() };
    Image image = std::move(base);
    image.format = isColor ? backend::Format::RGBA8Srgb : backend::Format::RGBA8;
    image.levels = backend::fullMipCount(image.width, image.height);
    image.data.resize(image.levelOffset(image.levels));
    for (uint32_t layer = 0; layer < image.layers; ++layer) fillLevels(image, layer, encoding);
    dropLargeLevels(image, maxSize);
    return image;
}

} // namespace filament_core::assets
