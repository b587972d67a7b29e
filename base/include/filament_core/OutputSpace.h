// SPDX-License-Identifier: Apache-2.0
/// OutputSpace: the colour space of the values that a display gets. Of images (DisplayTransform.h) and of windows
/// (SwapChainDesc).
///   Thread  any; a plain value.
#pragma once

#include <filament_core/EnumNames.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace filament_core {

/// Linear outputs (RGBA16F) are linear Rec. 709 with any of them.
enum class OutputSpace : uint8_t {
    Srgb,         ///< IEC 61966-2-1
    LinearRec709, ///< without a transfer function. Of a window: scRGB, whose 1 is 80 cd/m^2
    DisplayP3,    ///< the primaries of P3 and D65 with the transfer function of sRGB
    Rec2020Pq,    ///< ITU-R BT.2100: the primaries of Rec. 2020, SMPTE ST 2084; whiteNits. Of a window: HDR10
};
template <>
struct EnumNames<OutputSpace> {
    static constexpr std::array<std::string_view, 4> values{ "srgb", "linearRec709", "displayP3", "rec2020Pq" };
};

} // namespace filament_core
