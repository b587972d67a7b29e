// SPDX-License-Identifier: Apache-2.0
/// ChannelTransfer: converts 8-bit codes of an image channel to 16 bits of linear light and back.
///   Out     tables; one step of sRGB near black is 20 steps of 1/65535, so the conversion loses nothing.
///   Thread  any; the tables are computed once.
#pragma once

#include <array>
#include <cstdint>

namespace filament::assets {

struct ChannelTransfer {
    std::array<uint16_t, 256> linearFromCode;
    std::array<uint8_t, 65536> codeFromLinear; ///< the code with the nearest value
};

ChannelTransfer const& colorTransfer(); ///< sRGB
ChannelTransfer const& dataTransfer();  ///< plain numbers

} // namespace filament::assets
