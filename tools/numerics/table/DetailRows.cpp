// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

std::vector<Row> iridescenceRows() {
    const std::string_view kPhases = "phases reach thousands of radians";
    return {
        { .file = "iridescence",
          .function = "iridescenceSensitivity(float, vec3)",
          .call = NUMERICS_CALL(iridescenceSensitivity(s.x, vec3(s.y, s.y, s.y))),
          .s = { number("difference", 0, 1e6), number("shift", 0, 12.5) },
          .range = { -4, 4 },
          .limits = absolute(2e-4, 0, "absolute: the phase, up to 100 where the response is not yet 0, is rounded"),
          .fp32Only = kPhases },
        { .file = "iridescence",
          .function = "reflectionPhase(float, float)",
          .call = NUMERICS_CALL(reflectionPhase(s.x, s.y)),
          .s = { number("iorBefore", 1, 4), number("iorBehind", 1, 4) },
          .range = { 0, 3.1416 },
          .limits = absolute(1e-6, 1e-2, "a constant") },
        { .file = "iridescence",
          .function = "fresnelIridescent(float, float, vec3, float, float)",
          .call = NUMERICS_CALL(fresnelIridescent(1, s.y, u, s.z, s.x)),
          .s = { unit("cosine"), number("filmIor", 1, 3), number("thickness", 0, 2000) },
          .u = colour("f0", 1),
          .range = { 0, 1 },
          .noError = "where film and base have the same index, its rounding decides about half a wave",
          .fp32Only = kPhases,
          .openOutside = "negative indices divide by zero" },
        { .file = "iridescence",
          .function = "f0FromFresnel(vec3, float)",
          .call = NUMERICS_CALL(f0FromFresnel(u, s.x)),
          .s = { unit("cosine") },
          .u = colour("reflectance", 1),
          .range = { 0, 1 },
          .limits = absolute(5e-4, 0, "absolute: grazing angles divide the rounding by up to 2^-10"),
          .fp32Only = "grazing angles divide the rounding by up to 2^-10" },
    };
}

std::vector<Row> occlusionRows() {
    const std::string_view kAngles = "acos() has no digits next to 1";
    return {
        { .file = "occlusion",
          .function = "visibilityConeVersine(float)",
          .call = NUMERICS_CALL(visibilityConeVersine(s.x)),
          .s = { unit("visibility") },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = relative(4e-7, 4e-3, "a root, a sum and a division") },
        { .file = "occlusion",
          .function = "specularConeVersine(float)",
          .call = NUMERICS_CALL(specularConeVersine(s.x)),
          .s = { unit("perceptualRoughness") },
          .range = { 0, 0.902 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 1e-6, .gpu = 2e-6, .half = 8e-3, .why = "three roundings and oneMinusExp()" } },
        { .file = "occlusion",
          .function = "coneAngle(float)",
          .call = NUMERICS_CALL(coneAngle(s.x)),
          .s = { unit("versine") },
          .range = { 0, 1.571 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 1e-6,
                      .gpu = 2e-5,
                      .half = 1e-2,
                      .negligible = 1e-3,
                      .halfNegligible = 0.1,
                      .why = "a root and an arc tangent, which drivers approximate" },
          .openOutside = "the root of a negative number" },
        { .file = "occlusion",
          .function = "coneIntersection(float, float, float)",
          .call = NUMERICS_CALL(coneIntersection(s.y, s.z, s.x)),
          .s = { number("cosine", -1, 1), unit("versineA"), unit("versineB") },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(1e-3, 0, "absolute: angles, which drivers approximate"),
          .fp32Only = kAngles,
          .openOutside = "the root of a negative number" },
        { .file = "occlusion",
          .function = "specularOcclusionCones(float, float, float)",
          .call = NUMERICS_CALL(specularOcclusionCones(s.y, s.x, s.z)),
          .s = { number("bentCosine", -1, 1), unit("visibility"), number("perceptualRoughness", 0.045, 1) },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(1e-2, 0, "absolute: the error of acos() over the angle of a narrow cone"),
          .fp32Only = kAngles,
          .openOutside = "the root of a negative number" },
        { .file = "occlusion",
          .function = "horizonOcclusion(vec3, vec3)",
          .call = NUMERICS_CALL(horizonOcclusion(u, v)),
          .u = direction("reflected"),
          .v = direction("geometricNormal"),
          .range = { 0, 1 },
          .limits = absolute(1e-6, 5e-3, "absolute: a dot product from 1") },
    };
}

