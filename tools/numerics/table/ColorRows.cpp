// SPDX-License-Identifier: Apache-2.0
// Size: colorRows() is a table with one row per function.
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kTransfer =
        "pow() of an exponent above 1/3: the error of log2 and exp2, the constants rounded";
constexpr std::string_view kCurve = "two polynomials, each cancels near its own zero, and a division";
constexpr std::string_view kSceneReferred = "squares of scene-referred values overflow 16 bits";

/// toneMap() with one of its mappers.
Row toneMapRow(std::string_view part, Call call) {
    return { .file = "color",
             .function = "toneMap(vec3, int)",
             .part = part,
             .call = call,
             .u = { .name = "color", .kind = Kind::Colour, .low = -3e38, .high = 3e38 },
             .range = { 0, 1 },
             .monotone = Monotone::Rising,
             .limits = { .cpp = 1e-6, .gpu = 1e-6, .negligible = 1e-2, .why = kCurve },
             .fp32Only = kSceneReferred };
}

std::vector<Row> groundRows() {
    return { { .file = "ground",
               .function = "directionOverGround(vec3, vec3, float, float)",
               .call = NUMERICS_CALL(directionOverGround(v * s.x, u, s.y, s.z)),
               .s = { number("away", 1e-3, 1e3), number("height", 0.1, 10), number("radius", 11, 1e4) },
               .u = direction("direction"),
               .v = direction("from"),
               .range = { -2e4, 2e4 },
               .noError = "where a ray is level with the ground, its point is any distance away",
               .fp32Only = "squares of metres exceed 16 bits" } };
}

std::vector<Row> fogRows() {
    constexpr std::string_view kMeters = "metres and optical depths exceed 16 bits";
    constexpr std::string_view kLattice = "16 bits cannot count cells";
    return {
        { .file = "fog",
          .function = "fogOpticalDepth(float, float, float, float, float)",
          .part = "near",
          .call = NUMERICS_CALL(fogOpticalDepth(s.w, s.y, s.z, 0.0f, s.x)),
          .s = { number("to", 0, 100), number("falloff", 0, 1), number("rise", -1, 1), number("logDensity", -10, 3) },
          .range = { 0, 3e37 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 2e-5, .gpu = 2e-5, .negligible = 1e-6, .why = "an exponent up to 100 is rounded" },
          .fp32Only = kMeters },
        { .file = "fog",
          .function = "fogOpticalDepth(float, float, float, float, float)",
          .part = "far",
          .call = NUMERICS_CALL(fogOpticalDepth(s.w, s.y, s.z, 1.0f, s.x)),
          .s = { number("to", 0, 1e15), number("falloff", 0, 1e3), number("rise", -1, 1),
                 number("logDensity", -1e20, 80) },
          .range = { 0, 3e37 },
          .noError = "the rounding of an exponent of millions",
          .fp32Only = kMeters },
        { .file = "fog",
          .function = "fogOpacity(float, float)",
          .call = NUMERICS_CALL(fogOpacity(s.x, s.y)),
          .s = { number("opticalDepth", 0, 3e37), unit("largest") },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-6, 0, "oneMinusExp()"),
          .fp32Only = kMeters },
        { .file = "fog",
          .function = "fogGlow(float, float)",
          .call = NUMERICS_CALL(fogGlow(s.x, s.y)),
          .s = { number("cosine", -1, 1), number("exponent", 1, 1e3) },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(2e-4, 0, "absolute: a thousand times the rounding of a logarithm"),
          .fp32Only = "a thousand times the rounding of a logarithm" },
        { .file = "fog",
          .function = "henyeyGreenstein(float, float)",
          .call = NUMERICS_CALL(henyeyGreenstein(s.x, s.y)),
          .s = { number("cosine", -1, 1), number("asymmetry", -0.95, 0.95) },
          .range = { 0, 800 },
          .limits = relative(3e-4, 0, "1 + g^2 - 2 g cos cancels where light goes straight on"),
          .fp32Only = kMeters },
        { .file = "fog",
          .function = "fogSliceAt(float, float, float)",
          .call = NUMERICS_CALL(fogSliceAt(s.x, s.y, s.z)),
          .s = { number("depth", 0, 1e15), number("slices", 8, 128), number("meters", 0.1, 1e5) },
          .range = { 0, 128 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 1e-6, .gpu = 1e-6, .negligible = 1e-3, .why = "a root; the first slice is one" },
          .fp32Only = kMeters },
        { .file = "fog",
          .function = "fogDepthOf(float, float, float)",
          .call = NUMERICS_CALL(fogDepthOf(s.x, s.y, s.z)),
          .s = { number("slice", 0, 128), number("slices", 8, 128), number("meters", 0.1, 1e5) },
          .range = { 0, 3e7 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-6, 0, "products"),
          .fp32Only = kMeters },
        { .file = "fog_noise",
          .function = "hashBits(uint)",
          .call = NUMERICS_CALL(float(hashBits(uint(s.x)) >> 8u)),
          .s = { integer("x", 0, 4294967040.0) },
          .range = { 0, 16777215 },
          .limits = absolute(0, 0, "integers"),
          .fp32Only = kLattice },
        { .file = "fog_noise",
          .function = "latticeNoise(vec3, uint, uint)",
          .call = NUMERICS_CALL(latticeNoise(u, uint(255), uint(s.x))),
          .s = { integer("seed", 0, 3) },
          .u = { .name = "place", .kind = Kind::Offset, .low = 0, .high = 256 },
          .range = { -1.000001, 1.000001 },
          .limits = absolute(1e-4, 0, "absolute: the rounding of the place within a cell, times the slope"),
          .fp32Only = kLattice },
        { .file = "fog_noise",
          .function = "fogNoise(vec3, float, float)",
          .call = NUMERICS_CALL(fogNoise(u, s.x, s.y)),
          .s = { number("octaves", 1, 4), number("width", 0, 2) },
          .u = { .name = "place", .kind = Kind::Offset, .low = 0, .high = 256 },
          .range = { -1.000001, 1.000001 },
          .limits = absolute(2e-4, 0, "absolute: as latticeNoise(), of octaves"),
          .fp32Only = kLattice },
    };
}

