// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament::shader::numerics {
namespace {

/// What clampPerceptualRoughness() and its medium variant leave, squared.
Argument alpha() { return inHalf(number("alpha", 0.002025, 1), 0.007921, 1); }
Argument cosine(std::string_view name) { return unit(name); }

Limits eightRoundings() { return relative(1e-6, 1e-2, "eight roundings at most, none of a difference that cancels"); }

std::vector<Row> roughnessRows() {
    const Argument anything = inHalf(number("perceptualRoughness", -3e38, 3e38), -65504, 65504);
    return {
        { .file = "brdf",
          .function = "clampPerceptualRoughness(float)",
          .call = NUMERICS_CALL(clampPerceptualRoughness(s.x)),
          .s = { anything },
          .range = { 0.0449, 1 },
          .monotone = Monotone::Rising,
          .limits = relative(6e-8, 5e-4, "the bound itself is rounded") },
        { .file = "brdf",
          .function = "clampPerceptualRoughnessMedium(float)",
          .call = NUMERICS_CALL(clampPerceptualRoughnessMedium(s.x)),
          .s = { anything },
          .range = { 0.0889, 1 },
          .monotone = Monotone::Rising,
          .limits = relative(6e-8, 5e-4, "the bound itself is rounded") },
        { .file = "brdf",
          .function = "alphaFromPerceptual(float)",
          .call = NUMERICS_CALL(alphaFromPerceptual(s.x)),
          .s = { unit("perceptualRoughness") },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 6e-8, .gpu = 6e-8, .half = 5e-4, .halfNegligible = 1e-4, .why = "one rounding" } },
    };
}

Row correlatedRow(std::string_view function, Call call) {
    Limits limits = eightRoundings();
    limits.halfLargest = 4096;
    return { .file = "brdf",
             .function = function,
             .call = call,
             .s = { cosine("nov"), cosine("nol"), alpha() },
             .range = { 0, 5.1e9 },
             .monotone = Monotone::Falling,
             .limits = limits };
}

std::vector<Row> lobeRows() {
    return {
        { .file = "brdf",
          .function = "ndfGgx(float, float)",
          .call = NUMERICS_CALL(ndfGgx(s.x, s.y)),
          .s = { cosine("noh"), alpha() },
          .range = { 0, 77630 },
          .monotone = Monotone::Rising,
          .limits = relative(2e-6, 0, "nine roundings; 1 - noh is exact, its input is not"),
          .fp32Only = "1 - noh has no bits left near the highlight; ndfGgxFromVectors() is the medium variant" },
        { .file = "brdf",
          .function = "ndfGgxFromVectors(vec3, vec3, float)",
          .call = NUMERICS_CALL(ndfGgxFromVectors(u, v, s.x)),
          .s = { alpha() },
          .u = direction("n"),
          .v = direction("h"),
          .range = { 0, 77630 },
          .limits = eightRoundings() },
        correlatedRow("visibilitySmithGgxCorrelated(float, float, float)",
                      NUMERICS_CALL(visibilitySmithGgxCorrelated(s.x, s.y, s.z))),
        correlatedRow("visibilitySmithGgxCorrelatedFast(float, float, float)",
                      NUMERICS_CALL(visibilitySmithGgxCorrelatedFast(s.x, s.y, s.z))),
        { .file = "brdf",
          .function = "visibilitySmithGgxUncorrelated(float, float, float)",
          .call = NUMERICS_CALL(visibilitySmithGgxUncorrelated(s.x, s.y, s.z)),
          .s = { cosine("nov"), cosine("nol"), alpha() },
          .range = { 0.2499, 2.5e5 },
          .monotone = Monotone::Falling,
          .limits = relative(1e-6, 1e-2, "two roots, a product and a division"),
          .openOutside = "roots of negative numbers, where alpha exceeds 1" },
        { .file = "brdf",
          .function = "diffuseWrapped(float, float)",
          .call = NUMERICS_CALL(diffuseWrapped(s.x, s.y)),
          .s = { number("nol", -1, 1), unit("wrap") },
          .range = { 0, 0.3184 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 3e-7,
                      .gpu = 3e-7,
                      .half = 3e-3,
                      .negligible = 0.3,
                      .why = "cancels where light just reaches: the error is relative to 1 / pi" },
          .openOutside = "wrap -1 divides by zero" },
        { .file = "brdf",
          .function = "diffuseDisney(float, float, float, float)",
          .call = NUMERICS_CALL(diffuseDisney(s.x, s.y, s.z, s.w)),
          .s = { cosine("nov"), cosine("nol"), cosine("voh"), unit("perceptualRoughness") },
          .range = { 0, 1.318 },
          .limits = { .cpp = 1e-6,
                      .gpu = 1e-6,
                      .half = 1e-2,
                      .negligible = 0.3,
                      .why = "1 - (1 - cos)^5 cancels where smooth surfaces graze: the error is relative to 1 / pi" } },
        { .file = "brdf",
          .function = "fresnelSchlick(vec3, float, float)",
          .call = NUMERICS_CALL(fresnelSchlick(u, s.y, s.x)),
          .s = { cosine("voh"), unit("f90") },
          .u = colour("f0", 1),
          .range = { 0, 1 },
          .limits = absolute(3e-7, 2e-3, "f0 may cancel against f90: the error is absolute") },
        { .file = "brdf",
          .function = "diffuseLambert()",
          .call = NUMERICS_CALL(diffuseLambert()),
          .range = { 0.318, 0.319 },
          .limits = relative(6e-8, 5e-4, "a constant") },
    };
}

