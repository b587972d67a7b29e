// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

/// irradianceSh() with four coefficients in nine places (Wrappers.glsl).
Row irradianceRow(std::string_view part, Call call) {
    const Argument coefficient = number("sh", -100, 100);
    return { .file = "ibl",
             .function = "irradianceSh(vec4[9], vec3, int)",
             .part = part,
             .call = call,
             .s = { coefficient, coefficient, coefficient, coefficient },
             .u = direction("n"),
             .range = { 0, kInfinity },
             .limits = { .cpp = 1e-6,
                         .gpu = 1e-6,
                         .half = 1e-2,
                         .negligible = 100,
                         .why = "a signed sum: the error is relative to the largest coefficient" } };
}

std::vector<Row> antiAliasingRows() {
    return {
        { .file = "aa",
          .function = "filteredPerceptualRoughness(float, vec3, vec3, float, float)",
          .call = NUMERICS_CALL(filteredPerceptualRoughness(s.x, u, v, s.y, s.z)),
          .s = { inHalf(unit("perceptualRoughness"), 0.0891, 1), unit("variance"), unit("threshold") },
          .u = { .name = "ddxNormal", .kind = Kind::Offset, .low = 0, .high = 10 },
          .v = { .name = "ddyNormal", .kind = Kind::Offset, .low = 0, .high = 10 },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 5e-7,
                      .gpu = 1e-6,
                      .half = 1e-2,
                      .negligible = 0.001,
                      .why = "the fourth root of a sum; roughness^4 below the least number is lost" } },
        { .file = "ao",
          .function = "specularOcclusion(float, float, float)",
          .call = NUMERICS_CALL(specularOcclusion(s.x, s.y, s.z)),
          .s = { unit("nov"), unit("visibility"), unit("alpha") },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 3e-7,
                      .gpu = 1e-6,
                      .half = 1e-2,
                      .negligible = 1,
                      .why = "cancels where all is occluded: the error is absolute" },
          .openOutside = "pow() of a negative sum" },
        { .file = "ao",
          .function = "multiBounceAo(float, vec3)",
          .call = NUMERICS_CALL(multiBounceAo(s.x, u)),
          .s = { unit("visibility") },
          .u = colour("albedo", 1),
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-6, 1e-2, "sums of products of a few roundings") },
    };
}

/// The fit of shaders/lib/look_ups.glsl.
std::vector<Row> fittedLookUpRows() {
    const auto row = [](std::string_view function, Call call, Interval range) {
        return Row{ .file = "look_ups",
                    .function = function,
                    .call = call,
                    .s = { unit("r"), unit("c") },
                    .range = range,
                    .limits = absolute(1e-5, 0, "sums of ten terms of up to 20, which cancel"),
                    .fp32Only = "terms cancel" };
    };
    return { row("lookUpCubic(float, float, vec4, vec3, vec3)",
                 NUMERICS_CALL(lookUpCubic(s.x, s.y, vec4(8.0f, -7.0f, 6.0f, -5.0f), vec3(4.0f, -3.0f, 2.0f),
                                           vec3(-1.0f, 1.0f, -2.0f))),
                 { -12, 12 }),
             row("lookUpOf(int, int, float, float)", NUMERICS_CALL(lookUpOf(3, 1, s.x, s.y)), { -2, 2 }) };
}

