// SPDX-License-Identifier: Apache-2.0
/// Box: an axis-aligned box in double precision. A plain value.
#pragma once

#include <filament/Math.h>

namespace filament {

/// Empty when min > max.
struct Box {
    double3 min{ 1e300 }, max{ -1e300 };
    bool empty() const { return min.x > max.x; }
};

} // namespace filament
