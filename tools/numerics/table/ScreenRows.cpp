// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"
#include "tools/numerics/table/Row.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kLegs = "absolute: the root of 1 - x^2 has half of the digits next to 1";

std::vector<Row> planeRows() {
    const std::string_view kSmall = "1 / distance may be below the least 16-bit number";
    return {
        { .file = "screen_occlusion",
          .function = "missOfLine(float, float, float)",
          .call = NUMERICS_CALL(missOfLine(s.x, s.y, s.z)),
          .s = { number("here", 0, 1e6), number("inward", 0, 1e6), number("outward", 0, 1e6) },
          .range = { 0, 4e6 },
          .noError = "on a plane it is the rounding of its arguments",
          .fp32Only = kSmall },
        { .file = "screen_occlusion",
          .function = "normalOfPlane(vec2, vec2, float)",
          .call = NUMERICS_CALL(normalOfPlane(vec2(s.x, s.y), vec2(u.x, u.y), s.z)),
          .s = { number("slope.x", -1, 1), number("slope.y", -1, 1), number("inverse", 0, 1) },
          .u = colour("ray", 2),
          .range = { -1.000001, 1.000001 },
          .limits = absolute(4e-6, 0, "absolute: a sum of three products, over its largest component"),
          .fp32Only = kSmall },
        { .file = "screen_occlusion",
          .function = "weightOfNeighbor(float, float, float)",
          .call = NUMERICS_CALL(weightOfNeighbor(s.x, s.y, s.z)),
          .s = { number("inverse", 0, 10), number("expected", 0, 10), number("tolerance", 1e-3, 10) },
          .range = { 0, 1 },
          .limits = absolute(1e-3, 0, "absolute: a difference over the tolerance"),
          .fp32Only = kSmall,
          .openOutside = "a division by 0" },
    };
}

std::vector<Row> hiddenRows() {
    return {
        { .file = "screen_occlusion",
          .function = "hiddenBySample(vec3, float)",
          .call = NUMERICS_CALL(hiddenBySample(u, s.x)),
          .s = { number("height", -1, 1) },
          .u = { .name = "offset", .kind = Kind::Offset, .low = 1e-2, .high = 4, .halfLow = 3e-2, .halfHigh = 4 },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(4e-6, 2e-2, "absolute: a square, a quotient and a square from 1") },
        { .file = "screen_occlusion",
          .function = "directionOfWedge(float)",
          .call = NUMERICS_CALL(directionOfWedge(s.x)),
          .s = { unit("sine") },
          .range = { 0, 1.501 },
          .limits = absolute(5e-4, 5e-2, kLegs) },
        { .file = "screen_occlusion",
          .function = "encodeLean(vec3)",
          .call = NUMERICS_CALL(encodeLean(u)),
          .u = { .name = "lean", .kind = Kind::Colour, .low = -1, .high = 1, .halfLow = -1, .halfHigh = 1 },
          .range = { 0, 1.001 },
          .limits = absolute(5e-7, 2e-3, "absolute: a sum of up to 255, of 1") },
        { .file = "screen_occlusion",
          .function = "decodeLean(vec3)",
          .call = NUMERICS_CALL(decodeLean(u)),
          .u = colour("texel", 1),
          .range = { -1.01, 1.01 },
          .limits = absolute(5e-7, 4e-3, "absolute: a difference of up to 128, of 127") },
    };
}

std::vector<Row> arcRows() {
    return {
        { .file = "screen_occlusion",
          .function = "arcCosine(float)",
          .call = NUMERICS_CALL(arcCosine(s.x)),
          .s = { number("x", -1, 1) },
          .range = { 0, 3.142 },
          .limits = { .cpp = 1e-6,
                      .gpu = 1e-4,
                      .half = 5e-3,
                      .negligible = 1,
                      .why = "absolute: a root and four sums; devices take the denormal numbers beside 0 for 0, and "
                             "the two halves of the fit meet there within 1.4e-4" } },
        { .file = "screen_occlusion",
          .function = "openOfHalfSlice(float, vec2)",
          .call = NUMERICS_CALL(openOfHalfSlice(s.x, vec2(s.y, s.z))),
          .s = { number("cosine", -1, 1), number("normal.x", -1, 1), number("normal.y", -1, 1) },
          .range = { -2.1, 2.1 },
          .limits = absolute(5e-4, 5e-2, kLegs) },
        { .file = "screen_occlusion",
          .function = "directionOfHalfSlice(float, vec2)",
          .call = NUMERICS_CALL(directionOfHalfSlice(s.x, vec2(s.y, s.z))),
          .s = { number("cosine", -1, 1), number("normal.x", -1, 1), number("normal.y", -1, 1) },
          .range = { -2, 2 },
          .limits = absolute(1e-6, 1e-2, "absolute: three products and their sum") },
    };
}

} // namespace

std::vector<Row> screenRows() {
    std::vector<Row> rows = planeRows();
    for (std::vector<Row> const& more : { hiddenRows(), arcRows() }) rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace filament_core::shader::numerics
