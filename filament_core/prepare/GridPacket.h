// SPDX-License-Identifier: Apache-2.0
/// GridPacket: the irradiance grids of the main view, and the fields of the objects that they light.
///   Thread  plain values.   Memory: spans into the frame arena.
#pragma once

#include "shaders/interface/ShaderInterface.h"

#include <cstdint>
#include <span>

namespace filament_core::prepare {

struct GridPacket {
    std::span<const uint8_t> inView;                 ///< by scene::Grids::records: its box reaches into the view
    std::span<const shader::IrradianceField> fields; ///< DrawCall::firstField
    uint32_t used = 0, outOfReach = 0;               ///< grids
    float unit = 0;                 ///< from candela / m2 to what shaders multiply by FrameUniforms::ambient.x
    bool isEnvironmentDark = false; ///< it has 0 lux, so nothing of it may show beside the light of grids
    uint32_t evaluated = 0;         ///< fields that were not known from an earlier frame
    float largestError = 0; ///< of a field: root mean square of what it lacks at the points that it was fitted to, in
                            ///< shares of their mean

    bool empty() const { return fields.empty(); }
};

} // namespace filament_core::prepare
