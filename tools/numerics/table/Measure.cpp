// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace filament_core::shader::numerics {
namespace {

Packed truthAt(Row const& row, Point const& point) {
    return row.call.truth(glm::dvec4(point.s), glm::dvec3(point.u), glm::dvec3(point.v));
}

void remember(std::optional<Point>& first, Point const& point) {
    if (!first) first = point;
}

/// Compares one result with the truth, and appends the errors of its components.
void compare(Row const& row, Column column, Point const& point, glm::vec4 result, Measurement& sum,
             std::vector<double>& errors) {
    const Packed truth = truthAt(row, point);
    const bool half = formatOf(column) == Format::Half;
    const double negligible = half ? row.limits.halfNegligible : row.limits.negligible;
    for (uint32_t i = 0; i < truth.count; ++i) {
        const double value = result[i], expected = truth.value[i];
        sum.nan += std::isnan(value);
        sum.infinite += std::isinf(value);
        if (!std::isfinite(value)) {
            remember(sum.firstNotFinite, point);
            continue;
        }
        if (value < row.range.low || value > row.range.high) {
            ++sum.outOfRange;
            remember(sum.firstOutOfRange, point);
        }
        if (half && std::abs(expected) > row.limits.halfLargest) continue;
        errors.push_back(std::abs(value - expected) / std::max(std::abs(expected), negligible));
        if (errors.back() <= sum.worst) continue;
        sum.worst = errors.back();
        sum.worstAt = point;
        sum.worstResult = value;
        sum.worstTruth = expected;
    }
}

/// A step in the wrong direction counts if it exceeds the error that the row allows.
void checkOrder(Row const& row, Column column, Points const& points, Results const& results, Measurement& sum) {
    if (row.monotone == Monotone::No) return;
    const double sign = row.monotone == Monotone::Rising ? 1 : -1;
    const bool half = formatOf(column) == Format::Half;
    for (size_t i = 0; i + 1 < results.size(); ++i) {
        if (i % points.lineLength + 1 >= points.orderedLength) continue;
        const uint32_t count = truthAt(row, points.inside[i]).count;
        for (uint32_t c = 0; c < count; ++c) {
            const double before = results[i][c], after = results[i + 1][c];
            const double size = std::max(
                    { std::abs(before), std::abs(after), half ? row.limits.halfNegligible : row.limits.negligible });
            if (!((before - after) * sign > limitOf(row, column) * size)) continue;
            ++sum.notMonotone;
            remember(sum.firstNotMonotone, points.inside[i]);
        }
    }
}

void countOutside(Row const& row, Points const& points, Results const& results, Measurement& sum) {
    bool beyond = false; // the first input is slightly outside; more telling than a huge one
    for (size_t i = 0; i < results.size(); ++i) {
        OutsideCount& count = sum.outside[static_cast<size_t>(points.outsideInputs[i])];
        bool nan = false, infinite = false;
        for (uint32_t c = 0; c < truthAt(row, points.outside[i]).count; ++c) {
            nan |= std::isnan(results[i][c]);
            infinite |= std::isinf(results[i][c]);
        }
        ++(nan ? count.nan : infinite ? count.infinite : count.number);
        const OutsideInput input = points.outsideInputs[i];
        if (!(nan || infinite) || input > OutsideInput::Huge) continue;
        if (!beyond && input == OutsideInput::Beyond) sum.firstOutsideNotFinite.reset();
        beyond |= input == OutsideInput::Beyond;
        remember(sum.firstOutsideNotFinite, points.outside[i]);
    }
}

double percentile99(std::vector<double>& errors) {
    if (errors.empty()) return 0;
    const auto at = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
    std::nth_element(errors.begin(), at, errors.end());
    return *at;
}

} // namespace

std::string_view toString(Column column) {
    constexpr std::array<std::string_view, kColumns.size()> kNames{ "C++ fp32", "Vulkan fp32", "GLES highp",
                                                                    "Vulkan fp16", "GLES mediump" };
    return kNames[static_cast<size_t>(column)];
}

double limitOf(Row const& row, Column column) {
    if (column == Column::Cpp) return row.limits.cpp;
    return formatOf(column) == Format::Half ? row.limits.half : row.limits.gpu;
}

Measurement measure(Row const& row, Column column, Points const& points, Results const& inside,
                    Results const& outside) {
    Measurement sum{ .inputs = static_cast<uint32_t>(inside.size()) };
    std::vector<double> errors;
    for (size_t i = 0; i < inside.size(); ++i) compare(row, column, points.inside[i], inside[i], sum, errors);
    sum.percentile99 = percentile99(errors);
    checkOrder(row, column, points, inside, sum);
    countOutside(row, points, outside, sum);
    return sum;
}

std::string describe(Row const& row, Point const& point) {
    std::string text;
    for (size_t i = 0; i < row.s.size(); ++i) {
        const bool rotation = row.s[0].kind == Kind::Rotation;
        if (rotation || isUsed(row.s[i]))
            text += fmt::format("{}{} {:.9g}", text.empty() ? "" : ", ", row.s[rotation ? 0 : i].name, point.s[int(i)]);
    }
    for (auto const& [argument, value] : { std::pair(&row.u, point.u), std::pair(&row.v, point.v) }) {
        if (isUsed(*argument))
            text += fmt::format("{}{} ({:.9g} {:.9g} {:.9g})", text.empty() ? "" : ", ", argument->name, value.x,
                                value.y, value.z);
    }
    return text;
}

Results evaluateCpp(Row const& row, std::vector<Point> const& points) {
    Results results;
    results.reserve(points.size());
    for (Point const& point : points) results.emplace_back(row.call.single(point.s, point.u, point.v).value);
    return results;
}

} // namespace filament_core::shader::numerics
