// SPDX-License-Identifier: Apache-2.0
/// Photometric units as types, so that a lux value cannot be used as candelas by accident.
///   Each is a named float: there are no implicit conversions and no arithmetic between units. Photometry.h converts.
#pragma once

namespace filament_core {

struct Lux {
    float value = 0;
}; ///< illuminance, lm/m^2: suns, environments
struct Lumen {
    float value = 0;
}; ///< luminous power: bulbs
struct Candela {
    float value = 0;
}; ///< luminous intensity, lm/sr: spots
struct Nits {
    float value = 0;
}; ///< luminance, cd/m^2: emissive surfaces, skies
struct Watt {
    float value = 0;
}; ///< electrical power: what a lamp draws
struct LumensPerWatt {
    float value = 0;
}; ///< luminous efficacy: how much light a lamp makes of it

} // namespace filament_core
