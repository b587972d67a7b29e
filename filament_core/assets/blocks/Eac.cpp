// SPDX-License-Identifier: Apache-2.0
// EAC: alpha of ETC2, and one or two channels of 11 bits. Khronos Data Format Specification 1.3, chapter 22.
#include "base/math/Half.h"
#include "filament_core/assets/blocks/BlockTexels.h"

#include <algorithm>
#include <array>

namespace filament_core::assets::blocks {
namespace {

/// Table "intensity modifiers for alpha".
constexpr std::array<std::array<int8_t, 8>, 16> kEacModifiers{ { { -3, -6, -9, -15, 2, 5, 8, 14 },
                                                                 { -3, -7, -10, -13, 2, 6, 9, 12 },
                                                                 { -2, -5, -8, -13, 1, 4, 7, 12 },
                                                                 { -2, -4, -6, -13, 1, 3, 5, 12 },
                                                                 { -3, -6, -8, -12, 2, 5, 7, 11 },
                                                                 { -3, -7, -9, -11, 2, 6, 8, 10 },
                                                                 { -4, -7, -8, -11, 3, 6, 7, 10 },
                                                                 { -3, -5, -8, -11, 2, 4, 7, 10 },
                                                                 { -2, -6, -8, -10, 1, 5, 7, 9 },
                                                                 { -2, -5, -8, -10, 1, 4, 7, 9 },
                                                                 { -2, -4, -8, -10, 1, 3, 7, 9 },
                                                                 { -2, -5, -7, -10, 1, 4, 6, 9 },
                                                                 { -3, -4, -7, -10, 2, 3, 6, 9 },
                                                                 { -1, -2, -3, -10, 0, 1, 2, 9 },
                                                                 { -4, -6, -8, -9, 3, 5, 7, 8 },
                                                                 { -3, -5, -7, -9, 2, 4, 6, 8 } } };

struct EacBlock {
    explicit EacBlock(const std::byte* bytes) : bits(loadBig(bytes)) {}
    int32_t base() const { return static_cast<int32_t>(bits >> 56); }
    int32_t multiplier() const { return static_cast<int32_t>(bits >> 52 & 15); }
    /// Texels are numbered by columns, the first in the highest bits.
    int32_t modifier(uint32_t x, uint32_t y) const {
        return kEacModifiers[bits >> 48 & 15][bits >> (45 - 3 * (4 * x + y)) & 7];
    }
    uint64_t bits;
};

/// Calls write(texel, value) with numbers of 11 bits, or of 10 and a sign.
template <class Write>
void forEachOf11Bits(const std::byte* bytes, bool isSigned, Write const& write) {
    const EacBlock block(bytes);
    const int32_t scale = block.multiplier() == 0 ? 1 : 8 * block.multiplier();
    int32_t base = 8 * block.base() + 4;
    if (isSigned) base = 8 * std::max<int32_t>(static_cast<int8_t>(block.base()), -127);
    const int32_t least = isSigned ? -1023 : 0, most = isSigned ? 1023 : 2047;
    for (uint32_t y = 0; y < 4; ++y) {
        for (uint32_t x = 0; x < 4; ++x) {
            const int32_t value = std::clamp(base + block.modifier(x, y) * scale, least, most);
            write(4 * y + x, halfFromFloat(static_cast<float>(value) / static_cast<float>(most)));
        }
    }
}

void decodeChannels(const std::byte* bytes, bool isSigned, bool hasGreen, TexelHalf* texels) {
    std::fill_n(texels, 16, TexelHalf{});
    forEachOf11Bits(bytes, isSigned, [texels](uint32_t texel, uint16_t half) { texels[texel].r = half; });
    if (hasGreen)
        forEachOf11Bits(bytes + 8, isSigned, [texels](uint32_t texel, uint16_t half) { texels[texel].g = half; });
}

} // namespace

void decodeEacAlpha(const std::byte* bytes, uint8_t* codes) {
    const EacBlock block(bytes);
    for (uint32_t y = 0; y < 4; ++y) {
        for (uint32_t x = 0; x < 4; ++x)
            codes[4 * y + x] = clampedTo8(block.base() + block.modifier(x, y) * block.multiplier());
    }
}

void decodeEacR(const std::byte* block, TexelHalf* texels) { decodeChannels(block, false, false, texels); }
void decodeEacRSigned(const std::byte* block, TexelHalf* texels) { decodeChannels(block, true, false, texels); }
void decodeEacRg(const std::byte* block, TexelHalf* texels) { decodeChannels(block, false, true, texels); }
void decodeEacRgSigned(const std::byte* block, TexelHalf* texels) { decodeChannels(block, true, true, texels); }

} // namespace filament_core::assets::blocks
