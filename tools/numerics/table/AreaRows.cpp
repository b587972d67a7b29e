// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kOverflow = "squared metres overflow 16 bits at 256 m";

Row areaRow(std::string_view function, Call call, std::array<Argument, 4> s, Interval range) {
    return { .file = "ltc", .function = function, .call = call, .s = s, .range = range, .fp32Only = kOverflow };
}

Row withVectors(Row row, Argument u, Argument v) {
    row.u = u;
    row.v = v;
    return row;
}

Row limited(Row row, Limits limits, std::string_view openOutside = {}) {
    row.limits = limits;
    row.openOutside = openOutside;
    return row;
}

Row withoutError(Row row, std::string_view why) {
    row.noError = why;
    return row;
}

std::vector<Row> edgeRows() {
    const Argument first = direction("u"), second = direction("v");
    const Interval angle{ -3.1448, 3.1448 };
    const std::string_view kJump = "jumps by pi where the polygon's plane passes through the point, or its rim does";
    const Argument extent = number("extent", 0, 1);
    return {
        limited(areaRow("angleOverSine(float)", NUMERICS_CALL(angleOverSine(s.x)), { unit("x") }, { 0.9999, 1.5709 }),
                relative(1e-6, 0, "a polynomial in Horner's form")),
        withoutError(withVectors(areaRow("edgeIntegral(vec3, vec3)", NUMERICS_CALL(edgeIntegral(u, v)), {}, angle),
                                 first, second),
                     "opposite directions have no normal in common"),
        limited(withVectors(areaRow("horizonBetween(vec3, vec3)",
                                    NUMERICS_CALL(horizonBetween(vec3(u.x, u.y, s.x), vec3(v.x, v.y, -s.y))),
                                    { number("above", 1e-6, 1), number("below", 1e-6, 1) }, { -1.001, 1.001 }),
                            first, second),
                absolute(1e-6, 0, "absolute: the sum of two parts"), "both on one side of the horizon"),
        limited(withVectors(areaRow("pointIntegral(vec3, vec3, vec3, float)",
                                    NUMERICS_CALL(pointIntegral(u, v * s.x, cross(u, v) * s.x, s.y)),
                                    { extent, number("area", 1, 4) }, { -4.01, 4.01 }),
                            first, second),
                absolute(1e-5, 0, "absolute: products that cancel where the polygon is seen from its side")),
        withoutError(withVectors(areaRow("polygonIntegral(vec3, vec3, vec3, vec2, vec2, int)",
                                         NUMERICS_CALL(polygonIntegral(u, v * s.x, cross(u, v) * s.x, vec2(s.y, s.z),
                                                                       vec2(1 - s.w, s.w), int(4 * s.w))),
                                         { extent, number("corner.x", 0.5, 1), number("corner.y", 0.5, 1),
                                           number("turn.y", 1, 1) }, // as in areaIntegral(), where neither is constant
                                         { -6.29, 6.29 }),
                                 first, second),
                     kJump),
        withoutError(withVectors(areaRow("areaIntegral(vec3, vec3, vec3, bool)",
                                         NUMERICS_CALL(areaIntegral(u * s.y, v * s.x, cross(u, v) * s.x, s.z > s.x)),
                                         { number("extent", 0, 1e9), number("distance", 0, 1e9), unit("disc") },
                                         { -6.29, 6.29 }),
                                 first, second),
                     kJump),
    };
}

std::vector<Row> ltcRows() {
    const Argument terms{ .name = "terms", .kind = Kind::Colour, .low = 0.1, .high = 1.5 };
    return {
        limited(areaRow("ltcCoordinates(float, float)", NUMERICS_CALL(ltcCoordinates(s.x, s.y)),
                        { unit("nov"), number("perceptualRoughness", 0.045, 1) }, { 0, 31.00001 }),
                absolute(1e-5, 0, "absolute: up to 31 steps of the table")),
        limited(withVectors(areaRow("ltcTransformation(vec3, float, float)",
                                    NUMERICS_CALL(ltcTransformation(u, s.x, s.y)),
                                    { unit("nov"), number("alpha", 0.002025, 1) }, { -2.001, 3.001 }),
                            { .name = "entry", .kind = Kind::Colour, .low = -1, .high = 1 }, {}),
                absolute(1e-6, 0, "absolute: sums that cancel")),
        limited(withVectors(areaRow("ltcApply(vec3, vec3)", NUMERICS_CALL(ltcApply(u, v)), {}, { -3.001, 3.001 }),
                            terms, direction("v")),
                absolute(1e-6, 0, "absolute: sums that cancel")),
        limited(withVectors(areaRow("ltcLobe(vec3, vec3)", NUMERICS_CALL(ltcLobe(u + vec3(0.5, 0, 0.5), v)), {},
                                    { 0, 10000 }),
                            terms, direction("direction")),
                absolute(1e-4, 0, "the fourth power of a length that cancels at the peak"),
                "a transformation that flattens everything"),
    };
}

