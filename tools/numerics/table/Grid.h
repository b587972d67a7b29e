// SPDX-License-Identifier: Apache-2.0
/// gridOf, beyondOf: the values of one argument inside of its interval, and those that it must not have.
///   Memory  vectors of at most about 80 values. Thread: any. Fails: never.
#pragma once

#include "tools/numerics/table/Points.h"

namespace filament::shader::numerics {

struct Grid {
    std::vector<glm::vec4> values; ///< numbers in x, vectors in xyz, quaternions in all four
    uint32_t orderedCount = 0;     ///< so many from the front are rising numbers, or rising greys
};

/// `divisions`: into how many even parts the interval, and its first unit, are cut besides.
Grid gridOf(Argument const& argument, Format format, uint32_t divisions);

struct Beyond {
    glm::vec4 value{};
    OutsideInput input{};
};

std::vector<Beyond> beyondOf(Argument const& argument, Format format);

} // namespace filament::shader::numerics