std::vector<Row> fresnelRows() {
    const Limits reflectance = absolute(1e-4, 0, "absolute: n is rounded before n - 1 decides what grazing light does");
    const std::string_view kSquares = "n^2 k^2 of mirrors overflows 16 bits";
    return {
        { .file = "fresnel",
          .function = "fresnelComplex(float, float, float)",
          .call = NUMERICS_CALL(fresnelComplex(s.x, s.y, s.z)),
          .s = { cosine("cosine"), number("n", 0, 4100), number("k2", 0, 4.3e6) },
          .range = { 0, 1 },
          .limits = absolute(1e-6, 0, "absolute: a difference of nearly equal sums where much is transmitted"),
          .fp32Only = kSquares,
          .openOutside = "overflow, inf - inf" },
        { .file = "fresnel",
          .function = "complexIorFromTint(float, float)",
          .call = NUMERICS_CALL(complexIorFromTint(s.x, s.y)),
          .s = { unit("f0"), unit("edgeTint") },
          .range = { 0, 4.3e6 },
          .limits = { .cpp = 2e-6,
                      .gpu = 2e-6,
                      .negligible = 1e-20,
                      .why = "twelve roundings, none of a difference that cancels" },
          .fp32Only = kSquares,
          .openOutside = "the root of a negative f0" },
        { .file = "fresnel",
          .function = "fresnelExact(float, float, float)",
          .part = "no boundary at all",
          .call = NUMERICS_CALL(fresnelExact(s.x, s.y, s.z)),
          .s = { number("f0", 0, 1e-4), unit("edgeTint"), cosine("voh") },
          .range = { 0, 1 },
          .noError = "for n = 1 nothing is reflected, for the next number grazing light is: fp32 has none between",
          .fp32Only = kSquares,
          .openOutside = "the root of a negative f0" },
        { .file = "fresnel",
          .function = "fresnelExact(float, float, float)",
          .part = "boundaries",
          .call = NUMERICS_CALL(fresnelExact(s.x, s.y, s.z)),
          .s = { number("f0", 1e-4, 1), unit("edgeTint"), cosine("voh") },
          .range = { 0, 1 },
          .limits = absolute(2e-6, 0, "absolute: the error of n and k^2, and of a difference of nearly equal sums"),
          .fp32Only = kSquares,
          .openOutside = "the root of a negative f0" },
        { .file = "fresnel",
          .function = "fresnelExact(vec3, float, float)",
          .call = NUMERICS_CALL(fresnelExact(u, s.x, s.y)),
          .s = { unit("edgeTint"), cosine("voh") },
          .u = colour("f0", 1),
          .range = { 0, 1 },
          .limits = reflectance,
          .fp32Only = kSquares,
          .openOutside = "the root of a negative f0" },
    };
}

