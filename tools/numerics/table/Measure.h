// SPDX-License-Identifier: Apache-2.0
/// measure: compares the results of one evaluator at a row's points with the reference evaluation.
///   In      results parallel to points.inside and points.outside; the reference is evaluated here.
///   Out     counts, the largest and the 99th percentile relative error, and the first input of each kind of failure.
///   Error   of one component: |result - truth| / max(|truth|, negligible); NaN and inf are counted separately.
///   Thread  any. Memory: one vector of errors while it runs. Fails: never.
#pragma once

#include "tools/numerics/table/Points.h"

#include <optional>
#include <string>

namespace filament_core::shader::numerics {

/// The evaluators. The reference is not among them: they are compared with it.
enum class Column : uint8_t { Cpp, VulkanSingle, GlesSingle, VulkanHalf, GlesHalf };
inline constexpr std::array kColumns{ Column::Cpp, Column::VulkanSingle, Column::GlesSingle, Column::VulkanHalf,
                                      Column::GlesHalf };
std::string_view toString(Column column);
constexpr Format formatOf(Column column) { return column >= Column::VulkanHalf ? Format::Half : Format::Single; }

using Results = std::vector<glm::vec4>;

/// Number of results of each kind for inputs outside the intervals.
struct OutsideCount {
    uint32_t number = 0, infinite = 0, nan = 0;
};

struct Measurement {
    uint32_t inputs = 0;
    double worst = 0, percentile99 = 0;
    bool isJudged = true; ///< false: the device need not round as in IEEE 754, so errors and order are only reported
    uint32_t nan = 0, infinite = 0, outOfRange = 0, notMonotone = 0;
    std::optional<Point> worstAt, firstNotFinite, firstOutOfRange, firstNotMonotone;
    double worstResult = 0, worstTruth = 0;
    std::array<OutsideCount, kOutsideInputs> outside{}; ///< by OutsideInput
    std::optional<Point> firstOutsideNotFinite;         ///< only for finite inputs
};

Measurement measure(Row const& row, Column column, Points const& points, Results const& inside, Results const& outside);

/// The limit of the row that applies to this column.
double limitOf(Row const& row, Column column);
/// "s 0.5 1e-07, u 0 0 1": the arguments used by the row.
std::string describe(Row const& row, Point const& point);

/// The C++ column.
Results evaluateCpp(Row const& row, std::vector<Point> const& points);

} // namespace filament_core::shader::numerics