Row profileRow(std::string_view function, Call call, std::array<Argument, 4> s, Interval range) {
    return { .file = "profiles",
             .function = function,
             .call = call,
             .s = s,
             .range = range,
             .fp32Only = "half a degree of a turn takes more than 11 bits" };
}

std::vector<Row> profileRows() {
    return {
        limited(profileRow("arcTangentOfUnit(float)", NUMERICS_CALL(arcTangentOfUnit(s.x)), { unit("x") },
                           { 0, 0.785399 }),
                relative(1e-6, 0, "a polynomial in Horner's form")),
        limited(profileRow("angleFrom(float, float)", NUMERICS_CALL(angleFrom(s.x, s.y)),
                           { number("along", -1, 1), number("across", 1e-6, 1) }, { 0, 3.141594 }),
                absolute(1e-6, 0, "absolute: pi less an angle")),
        withoutError(
                withVectors(profileRow("profilePlace(vec3, float, float)", NUMERICS_CALL(profilePlace(u, s.x, s.y)),
                                       { number("rowsPerRadian", 1, 114), number("columns", 1, 144) }, { 0, 358.2 }),
                            direction("direction"), {}),
                "jumps by a turn at y = 0"),
    };
}

Row shadowRow(std::string_view function, Call call, std::array<Argument, 4> s, Interval range) {
    return { .file = "area_shadows",
             .function = function,
             .call = call,
             .s = s,
             .range = range,
             .fp32Only = "16 bits cannot count the texels of a map" };
}

std::vector<Row> shadowRows() {
    const Argument along = direction("direction");
    const std::string_view kJump = "jumps from face to face";
    return {
        withoutError(
                withVectors(shadowRow("cubeFace(vec3)", NUMERICS_CALL(float(cubeFace(u))), {}, { 0, 5 }), along, {}),
                kJump),
        withoutError(withVectors(shadowRow("inCubeFace(vec3, int)", NUMERICS_CALL(inCubeFace(u, cubeFace(u))), {},
                                           { -1.001, 1.001 }),
                                 along, {}),
                     kJump),
        withoutError(withVectors(shadowRow("fromCubeFace(vec3, int)", NUMERICS_CALL(fromCubeFace(u, cubeFace(u))), {},
                                           { -1.001, 1.001 }),
                                 along, {}),
                     kJump),
        limited(withVectors(shadowRow("hiddenPoint(vec3, vec3, float)", NUMERICS_CALL(hiddenPoint(v + v, u, s.x)),
                                      { number("fraction", 0, 0.9) }, { -32.1, 32.1 }),
                            direction("occluder"), direction("point")),
                absolute(2e-5, 0, "absolute: a difference up to 30 times its terms")),
    };
}

} // namespace

std::vector<Row> areaRows() {
    std::vector<Row> rows = edgeRows();
    for (Row const& row : ltcRows()) rows.push_back(row);
    for (Row const& row : profileRows()) rows.push_back(row);
    for (Row const& row : shadowRows()) rows.push_back(row);
    rows.push_back({ .file = "light",
                     .function = "rangeWindow(vec3, float)",
                     .call = NUMERICS_CALL(rangeWindow(u, s.x)),
                     .s = { number("inverseSquaredRange", 0, 1e8) },
                     .u = { .name = "toLight", .kind = Kind::Offset, .low = 0, .high = 1e9 },
                     .range = { 0, 1 },
                     .monotone = Monotone::Falling,
                     .limits = absolute(1e-6, 0, "absolute: cancels at the range"),
                     .fp32Only = kOverflow });
    return rows;
}

} // namespace filament_core::shader::numerics
