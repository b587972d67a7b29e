// SPDX-License-Identifier: Apache-2.0
/// EnvironmentFormat: how the light of an environment is stored.
#pragma once

#include <filament_core/EnumNames.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace filament_core {

enum class EnvironmentFormat : uint8_t {
    Rgba16F,    ///< half floats: 8 bytes a texel
    R11G11B10F, ///< 4 bytes: 6 bits of mantissa for red and green, 5 for blue
    Rgb9E5,     ///< 4 bytes: 9 bits of mantissa and a common exponent
    Rgbm,       ///< 4 bytes in RGBA8: 8 bits times a common factor
};
template <>
struct EnumNames<EnvironmentFormat> {
    static constexpr std::array<std::string_view, 4> values{ "RGBA16F", "R11G11B10F", "RGB9E5", "RGBM" };
};

} // namespace filament_core
