// SPDX-License-Identifier: Apache-2.0
/// The public math aliases plus the GLM functions that the engine uses: dot, cross, normalize, inverse, ...
#pragma once

#include <filament/Math.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <numbers>

namespace filament {

inline constexpr float kPi = std::numbers::pi_v<float>;

} // namespace filament
