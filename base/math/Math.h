// SPDX-License-Identifier: Apache-2.0
/// The public math aliases plus the GLM functions that the engine uses: dot, cross, normalize, inverse, ...
#pragma once

#include <filament_core/Math.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <numbers>

namespace filament_core {

inline constexpr float kPi = std::numbers::pi_v<float>;

} // namespace filament_core