std::vector<Row> toneMapRows() {
    return {
        { .file = "color",
          .function = "toneMapAces(vec3)",
          .call = NUMERICS_CALL(toneMapAces(u)),
          .u = colour("x", 1e4),
          .range = { -0.1, 1.1 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 1e-6, .gpu = 1e-6, .negligible = 1e-2, .why = kCurve },
          .fp32Only = kSceneReferred },
        { .file = "color",
          .function = "toneMapFilmic(vec3)",
          .call = NUMERICS_CALL(toneMapFilmic(u)),
          .u = colour("x", 1e4),
          .range = { 0, 1.04 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-6, 0, kCurve),
          .fp32Only = kSceneReferred },
        { .file = "color",
          .function = "toneMapMobile(vec3)",
          .call = NUMERICS_CALL(toneMapMobile(u)),
          .u = { .name = "x", .kind = Kind::Colour, .low = 0, .high = 3e38, .halfHigh = 65504 },
          .range = { 0, 1.02 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-6, 1e-2, "a sum and a division"),
          .openOutside = "x = -0.155 divides by zero" },
        { .file = "color",
          .function = "toneMapIncludesTransfer(int)",
          .call = NUMERICS_CALL(toneMapIncludesTransfer(int(s.x))),
          .s = { integer("mapper", 0, 8) },
          .range = { 0, 1 },
          .limits = { .why = "exact" } },
        toneMapRow("linear", NUMERICS_CALL(toneMap(u, kToneMapLinear))),
        toneMapRow("ACES", NUMERICS_CALL(toneMap(u, kToneMapAces))),
        toneMapRow("filmic", NUMERICS_CALL(toneMap(u, kToneMapFilmic))),
        toneMapRow("mobile", NUMERICS_CALL(toneMap(u, kToneMapMobile))),
    };
}

std::vector<Row> toneTableRows() {
    constexpr std::string_view kFp32Only =
            "the logarithm of 16 stops leaves 16 bits no digits for the place between entries";
    return {
        { .file = "color",
          .function = "toneTableCoordinate(float)",
          .call = NUMERICS_CALL(toneTableCoordinate(s.x)),
          .s = { number("light", 0, 65504) },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 3e-7, .gpu = 3e-6, .negligible = 1, .why = "absolute: log2(), of at most 16, over 16" },
          .fp32Only = kFp32Only },
        { .file = "color",
          .function = "lightFromToneTableCoordinate(float)",
          .call = NUMERICS_CALL(lightFromToneTableCoordinate(s.x)),
          .s = { unit("coordinate") },
          .range = { 0, 256 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 1e-5,
                      .gpu = 1e-4,
                      .negligible = 0.00390625,
                      .why = "exp2() of a rounded product; below the offset relative to it" },
          .fp32Only = kFp32Only },
    };
}