std::vector<Row> normalRows() {
    return {
        { .file = "normals",
          .function = "normalFromTexel(vec3, float)",
          .call = NUMERICS_CALL(normalFromTexel(u, s.x)),
          .s = { inHalf(number("scale", 0, 100), 0, 64) },
          .u = colour("texel", 1),
          .range = { -1.001, 1.001 },
          .limits = absolute(1e-6, 1e-2, "a unit vector: the error is relative to its length"),
          .openOutside = "overflow of the squares" },
        { .file = "normals",
          .function = "blendNormalsReoriented(vec3, vec3)",
          .call = NUMERICS_CALL(blendNormalsReoriented(vec3(u.x, u.y, max(u.z, -u.z)), v)),
          .u = direction("base"),
          .v = direction("detail"),
          .range = { -1.01, 1.01 },
          .limits = absolute(1e-6, 1e-2, "a unit vector: the error is relative to its length") },
        { .file = "normals",
          .function = "blendNormalsUdn(vec3, vec3)",
          .call = NUMERICS_CALL(blendNormalsUdn(vec3(u.x, u.y, max(u.z, -u.z)), v)),
          .u = direction("base"),
          .v = direction("detail"),
          .range = { -1.01, 1.01 },
          .limits = absolute(1e-4, 0.1, "a unit vector out of one that may be as short as 1/128") },
        { .file = "normals",
          .function = "normalWidth(float)",
          .call = NUMERICS_CALL(normalWidth(s.x)),
          .s = { unit("meanLength") },
          .range = { 0, 1 },
          .limits = absolute(1e-6, 5e-2, "the root of a difference from 1") },
        { .file = "normals",
          .function = "normalWidth(float)",
          .part = "normals that are alike",
          .call = NUMERICS_CALL(normalWidth(s.x + 1.0f)),
          .s = { unit("meanLength") },
          .range = { 0, 0 },
          .limits = absolute(0, 0, "nothing is averaged away") },
        { .file = "normals",
          .function = "normalWidth(float)",
          .part = "normals that cancel out",
          .call = NUMERICS_CALL(normalWidth(s.x * 0.0f)),
          .s = { unit("meanLength") },
          .range = { 1, 1 },
          .limits = absolute(0, 0, "as rough as can be") },
        { .file = "normals",
          .function = "widenedPerceptualRoughness(float, float)",
          .call = NUMERICS_CALL(widenedPerceptualRoughness(s.x, s.y)),
          .s = { unit("perceptualRoughness"), unit("width") },
          .range = { 0, 1 },
          .limits = absolute(1e-6, 2e-2, "two roots of a sum that may be subnormal in fp16") },
    };
}

