// SPDX-License-Identifier: Apache-2.0
/// gridOf, beyondOf: the values of one argument inside its interval, and values outside it.
///   Memory  vectors of at most about 80 values. Thread: any. Fails: never.
#pragma once

#include "tools/numerics/table/Points.h"

namespace filament_core::shader::numerics {

struct Grid {
    std::vector<glm::vec4> values; ///< numbers in x, vectors in xyz, quaternions in all four
    uint32_t orderedCount = 0;     ///< the first so many values are ascending numbers or greys
};

/// `divisions`: additional even subdivisions of the interval, and of its first unit.
Grid gridOf(Argument const& argument, Format format, uint32_t divisions);

struct Beyond {
    glm::vec4 value{};
    OutsideInput input{};
};

std::vector<Beyond> beyondOf(Argument const& argument, Format format);

} // namespace filament_core::shader::numerics