/// A curve that increases from 0 over [0, 1], of a number or of each component of a colour.
Row curveRow(std::string_view function, Call call, Argument const& x, double highest, Limits const& limits,
             std::string_view fp32Only = {}) {
    Row row{ .file = "color",
             .function = function,
             .call = call,
             .range = { 0, highest },
             .monotone = Monotone::Rising,
             .limits = limits,
             .fp32Only = fp32Only };
    (x.kind == Kind::Colour ? row.u : row.s[0]) = x;
    return row;
}

std::vector<Row> transferRows() {
    const std::string_view kSteep = "the last step of 16 bits before 1 is half of the light";
    const Limits inverse{ .cpp = 2e-5,
                          .gpu = 5e-5,
                          .negligible = 1e-6,
                          .why = "the bright end is steep: ten times the roundings before it" };
    const Limits transfer = relative(1e-6, 1e-2, kTransfer);
    const Argument value = unit("x"), color = colour("x", 1);
    return {
        curveRow("inverseTonemap(float)", NUMERICS_CALL(inverseTonemap(s.x)), value, 7.3, inverse, kSteep),
        curveRow("inverseTonemap(vec3)", NUMERICS_CALL(inverseTonemap(u)), color, 7.3, inverse, kSteep),
        curveRow("inverseTonemapSRGB(vec3)", NUMERICS_CALL(inverseTonemapSRGB(u)), color, 7.3, inverse, kSteep),
        { .file = "color",
          .function = "ycbcrToRgb(float, vec2)",
          .call = NUMERICS_CALL(ycbcrToRgb(s.x, vec2(s.y, s.z))),
          .s = { unit("y"), unit("cb"), unit("cr") },
          .range = { -1, 2 },
          .monotone = Monotone::Rising,
          .limits = absolute(3e-7, 2e-3, "absolute: the differences to 1/2 cancel") },
        curveRow("srgbFromLinear(float)", NUMERICS_CALL(srgbFromLinear(s.x)), value, 1, transfer),
        curveRow("srgbFromLinear(vec3)", NUMERICS_CALL(srgbFromLinear(u)), color, 1, transfer),
        curveRow("linearFromSrgb(float)", NUMERICS_CALL(linearFromSrgb(s.x)), value, 1, transfer),
        curveRow("linearFromSrgb(vec3)", NUMERICS_CALL(linearFromSrgb(u)), color, 1, transfer),
    };
}

} // namespace

