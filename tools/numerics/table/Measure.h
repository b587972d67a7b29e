// SPDX-License-Identifier: Apache-2.0
/// measure: compares what one evaluator made of a row's points with the truth.
///   In      results parallel to points.inside, and to points.outside; the truth is evaluated here.
///   Out     counts, the largest and the 99th percentile relative error, the first input of each kind of trouble.
///   Error   of one component: |result - truth| / max(|truth|, negligible); NaN and inf count as such, not as errors.
///   Thread  any. Memory: one vector of errors while it runs. Fails: never.
#pragma once

#include "tools/numerics/table/Points.h"

#include <optional>
#include <string>

namespace filament::shader::numerics {

/// Who evaluates. The truth is not among them: it is what they are measured against.
enum class Column : uint8_t { Cpp, VulkanSingle, GlesSingle, VulkanHalf, GlesHalf };
inline constexpr std::array kColumns{ Column::Cpp, Column::VulkanSingle, Column::GlesSingle, Column::VulkanHalf,
                                      Column::GlesHalf };
std::string_view toString(Column column);
constexpr Format formatOf(Column column) { return column >= Column::VulkanHalf ? Format::Half : Format::Single; }

using Results = std::vector<glm::vec4>;

/// How often a result of inputs outside of the intervals was what.
struct OutsideCount {
    uint32_t number = 0, infinite = 0, nan = 0;
};

struct Measurement {
    uint32_t inputs = 0;
    double worst = 0, percentile99 = 0;
    bool isJudged = true; ///< false: the device need not round as IEEE 754 says, so errors and order are only reported
    uint32_t nan = 0, infinite = 0, outOfRange = 0, notMonotone = 0;
    std::optional<Point> worstAt, firstNotFinite, firstOutOfRange, firstNotMonotone;
    double worstResult = 0, worstTruth = 0;
    std::array<OutsideCount, kOutsideInputs> outside{}; ///< by OutsideInput
    std::optional<Point> firstOutsideNotFinite;         ///< among the finite inputs
};

Measurement measure(Row const& row, Column column, Points const& points, Results const& inside, Results const& outside);

/// The column's own share of the row's limits.
double limitOf(Row const& row, Column column);
/// "s 0.5 1e-07, u 0 0 1": the arguments that the row uses.
std::string describe(Row const& row, Point const& point);

/// The C++ column.
Results evaluateCpp(Row const& row, std::vector<Point> const& points);

} // namespace filament::shader::numerics
