// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament::shader::numerics {
namespace {

/// The ranges of clampPerceptualRoughness() and its medium variant, squared.
Argument alpha(std::string_view name = "alpha", double high = 1) {
    return inHalf(number(name, 0.002025, high), 0.007921, high);
}
Argument fraction(std::string_view name) { return { .name = name, .high = 1, .open = true }; }

std::vector<Row> anisotropicRows() {
    const std::array<Argument, 4> alphas{ alpha("alpha.x", 2), alpha("alpha.y", 2) };
    return {
        { .file = "brdf_anisotropic",
          .function = "anisotropicAlpha(float, float, float)",
          .call = NUMERICS_CALL(anisotropicAlpha(s.x, s.y, s.z)),
          .s = { unit("alpha"), number("anisotropy", -1, 1), alpha("minAlpha") },
          .range = { 0.002, 2 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 2e-7, .gpu = 2e-7, .half = 2e-3, .halfNegligible = 0.01, .why = "two roundings" } },
        { .file = "brdf_anisotropic",
          .function = "anisotropicAlphaFromStrength(float, float, float)",
          .call = NUMERICS_CALL(anisotropicAlphaFromStrength(s.x, s.y, s.z)),
          .s = { unit("alpha"), unit("strength"), alpha("minAlpha") },
          .range = { 0.002, 1.0001 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 2e-7, .gpu = 2e-7, .half = 2e-3, .halfNegligible = 0.01, .why = "three roundings" } },
        { .file = "brdf_anisotropic",
          .function = "ndfGgxAnisotropic(vec3, vec2)",
          .call = NUMERICS_CALL(ndfGgxAnisotropic(u, vec2(s.x, s.y))),
          .s = alphas,
          .u = direction("halfLocal"),
          .range = { 0, 77630 },
          .limits = relative(2e-6, 2e-2, "twelve roundings, sums of squares only"),
          .openOutside = "alpha 0 divides 0 by 0" },
        { .file = "brdf_anisotropic",
          .function = "visibilitySmithGgxAnisotropic(vec3, vec3, vec2)",
          .call = NUMERICS_CALL(visibilitySmithGgxAnisotropic(vec3(u.x, u.y, max(u.z, -u.z)),
                                                              vec3(v.x, v.y, max(v.z, -v.z)), vec2(s.x, s.y))),
          .s = alphas,
          .u = direction("viewLocal"),
          .v = direction("lightLocal"),
          .range = { 0, 5.1e9 },
          .limits = { .cpp = 1e-6,
                      .gpu = 1e-6,
                      .half = 1e-2,
                      .halfLargest = 2048,
                      .why = "two roots, sums of positive numbers only" } },
        { .file = "brdf_anisotropic",
          .function = "importanceSampleGgxAnisotropic(vec2, vec2)",
          .call = NUMERICS_CALL(importanceSampleGgxAnisotropic(vec2(s.x, s.y), vec2(s.z, s.w))),
          .s = { fraction("u.x"), fraction("u.y"), alpha("alpha.x", 2), alpha("alpha.y", 2) },
          .range = { -1.002, 1.002 },
          .limits = absolute(1e-3, 0,
                             "absolute: the larger alpha over the lesser, up to 1000, times the rounding of 2 pi u"),
          .fp32Only = "up to 250 times the rounding of 2 pi u; samples are drawn on the CPU",
          .openOutside = "the root of 1 - u.y for u.y above 1" },
        { .file = "brdf_anisotropic",
          .function = "anisotropicNormal(vec3, vec3, vec3, vec3, float, float)",
          .call = NUMERICS_CALL(anisotropicNormal(vec3(0, 0, 1), vec3(1, 0, 0), vec3(0, 1, 0),
                                                  vec3(u.x, u.y, max(u.z, -u.z)), s.x, s.y)),
          .s = { number("anisotropy", -1, 1), unit("perceptualRoughness") },
          .u = direction("view"),
          .range = { -1.001, 1.001 },
          .limits = absolute(1e-5, 3e-2,
                             "a unit vector: the error is relative to its length; the bent one is as short as 1/32") },
    };
}

std::vector<Row> coatRows() {
    const Limits factor = absolute(4e-7, 4e-3, "absolute: what is reflected is taken from 1");
    const Argument strength = unit("strength");
    return {
        { .file = "coat",
          .function = "visibilityKelemen(float)",
          .call = NUMERICS_CALL(visibilityKelemen(s.x)),
          .s = { unit("voh") },
          .range = { 0.25, 2.51e9 },
          .monotone = Monotone::Falling,
          .limits = { .cpp = 3e-7,
                      .gpu = 3e-7,
                      .half = 3e-3,
                      .halfLargest = 2048,
                      .why = "a product and a division" } },
        { .file = "coat",
          .function = "visibilityCoat(float, float, float, float)",
          .call = NUMERICS_CALL(visibilityCoat(s.x, s.y, s.z, s.w)),
          .s = { unit("nov"), unit("nol"), unit("voh"), alpha() },
          .range = { 0, 2.51e9 },
          .monotone = Monotone::Falling,
          .limits = { .cpp = 1e-6,
                      .gpu = 1e-6,
                      .half = 1e-2,
                      .halfLargest = 2048,
                      .why = "eight roundings at most, none of a difference that cancels" } },
        { .file = "coat",
          .function = "coatFresnel(float, float)",
          .call = NUMERICS_CALL(coatFresnel(s.x, s.y)),
          .s = { unit("cosine"), strength },
          .range = { 0, 1 },
          .monotone = Monotone::Falling,
          .limits = { .cpp = 4e-7, .gpu = 4e-7, .half = 4e-3, .halfNegligible = 0.04, .why = "five roundings" } },
        { .file = "coat",
          .function = "coatTransmission(float, float)",
          .call = NUMERICS_CALL(coatTransmission(s.x, s.y)),
          .s = { unit("cosine"), strength },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = factor },
        { .file = "coat",
          .function = "coatTransmissionFromDfg(vec2, float)",
          .call = NUMERICS_CALL(coatTransmissionFromDfg(vec2(s.x * s.y, s.y), s.z)),
          .s = { unit("dfg.x / dfg.y"), unit("dfg.y"), strength },
          .range = { 0, 1 },
          .monotone = Monotone::Falling,
          .limits = factor },
        { .file = "coat",
          .function = "coatAverageTransmission(float)",
          .call = NUMERICS_CALL(coatAverageTransmission(s.x)),
          .s = { strength },
          .range = { 0.914, 1 },
          .monotone = Monotone::Falling,
          .limits = factor },
        { .file = "coat",
          .function = "coatAttenuation(float, float, float)",
          .call = NUMERICS_CALL(coatAttenuation(s.x, s.y, s.z)),
          .s = { unit("nov"), unit("nol"), strength },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = factor },
        { .file = "coat",
          .function = "f0UnderCoat(float)",
          .call = NUMERICS_CALL(f0UnderCoat(s.x)),
          .s = { unit("f0") },
          .range = { 0, 1.0001 },
          .limits = factor,
          .openOutside = "the root of a negative f0" },
        { .file = "coat",
          .function = "f0UnderCoat(vec3, float)",
          .call = NUMERICS_CALL(f0UnderCoat(u, s.x)),
          .s = { strength },
          .u = colour("f0", 1),
          .range = { 0, 1.0001 },
          .limits = factor,
          .openOutside = "the root of a negative f0" },
    };
}

std::vector<Row> sheenLobeRows() {
    const std::string_view kRoots = "powers of a negative 1 - cos^2, or of a negative cosine";
    const Limits logLambda{ .cpp = 5e-6,
                            .gpu = 5e-6,
                            .half = 1e-2,
                            .negligible = 4,
                            .why = "absolute about 0: parameters of up to 25 cancel" };
    return {
        { .file = "sheen",
          .function = "ndfCharlie(float, float)",
          .call = NUMERICS_CALL(ndfCharlie(s.x, s.y)),
          .s = { unit("noh"), alpha() },
          .range = { 0, 79 },
          .monotone = Monotone::Falling,
          .limits = absolute(1e-4, 5e-2, "an exponent of up to 247 times the rounding of a logarithm") },
        { .file = "sheen",
          .function = "ndfAshikhmin(float, float)",
          .call = NUMERICS_CALL(ndfAshikhmin(s.x, s.y)),
          .s = { unit("noh"), alpha() },
          .range = { 0, 1.6 },
          .limits = { .cpp = 1e-5,
                      .gpu = 1e-5,
                      .half = 5e-2,
                      .negligible = 0.3,
                      .why = "relative to the uniform part: the exponent multiplies its rounding" },
          .openOutside = "alpha 0 divides by zero" },
        { .file = "sheen",
          .function = "visibilityNeubelt(float, float)",
          .call = NUMERICS_CALL(visibilityNeubelt(s.x, s.y)),
          .s = { unit("nov"), unit("nol") },
          .range = { 0.2499, 2.51e9 },
          .monotone = Monotone::Falling,
          .limits = { .cpp = 1e-6, .gpu = 1e-6, .half = 1e-2, .halfLargest = 2048, .why = "four roundings" } },
        { .file = "sheen",
          .function = "charlieLogLambdaFit(float, float)",
          .call = NUMERICS_CALL(charlieLogLambdaFit(s.x, s.y)),
          .s = { number("cosine", 0, 0.5), alpha() },
          .range = { -3, 21 },
          .monotone = Monotone::Falling,
          .limits = logLambda,
          .openOutside = kRoots },
        { .file = "sheen",
          .function = "charlieLogLambda(float, float)",
          .call = NUMERICS_CALL(charlieLogLambda(s.x, s.y)),
          .s = { unit("cosine"), alpha() },
          .range = { -25, 21 },
          .monotone = Monotone::Falling,
          .limits = logLambda,
          .openOutside = kRoots },
        { .file = "sheen",
          .function = "visibilityCharlie(float, float, float)",
          .call = NUMERICS_CALL(visibilityCharlie(s.x, s.y, s.z)),
          .s = { inHalf(unit("nov"), 0x1p-14, 1), inHalf(unit("nol"), 0x1p-14, 1), alpha() },
          .range = { 0, 1e12 },
          .limits = relative(5e-5, 0.1, "the error of an exponent becomes relative"),
          .openOutside = kRoots },
    };
}

std::vector<Row> sheenRows() {
    std::vector<Row> rows = sheenLobeRows();
    const std::vector<Row> more{
        { .file = "sheen",
          .function = "sheenLimit(float)",
          .call = NUMERICS_CALL(sheenLimit(s.x)),
          .s = { inHalf(number("albedo", 0, 1e6), 0, 64) },
          .range = { 0, 1 },
          .monotone = Monotone::Falling,
          .limits = { .cpp = 6e-8, .gpu = 2e-7, .half = 2e-3, .why = "a division" } },
        { .file = "sheen",
          .function = "sheenAlbedoScaling(vec3, float)",
          .call = NUMERICS_CALL(sheenAlbedoScaling(u, s.x)),
          .s = { inHalf(number("albedo", 0, 100), 0, 64) },
          .u = colour("sheenColor", 1),
          .range = { 0, 1 },
          .monotone = Monotone::Falling,
          .limits = absolute(2e-7, 2e-3, "absolute: taken from 1") },
        { .file = "sheen",
          .function = "importanceSampleCharlie(vec2, float)",
          .call = NUMERICS_CALL(importanceSampleCharlie(vec2(s.x, s.y), s.z)),
          .s = { fraction("u.x"), fraction("u.y"), alpha() },
          .range = { -1.001, 1.001 },
          .limits = absolute(2e-4, 0, "absolute: the root of what logarithms lose where u is next to 1"),
          .fp32Only = "the least u has no place in 16 bits, and samples are drawn on the CPU",
          .openOutside = "1 + 2 alpha may be 0" },
    };
    rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace

std::vector<Row> layerRows() {
    std::vector<Row> rows = anisotropicRows();
    for (std::vector<Row> const& more : { coatRows(), sheenRows() }) rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace filament::shader::numerics
