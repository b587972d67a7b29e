// SPDX-License-Identifier: Apache-2.0
/// ChannelTransfer: converts 8-bit codes of an image channel to 16 bits of linear light and back, and 16-bit codes to
/// floats.
///   Out     tables; one step of sRGB near black is 20 steps of 1/65535, so the conversion loses nothing.
///   Thread  any; the tables are computed once.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace filament_core::assets {

/// IEC 61966-2-1, of codes in [0, 1].
double linearFromSrgb(double code);

struct ChannelTransfer {
    std::array<uint16_t, 256> linearFromCode;
    std::array<uint8_t, 65536> codeFromLinear; ///< the code with the nearest value
};

ChannelTransfer const& colorTransfer(); ///< sRGB
ChannelTransfer const& dataTransfer();  ///< plain numbers

/// The light of each of the 65536 codes of sRGB with 16 bits, in [0, 1].
std::vector<float> const& lightOfDeepCodes();
/// A plain number with 16 bits.
inline float shareOfDeepCode(uint32_t code) { return static_cast<float>(code) / 65535.0f; }

} // namespace filament_core::assets