std::vector<Row> parameterRows() {
    return {
        { .file = "brdf",
          .function = "f0FromReflectance(float)",
          .call = NUMERICS_CALL(f0FromReflectance(s.x)),
          .s = { unit("reflectance") },
          .range = { 0, 0.1601 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 2e-7, .gpu = 2e-7, .half = 2e-3, .halfNegligible = 1e-3, .why = "three roundings" } },
        { .file = "brdf",
          .function = "f0FromIor(float)",
          .call = NUMERICS_CALL(f0FromIor(s.x)),
          .s = { inHalf(number("ior", 1, 1e18), 1, 2048) },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 4e-7, .gpu = 4e-7, .half = 4e-3, .halfNegligible = 1e-3, .why = "five roundings" },
          .openOutside = "ior -1 divides by zero" },
        { .file = "brdf",
          .function = "iorFromF0(float)",
          .call = NUMERICS_CALL(iorFromF0(s.x)),
          .s = { Argument{ .name = "f0", .high = 1, .open = true } },
          .range = { 1, kInfinity },
          .monotone = Monotone::Rising,
          .limits = eightRoundings(),
          .openOutside = "the root of a negative f0" },
        { .file = "brdf",
          .function = "f0FromBaseColor(vec3, float, float)",
          .call = NUMERICS_CALL(f0FromBaseColor(u, s.x, s.y)),
          .s = { unit("metallic"), unit("reflectance") },
          .u = colour("baseColor", 1),
          .range = { 0, 1 },
          .limits = absolute(2e-7, 1e-3, "absolute: mixing cancels the grey where all is metal") },
        { .file = "brdf",
          .function = "diffuseColor(vec3, float)",
          .call = NUMERICS_CALL(diffuseColor(u, s.x)),
          .s = { unit("metallic") },
          .u = colour("baseColor", 1),
          .range = { 0, 1 },
          .monotone = Monotone::Falling,
          .limits = { .cpp = 2e-7, .gpu = 2e-7, .half = 2e-3, .halfNegligible = 1e-3, .why = "two roundings" } },
        { .file = "brdf",
          .function = "energyCompensation(vec3, vec2)",
          .call = NUMERICS_CALL(energyCompensation(u, vec2(s.y * s.x, s.x))),
          .s = { number("dfg.y", 0x1p-10, 1), unit("dfg.x / dfg.y") },
          .u = colour("f0", 1),
          .range = { 1, 1025 },
          .monotone = Monotone::Falling,
          .limits = eightRoundings() },
        { .file = "brdf",
          .function = "specularDfg(vec3, vec2)",
          .call = NUMERICS_CALL(specularDfg(u, vec2(s.x * s.y, s.y))),
          .s = { unit("dfg.x / dfg.y"), unit("dfg.y") },
          .u = colour("f0", 1),
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = eightRoundings() },
        { .file = "brdf",
          .function = "specularDfg(vec3, float, vec2)",
          .call = NUMERICS_CALL(specularDfg(u, s.z, vec2(s.x * s.y, s.y))),
          .s = { unit("dfg.x / dfg.y"), unit("dfg.y"), unit("f90") },
          .u = colour("f0", 1),
          .range = { 0, 1 },
          .limits = { .cpp = 1e-6,
                      .gpu = 1e-6,
                      .half = 1e-2,
                      .negligible = 0.125,
                      .halfNegligible = 0.125,
                      .why = "the table's two values cancel where they are close: an ulp of them remains" } },
    };
}

} // namespace

std::vector<Row> brdfRows() {
    std::vector<Row> rows = roughnessRows();
    for (std::vector<Row> const& more : { lobeRows(), parameterRows(), fresnelRows() })
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace filament::shader::numerics
