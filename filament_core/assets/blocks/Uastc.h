// SPDX-License-Identifier: Apache-2.0
/// The modes and partitions of UASTC LDR 4x4 blocks (UASTC LDR 4x4 Texture Specification, Binomial).
#pragma once

#include <array>
#include <cstdint>

namespace filament_core::assets::blocks {

enum class UastcChannels : uint8_t { Rgb, Rgba, LuminanceAlpha };

struct UastcMode {
    uint8_t code, codeBits; ///< its name, from the lowest bit of the block
    UastcChannels channels;
    uint8_t colorRange; ///< of the ends, in kAstcRanges
    uint8_t weightBits, planes, subsets;
    uint8_t hintBits; ///< for transcoders
};

inline constexpr uint32_t kUastcSolidMode = 8;
inline constexpr std::array<UastcMode, 19> kUastcModes{ {
        { 0x01, 4, UastcChannels::Rgb, 19, 4, 1, 1, 15 },
        { 0x35, 6, UastcChannels::Rgb, 20, 2, 1, 1, 15 },
        { 0x1D, 5, UastcChannels::Rgb, 8, 3, 1, 2, 15 },
        { 0x03, 5, UastcChannels::Rgb, 7, 2, 1, 3, 15 },
        { 0x13, 5, UastcChannels::Rgb, 12, 2, 1, 2, 15 },
        { 0x0B, 5, UastcChannels::Rgb, 20, 3, 1, 1, 15 },
        { 0x1B, 5, UastcChannels::Rgb, 18, 2, 2, 1, 15 },
        { 0x07, 5, UastcChannels::Rgb, 12, 2, 1, 2, 15 },
        { 0x17, 5, UastcChannels::Rgba, 0, 0, 0, 0, 0 },
        { 0x0F, 5, UastcChannels::Rgba, 8, 2, 1, 2, 23 },
        { 0x02, 3, UastcChannels::Rgba, 13, 4, 1, 1, 17 },
        { 0x00, 2, UastcChannels::Rgba, 13, 2, 2, 1, 17 },
        { 0x06, 3, UastcChannels::Rgba, 19, 3, 1, 1, 17 },
        { 0x1F, 5, UastcChannels::Rgba, 20, 1, 2, 1, 23 },
        { 0x0D, 5, UastcChannels::Rgba, 20, 2, 1, 1, 23 },
        { 0x05, 7, UastcChannels::LuminanceAlpha, 20, 4, 1, 1, 23 },
        { 0x15, 6, UastcChannels::LuminanceAlpha, 20, 2, 1, 2, 23 },
        { 0x25, 6, UastcChannels::LuminanceAlpha, 20, 2, 2, 1, 23 },
        { 0x09, 4, UastcChannels::Rgb, 11, 5, 1, 1, 15 },
} };

/// The partitions of blocks, as seeds of those of ASTC: of modes with two subsets, with three, and of mode 7.
inline constexpr std::array<uint16_t, 30> kUastcSeedsOfTwo{ 28,  20,  16,  29,  91,  9,   107, 72,  149, 204,
                                                            50,  114, 496, 17,  78,  39,  252, 828, 43,  156,
                                                            116, 210, 476, 273, 684, 359, 246, 195, 694, 524 };
inline constexpr std::array<uint16_t, 11> kUastcSeedsOfThree{ 260, 74, 32, 156, 183, 15, 745, 0, 335, 902, 254 };
inline constexpr std::array<uint16_t, 19> kUastcSeedsOfMode7{ 36,  48,  61,  137, 161, 183, 226, 281, 302, 307,
                                                              479, 495, 593, 594, 605, 799, 812, 988, 993 };

} // namespace filament_core::assets::blocks