/// Where and how wide the specular lobe looks up the environment.
std::vector<Row> lookUpRows() {
    return {
        { .file = "ibl",
          .function = "dominantSpecularDirection(vec3, vec3, float)",
          .call = NUMERICS_CALL(dominantSpecularDirection(u, v, s.x)),
          .s = { unit("alpha") },
          .u = direction("n"),
          .v = direction("r"),
          .range = { -1.001, 1.001 },
          .limits = absolute(3e-7, 2e-3, "two directions mixed: the error is relative to their length"),
          .openOutside = "the root of 1 - alpha for alpha above 1" },
        { .file = "ibl",
          .function = "quadraticSpecularDirection(vec3, vec3, float)",
          .call = NUMERICS_CALL(quadraticSpecularDirection(u, v, s.x)),
          .s = { unit("alpha") },
          .u = direction("n"),
          .v = direction("r"),
          .range = { -1.001, 1.001 },
          .limits = absolute(3e-7, 2e-3, "two directions mixed: the error is relative to their length") },
        { .file = "ibl",
          .function = "visibleHalfVector(float, float, vec2)",
          .call = NUMERICS_CALL(visibleHalfVector(s.x, s.y, vec2(s.z, s.w))),
          .s = { inHalf(number("nov", 1e-4, 1), 0.01, 1), alpha(), number("disc.x", -0.6875, 0.6875),
                 number("disc.y", -0.6875, 0.6875) },
          .range = { -1.001, 1.001 },
          .limits = absolute(1e-4, 0.1, "a unit vector from parts that cancel where the view grazes") },
        { .file = "ibl",
          .function = "visibleLookUpWeight(float, float, float)",
          .call = NUMERICS_CALL(visibleLookUpWeight(s.x, s.y, s.z)),
          .s = { inHalf(number("nov", 1e-4, 1), 0.01, 1), inHalf(unit("nol"), 0.01, 1), alpha() },
          .range = { 0, 1.01 },
          .limits = absolute(1e-6, 1e-2, "absolute: a weight of up to 1") },
        { .file = "ibl",
          .function = "visibleLookUpRoughness(float, float, float, float)",
          .call = NUMERICS_CALL(visibleLookUpRoughness(s.x, s.y, s.z, s.w)),
          .s = { inHalf(number("nov", 1e-4, 1), 0.01, 1), unit("noh"), alpha(), integer("count", 1, 64) },
          .range = { 0, 1 },
          .limits = absolute(1e-4, 0.1, "absolute: the fourth root of what cancels at the peak of the lobe") },
    };
}

} // namespace

std::vector<Row> imageRows() {
    const Argument levels = number("levelOfRoughnessOne", 1, 14);
    const std::vector<Row> ibl{
        { .file = "ibl",
          .function = "levelFromPerceptualRoughness(float, float)",
          .call = NUMERICS_CALL(levelFromPerceptualRoughness(s.x, s.y)),
          .s = { unit("perceptualRoughness"), levels },
          .range = { 0, 14 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 3e-7, .gpu = 3e-7, .half = 2e-3, .halfNegligible = 1e-3, .why = "three roundings" } },
        { .file = "ibl",
          .function = "perceptualRoughnessFromLevel(float, float)",
          .call = NUMERICS_CALL(perceptualRoughnessFromLevel(min(s.x, s.y), s.y)),
          .s = { number("level", 0, 14), levels },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(3e-4, 3e-2,
                             "absolute: the root of the rounding of level / levelOfRoughnessOne, next to 1") },
        { .file = "ibl",
          .function = "levelFromPerceptualRoughness(float, float, int)",
          .call = NUMERICS_CALL(levelFromPerceptualRoughness(s.x, s.y, int(s.z))),
          .s = { unit("perceptualRoughness"), levels, integer("mapping", 0, 2) },
          .range = { 0, 14 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 1e-6,
                      .gpu = 1e-5,
                      .half = 2e-2,
                      .negligible = 1,
                      .why = "absolute, in levels: log2() of at most 10, doubled" } },
        { .file = "ibl",
          .function = "perceptualRoughnessFromLevel(float, float, int)",
          .call = NUMERICS_CALL(perceptualRoughnessFromLevel(min(s.x, s.y), s.y, int(s.z))),
          .s = { number("level", 0, 14), levels, integer("mapping", 0, 2) },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(3e-4, 3e-2,
                             "absolute: the root of the rounding of level / levelOfRoughnessOne, next to 1") },
        { .file = "ibl",
          .function = "radianceFromRgbm(vec4)",
          .call = NUMERICS_CALL(radianceFromRgbm(s)),
          .s = { unit("r"), unit("g"), unit("b"), unit("a") },
          .range = { 0, 256 },
          .monotone = Monotone::Rising,
          .limits = relative(5e-7, 5e-3, "four products") },
        { .file = "ibl",
          .function = "dfgAnalytic(float, float)",
          .call = NUMERICS_CALL(dfgAnalytic(s.x, s.y)),
          .s = { unit("nov"), unit("perceptualRoughness") },
          .range = { 0, 1 },
          .limits = { .cpp = 1e-6,
                      .gpu = 1e-4,
                      .half = 1e-2,
                      .negligible = 1,
                      .why = "absolute: exp2(), and sums that cancel" },
          .openOutside = "overflow, inf - inf" },
        irradianceRow("1 band", NUMERICS_CALL(irradianceShOf(s, u, 1))),
        irradianceRow("2 bands", NUMERICS_CALL(irradianceShOf(s, u, 2))),
        irradianceRow("3 bands", NUMERICS_CALL(irradianceShOf(s, u, 3))),
    };
    std::vector<Row> rows = antiAliasingRows();
    for (std::vector<Row> const& more : { ibl, lookUpRows(), fittedLookUpRows() })
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace filament_core::shader::numerics
