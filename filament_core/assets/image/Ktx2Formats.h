// SPDX-License-Identifier: Apache-2.0
/// Ktx2Formats: the VkFormats of KTX 2.0 and DDS files that are read, and their texels as floats or 8-bit codes.
///   Texels  red, green, blue, alpha; channels that a format does not have are 0, alpha is 1 (Vulkan 1.3, "Component
///           substitution").
///   Sources  Vulkan 1.3, "Formats"; KTX 2.0 Specification, table "Prohibited formats"
#pragma once

#include "filament_core/assets/blocks/BlockFormat.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace filament_core::assets {

enum class Ktx2Numbers : uint8_t {
    Codes,  ///< unsigned, 0 to 1
    Signed, ///< -1 to 1; the least number is -1 as well
    Floats, ///< of 16 or 32 bits
    Shared, ///< E5B9G9R9
    Packed, ///< B10G11R11
};

/// Where a channel lies in a texel: its lowest bit and its number of bits; 0 bits: the format does not have it.
struct Ktx2Channel {
    uint8_t first = 0, bits = 0;
};

struct Ktx2Format {
    std::optional<BlockFormat> block; ///< then the rest of this is unused, but `isSrgb`
    uint8_t texelBytes = 0;
    Ktx2Numbers numbers = Ktx2Numbers::Codes;
    bool isSrgb = false;
    std::array<Ktx2Channel, 4> channels{}; ///< red, green, blue, alpha

    /// All of it fits into 8 bits a channel.
    bool hasCodesOf8() const;
};

/// Nothing for a format that is not read: integers, 64 bits, three dimensions, several planes.
std::optional<Ktx2Format> ktx2Format(uint32_t vkFormat);

/// `texels` are RGBA8; format.hasCodesOf8().
void decodeCodes(Ktx2Format const& format, std::span<const std::byte> bytes, std::span<std::byte> texels);
/// `texels` are RGBA16F, or RGBA32F if `isFull`. Values that are no numbers are 0; too large ones the largest number.
void decodeFloats(Ktx2Format const& format, std::span<const std::byte> bytes, bool isFull, std::span<std::byte> texels);
/// Halves as floats.
void widenHalves(std::span<const std::byte> halves, std::span<std::byte> floats);

} // namespace filament_core::assets
