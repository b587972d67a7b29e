// SPDX-License-Identifier: Apache-2.0
/// pointsOf: the points at which a row is evaluated.
///   Inside  lines: the first argument goes through its whole grid in order while the others are fixed, so one list
///           serves both errors and monotonicity. Grids are dense at the ends of the interval, at 0 and at 1, with
///           denormals, one ulp, and one value per decade in between. For the other arguments: every combination of
///           their grids, or, if these are more than kMaxLines, all corners and a deterministic selection.
///   Outside values beyond each interval, the largest value of the format, both infinities and NaN, for one argument at
///   a time.
///   Half    every value is exact in 16 bits, so that the reference sees the same inputs.
///   Thread  any. Memory: at most kMaxLines * about 60 points of 44 B. Fails: never.
#pragma once

#include "tools/numerics/table/Row.h"

namespace filament_core::shader::numerics {

inline constexpr uint32_t kMaxLines = 96;

enum class Format : uint8_t { Single, Half };

enum class OutsideInput : uint8_t { Beyond, Huge, Infinite, NaN };
inline constexpr size_t kOutsideInputs = 4;

struct Point {
    glm::vec4 s{ 0.0f };
    glm::vec3 u{ 0.0f }, v{ 0.0f };
};

struct Points {
    std::vector<Point> inside;
    uint32_t lineLength = 0;    ///< inside[i * lineLength ..] is one line
    uint32_t orderedLength = 0; ///< the first so many points of each line are ordered by the first argument
    std::vector<Point> outside;
    std::vector<OutsideInput> outsideInputs; ///< parallel to `outside`
};

Points pointsOf(Row const& row, Format format);

/// The nearest 16-bit value; a value out of range becomes infinite.
float halfRounded(float value);

} // namespace filament_core::shader::numerics
