// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

/// One axis of tangentFrame().
Row frameRow(std::string_view part, Call call) {
    return { .file = "tangent",
             .function = "tangentFrame(vec4, OUT(vec3), OUT(vec3), OUT(vec3))",
             .part = part,
             .call = call,
             .s = { Argument{ .name = "q", .kind = Kind::Rotation, .low = -1, .high = 1 } },
             .range = { -1.005, 1.005 },
             .limits = absolute(1e-6, 1e-2, "a unit vector: the error is relative to its length") };
}

/// Weights of what a ray of the image hits.
Row pictureRow(std::string_view function, Call call, std::array<Argument, 4> arguments, Monotone monotone,
               double highest, Limits const& limits) {
    return { .file = "reflection",
             .function = function,
             .call = call,
             .s = arguments,
             .range = { 0, highest },
             .monotone = monotone,
             .limits = limits,
             .fp32Only = "rays of the picture are in 32 bits" };
}

std::vector<Row> pictureRows() {
    const Limits step = absolute(2e-6, 0, "a cubic of a rounded quotient");
    return {
        pictureRow("smoothUnit(float)", NUMERICS_CALL(smoothUnit(s.x)), { unit("x") }, Monotone::Rising, 1.0000002,
                   absolute(4e-7, 0, "a cubic")),
        pictureRow("insideWeight(vec2, float)", NUMERICS_CALL(insideWeight(vec2(s.x, s.y), s.z)),
                   { unit("uv.x"), unit("uv.y"), number("border", 0.001, 0.5) }, Monotone::No, 1.0000004,
                   absolute(3e-4, 0, "the distance to the border cancels: rounding over its width")),
        pictureRow("awayWeight(float)", NUMERICS_CALL(awayWeight(s.x)), { number("cosine", -1, 1) }, Monotone::Falling,
                   1, step),
        pictureRow("reachWeight(float)", NUMERICS_CALL(reachWeight(s.x)), { unit("share") }, Monotone::Falling,
                   1.0000002, step),
        pictureRow("lobeRadius(float)", NUMERICS_CALL(lobeRadius(s.x)), { unit("alpha") }, Monotone::Rising, 1,
                   relative(1e-6, 0, "1 - alpha^2 does not cancel before the limit")),
        pictureRow("blurLevel(float)", NUMERICS_CALL(blurLevel(s.x)), { number("radius", 0, 1e6) }, Monotone::Rising,
                   20.5, absolute(3e-6, 0, "absolute: a logarithm of at most 20")),
    };
}

/// A direction from directionFromAngles().
Row sampleRow(std::string_view function, Call call, std::array<Argument, 4> arguments) {
    return { .file = "sampling",
             .function = function,
             .call = call,
             .s = arguments,
             .range = { -1.001, 1.001 },
             .limits = absolute(1e-6, 1e-2, "absolute: roots, and the sine and cosine of 2 pi u"),
             .openOutside = "the root of 1 - u.y for u.y above 1" };
}

std::vector<Row> lightRows() {
    const std::string_view kSquaredMetres =
            "squared metres overflow 16 bits at 256 m, and world positions are not half in any case";
    return {
        { .file = "light",
          .function = "distanceAttenuation(vec3, float)",
          .part = "without a range",
          .call = NUMERICS_CALL(distanceAttenuation(u, s.x)),
          .u = { .name = "toLight", .kind = Kind::Offset, .low = 0, .high = 1e9 },
          .range = { 0, 10001 },
          .limits = relative(4e-7, 0, "a sum of squares and a division"),
          .fp32Only = kSquaredMetres },
        { .file = "light",
          .function = "distanceAttenuation(vec3, float)",
          .part = "times distance squared",
          .call = NUMERICS_CALL(distanceAttenuation(u, s.x) * dot(u, u)),
          .s = { number("inverseSquaredRange", 0, 1e8) },
          .u = { .name = "toLight", .kind = Kind::Offset, .low = 0, .high = 1e9 },
          .range = { 0, 1.000001 },
          .monotone = Monotone::Falling,
          .limits =
                  absolute(1e-6, 0, "the window cancels at the range: the error is relative to the light without one"),
          .fp32Only = kSquaredMetres },
        { .file = "light",
          .function = "spotAttenuation(vec3, vec3, float, float)",
          .call = NUMERICS_CALL(spotAttenuation(u, v, s.x, s.y)),
          .s = { inHalf(number("scale", 1, 1e4), 1, 16), inHalf(number("offset", -1e4, 0), -16, 0) },
          .u = direction("lightDirection"),
          .v = direction("spotDirection"),
          .range = { 0, 1 },
          .limits = absolute(3e-3, 3e-2, "absolute: scale, up to 10^4 here, times the rounding of the cosine") },
    };
}

std::vector<Row> sequenceRows() {
    const std::string_view kIntegers = "indices and 2^-24 steps need 24 bits";
    return {
        { .file = "sampling",
          .function = "radicalInverse(uint)",
          .call = NUMERICS_CALL(radicalInverse(uint(s.x))),
          .s = { integer("i", 0, 4294967040.0) },
          .range = { 0, 0x1.fffffep-1 },
          .limits = relative(1e-7, 0, "the literal 2^-24 is rounded in its eighth digit"),
          .fp32Only = kIntegers },
        { .file = "sampling",
          .function = "hammersley(uint, float)",
          .call = NUMERICS_CALL(hammersley(uint(min(s.x, s.y - 1)), 1 / s.y)),
          .s = { integer("i", 0, 65535), integer("count", 1, 65536) },
          .range = { 0, 1 },
          .limits = relative(1e-6, 0, "a product and a rounding of the index"),
          .fp32Only = kIntegers },
    };
}

} // namespace

std::vector<Row> geometryRows() {
    std::vector<Row> rows = lightRows();
    const Argument alpha = unit("alpha");
    const std::vector<Row> more{
        sampleRow("directionFromAngles(float, float, float)", NUMERICS_CALL(directionFromAngles(s.x, s.y, s.z)),
                  { fraction("u"), number("cosTheta", -1, 1), number("sinTheta", 0, 1) }),
        sampleRow("importanceSampleGgx(vec2, float)", NUMERICS_CALL(importanceSampleGgx(vec2(s.x, s.y), s.z)),
                  { fraction("u.x"), fraction("u.y"), alpha }),
        sampleRow("hemisphereCosineSample(vec2)", NUMERICS_CALL(hemisphereCosineSample(vec2(s.x, s.y))),
                  { fraction("u.x"), fraction("u.y") }),
        sampleRow("hemisphereUniformSample(vec2)", NUMERICS_CALL(hemisphereUniformSample(vec2(s.x, s.y))),
                  { fraction("u.x"), fraction("u.y") }),
        frameRow("n", NUMERICS_CALL(tangentFrameNormal(s))),
        frameRow("t", NUMERICS_CALL(tangentFrameTangent(s))),
        frameRow("b", NUMERICS_CALL(tangentFrameBitangent(s))),
    };
    for (std::vector<Row> const& each : { sequenceRows(), more, pictureRows() })
        rows.insert(rows.end(), each.begin(), each.end());
    return rows;
}

} // namespace filament_core::shader::numerics
