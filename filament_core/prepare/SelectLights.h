// SPDX-License-Identifier: Apache-2.0
/// Which lights a view shades with: the brightest sun, and the punctual lights whose range reaches into the frustum.
///   Limits  kMaxPunctualLights; of more, the brightest at the camera are kept (ties by order in the scene).
#pragma once

#include "filament_core/base/Arena.h"
#include "filament_core/prepare/ViewConstants.h"

#include <span>

namespace filament::prepare {

/// Writes the sun and the light count into `frame`; returns the punctual lights.
std::span<const shader::LightData> selectLights(Arena& arena, scene::Lights const& lights, ViewSpace const& space,
                                                shader::FrameUniforms& frame, PacketCounts& counts);

} // namespace filament::prepare
