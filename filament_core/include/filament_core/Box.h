// SPDX-License-Identifier: Apache-2.0
/// Box: an axis-aligned box in double precision. A plain value.
#pragma once

#include <filament_core/Math.h>

#include <glm/common.hpp>

namespace filament_core {

/// Empty when min > max.
struct Box {
    double3 min{ 1e300 }, max{ -1e300 };
    bool empty() const { return min.x > max.x; }
    double3 center() const { return (min + max) * 0.5; } ///< of one that is not empty
    void add(Box const& other) { min = glm::min(min, other.min), max = glm::max(max, other.max); }
};

/// The transform that moves the box's centre to the origin and scales its largest dimension to 1. An empty box gives
/// the identity; a box without extent is not scaled.
inline double4x4 fitToUnitCube(Box const& box) {
    if (box.empty()) return double4x4(1.0);
    const double3 size = box.max - box.min, center = box.center();
    const double largest = size.x > size.y ? (size.x > size.z ? size.x : size.z) : (size.y > size.z ? size.y : size.z);
    const double scale = largest > 0 ? 1 / largest : 1;
    double4x4 fit(scale);
    fit[3] = double4(-center * scale, 1);
    return fit;
}

} // namespace filament_core