std::vector<Row> colorRows() {
    std::vector<Row> rows{
        { .file = "color",
          .function = "luminance(vec3)",
          .call = NUMERICS_CALL(luminance(u)),
          .u = { .name = "linear", .kind = Kind::Colour, .low = 0, .high = 3e38, .halfHigh = 65504 },
          .range = { 0, kInfinity },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 3e-7,
                      .gpu = 3e-7,
                      .half = 2e-3,
                      .halfNegligible = 1e-3,
                      .why = "a sum of three products" } },
        { .file = "noise",
          .function = "interleavedGradientNoise(vec2)",
          .call = NUMERICS_CALL(interleavedGradientNoise(vec2(s.x, s.y))),
          .s = { number("pixel.x", 0.5, 16384), number("pixel.y", 0.5, 16384) },
          .range = { 0, 0x1.fffffep-1 },
          .noError = "noise: 53 times the rounding of a sum up to 1200, which wraps",
          .fp32Only = "16 bits do not count the pixels of a line" },
        { .file = "noise",
          .function = "directionOfTurn(float)",
          .call = NUMERICS_CALL(directionOfTurn(s.x)),
          .s = { number("turn", 0, 1) },
          .range = { -1, 1 },
          .limits = absolute(5e-7, 5e-3, "four times the rounding of the turn, and a division") },
        { .file = "distance",
          .function = "distanceFromDepth(float, vec2, vec2)",
          .call = NUMERICS_CALL(distanceFromDepth(s.x, vec2(0.0f, s.y), vec2(-1.0f, 0.0f))),
          .s = { number("depth", 0, 1), number("near", 1e-6, 1e6) },
          .range = { 0, 1.0000001e30 }, // the float next to 1e30
          .monotone = Monotone::Falling,
          .limits = { .cpp = 2e-7, .gpu = 2e-7, .why = "a division" },
          .fp32Only = "depths far away are below the least 16-bit number" },
        { .file = "moments",
          .function = "momentDepth(float, float)",
          .call = NUMERICS_CALL(momentDepth(s.x, s.y)),
          .s = { number("depth", 0, 1), number("nearOverFar", 1e-6, 1) },
          .range = { -1, 1 },
          .noError = "bounds of sums: squares of exponentials, and steps where a variance is that of rounding",
          .fp32Only = "squares of warped depths reach e^80",
          .openOutside = "depths lie in [-1, 1]: momentDepth() clamps them" },
        { .file = "moments",
          .function = "momentSlope(float, float)",
          .call = NUMERICS_CALL(momentSlope(s.x, s.y)),
          .s = { number("momentDepth", -1, 1), number("nearOverFar", 1e-3, 1) },
          .range = { 0, 2001 },
          .noError = "bounds of sums: squares of exponentials, and steps where a variance is that of rounding",
          .fp32Only = "squares of warped depths reach e^80",
          .openOutside = "depths lie in [-1, 1]: momentDepth() clamps them" },
        { .file = "moments",
          .function = "momentsOf(float)",
          .call = NUMERICS_CALL(momentsOf(s.x)),
          .s = { number("depth", -1, 1) },
          .range = { -1, 1 },
          .noError = "bounds of sums: squares of exponentials, and steps where a variance is that of rounding",
          .fp32Only = "squares of warped depths reach e^80",
          .openOutside = "depths lie in [-1, 1]: momentDepth() clamps them" },
        { .file = "moments",
          .function = "warpedDepth(float)",
          .call = NUMERICS_CALL(warpedDepth(s.x)),
          .s = { number("depth", -1, 1) },
          .range = { -150, 2.4e17 },
          .noError = "bounds of sums: squares of exponentials, and steps where a variance is that of rounding",
          .fp32Only = "squares of warped depths reach e^80",
          .openOutside = "depths lie in [-1, 1]: momentDepth() clamps them" },
        { .file = "moments",
          .function = "warpedMomentsOf(float)",
          .call = NUMERICS_CALL(vec3(warpedMomentsOf(s.x).x, warpedMomentsOf(s.x).y, warpedMomentsOf(s.x).w)),
          .s = { number("depth", -1, 1) },
          .range = { -150, 5.6e34 },
          .noError = "bounds of sums: squares of exponentials, and steps where a variance is that of rounding",
          .fp32Only = "squares of warped depths reach e^80",
          .openOutside = "depths lie in [-1, 1]: momentDepth() clamps them" },
        { .file = "moments",
          .function = "chebyshevBound(vec2, float, float)",
          .call = NUMERICS_CALL(chebyshevBound(momentsOf(s.x), s.y, s.z)),
          .s = { number("mean", -1, 1), number("depth", -1, 1), number("leastVariance", 1e-7, 1e-6) },
          .range = { 0, 1 },
          .noError = "bounds of sums: squares of exponentials, and steps where a variance is that of rounding",
          .fp32Only = "squares of warped depths reach e^80",
          .openOutside = "depths lie in [-1, 1]: momentDepth() clamps them" },
        { .file = "moments",
          .function = "withoutBleeding(float, float)",
          .call = NUMERICS_CALL(withoutBleeding(s.x, s.y)),
          .s = { number("bound", 0, 1), number("bleeding", 0, 0.5) },
          .range = { 0, 1 },
          .noError = "bounds of sums: squares of exponentials, and steps where a variance is that of rounding",
          .fp32Only = "squares of warped depths reach e^80",
          .openOutside = "depths lie in [-1, 1]: momentDepth() clamps them" },
        { .file = "moments",
          .function = "shadowOfMoments(vec2, float)",
          .call = NUMERICS_CALL(shadowOfMoments(momentsOf(s.x), s.y)),
          .s = { number("mean", -1, 1), number("depth", -1, 1) },
          .range = { 0, 1 },
          .noError = "bounds of sums: squares of exponentials, and steps where a variance is that of rounding",
          .fp32Only = "squares of warped depths reach e^80",
          .openOutside = "depths lie in [-1, 1]: momentDepth() clamps them" },
        { .file = "moments",
          .function = "shadowOfWarpedMoments(vec4, float, float)",
          .call = NUMERICS_CALL(shadowOfWarpedMoments(warpedMomentsOf(s.x), s.y, s.z)),
          .s = { number("mean", -1, 1), number("depth", -1, 1), number("spread", 0, 0.1) },
          .range = { 0, 1 },
          .noError = "bounds of sums: squares of exponentials, and steps where a variance is that of rounding",
          .fp32Only = "squares of warped depths reach e^80",
          .openOutside = "depths lie in [-1, 1]: momentDepth() clamps them" },
    };
    for (std::vector<Row> const& more : { toneMapRows(), toneTableRows(), transferRows(), fogRows(), groundRows() })
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace filament_core::shader::numerics