// The values between the limits of the rules.
std::vector<Row> plausibleRows() {
    const Limits exact = absolute(0, 0, "the number of a rule");
    const auto row = [&](std::string_view part, Call call, double rule) {
        return Row{ .file = "plausible",
                    .function = "implausibleRule(vec3, float, float, vec3)",
                    .part = part,
                    .call = call,
                    .s = { unit("metallic"), unit("f0") },
                    .u = colour("baseColor", 1),
                    .v = colour("emissive", 1),
                    .range = { rule, rule },
                    .limits = exact };
    };
    return {
        row("none", NUMERICS_CALL(implausibleRule(u * vec3(0.25f) + vec3(0.25f), s.x * 0.0625f, s.y + 0.03125f, v)), 0),
        row("mixed", NUMERICS_CALL(implausibleRule(u, s.x * 0.5f + 0.25f, s.y, v)), 1),
        row("dark", NUMERICS_CALL(implausibleRule(u * vec3(0.015625f), s.x * 0.0625f, s.y, v)), 2),
        row("bright", NUMERICS_CALL(implausibleRule(u + vec3(0.9375f), s.x * 0.0625f, s.y, v)), 3),
        row("dark metal", NUMERICS_CALL(implausibleRule(u * vec3(0.25f), s.x * 0.0625f + 0.9375f, s.y, v)), 4),
        row("reflectance",
            NUMERICS_CALL(implausibleRule(u * vec3(0.25f) + vec3(0.25f), s.x * 0.0625f, s.y * 0.015625f, v)), 5),
        row("emission",
            NUMERICS_CALL(
                    implausibleRule(u * vec3(0.25f) + vec3(0.25f), s.x * 0.0625f, s.y + 0.03125f, v + vec3(2.0f))),
            6),
    };
}

std::vector<Row> parallaxRows() {
    const std::string_view kCoordinates = "coordinates of textures";
    const Limits flat = absolute(1e-6, 0, "nothing moves where no height is given");
    const std::array<Argument, 4> uv{ unit("uv.x"), unit("uv.y"), unit("scale") };
    const auto flatRow = [&](std::string_view function, Call call) {
        return Row{ .file = "parallax",
                    .function = function,
                    .part = "flat",
                    .call = call,
                    .s = uv,
                    .u = direction("viewTangent"),
                    .range = { 0, 1 },
                    .limits = flat,
                    .fp32Only = kCoordinates };
    };
    return {
        { .file = "parallax",
          .function = "parallaxShift(vec3, float)",
          .call = NUMERICS_CALL(parallaxShift(u, s.x)),
          .s = { unit("scale") },
          .u = direction("viewTangent"),
          .range = { -16.1, 16.1 },
          .limits = { .cpp = 3e-7, .gpu = 3e-7, .negligible = 1e-20, .why = "a division and a product" },
          .fp32Only = kCoordinates },
        { .file = "parallax",
          .function = "parallaxCrossing(float, float, float, float)",
          .call = NUMERICS_CALL(parallaxCrossing(s.x, s.y, s.z, s.w)),
          .s = { unit("rayBefore"), unit("fieldBefore"), unit("rayAfter"), unit("fieldAfter") },
          .range = { 0, 1 },
          .noError = "a quotient of differences that may both cancel",
          .fp32Only = kCoordinates },
        flatRow("parallaxPlain(vec2, vec3, float)", NUMERICS_CALL(parallaxPlain(vec2(s.x, s.y), u, s.z))),
        flatRow("parallaxSteep(vec2, vec3, float, int)", NUMERICS_CALL(parallaxSteep(vec2(s.x, s.y), u, s.z, 16))),
        flatRow("parallaxOcclusion(vec2, vec3, float, int)",
                NUMERICS_CALL(parallaxOcclusion(vec2(s.x, s.y), u, s.z, 16))),
        { .file = "parallax",
          .function = "parallaxOffset(float, vec3, float)",
          .call = NUMERICS_CALL(parallaxOffset(s.x, u, s.y)),
          .s = { unit("depth"), unit("meters") },
          .u = direction("viewTangent"),
          .range = { 0, 16.1 },
          .limits = { .cpp = 3e-7, .gpu = 3e-7, .negligible = 1e-20, .why = "two products and a division" },
          .fp32Only = kCoordinates },
        flatRow("parallaxShadow(vec3, vec3, float, int, float)",
                NUMERICS_CALL(parallaxShadow(vec3(s.x, s.y, s.z), u, s.z, 16, 0.25f))),
    };
}

} // namespace

std::vector<Row> detailRows() {
    std::vector<Row> rows = iridescenceRows();
    for (std::vector<Row> const& more : { occlusionRows(), normalRows(), plausibleRows(), parallaxRows() })
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace filament_core::shader::numerics
