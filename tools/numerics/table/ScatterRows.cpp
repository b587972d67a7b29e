// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kNoIor = "ior 0 divides by zero";

Argument ior() { return number("ior", 1, 4); }

std::vector<Row> specularRows() {
    return {
        { .file = "specular",
          .function = "reflectanceFromF0(float)",
          .call = NUMERICS_CALL(reflectanceFromF0(s.x)),
          .s = { unit("f0") },
          .range = { 0, 2.5 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 2e-7, .gpu = 4e-7, .half = 2e-3, .negligible = 1e-12, .why = "a root and a product" },
          .openOutside = "the root of a negative f0" },
        { .file = "specular",
          .function = "reflectanceFromIor(float)",
          .call = NUMERICS_CALL(reflectanceFromIor(s.x)),
          .s = { inHalf(number("ior", 1, 1e18), 1, 2048) },
          .range = { 0, 2.501 },
          .monotone = Monotone::Rising,
          .limits = relative(4e-7, 4e-3, "four roundings"),
          .openOutside = "ior -1 divides by zero" },
        { .file = "specular",
          .function = "iorFromReflectance(float)",
          .call = NUMERICS_CALL(iorFromReflectance(s.x)),
          .s = { unit("reflectance") },
          .range = { 1, 2.335 },
          .monotone = Monotone::Rising,
          .limits = relative(4e-7, 3e-3, "five roundings") },
        { .file = "specular",
          .function = "f0FromSpecular(vec3, float, float, vec3, float)",
          .call = NUMERICS_CALL(f0FromSpecular(u, s.x, s.y, v, s.z)),
          .s = { unit("metallic"), unit("f0"), unit("weight") },
          .u = colour("baseColor", 1),
          .v = colour("specularColor", 25),
          .range = { 0, 1.001 },
          .limits = absolute(4e-7, 3e-3, "absolute: mixing cancels the dielectric where all is metal") },
        { .file = "specular",
          .function = "f90FromSpecular(float, float)",
          .call = NUMERICS_CALL(f90FromSpecular(s.x, s.y)),
          .s = { unit("weight"), unit("metallic") },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(2e-7, 1e-3, "absolute: a mixture") },
        { .file = "specular",
          .function = "diffuseColorFromSpecularGlossiness(vec3, vec3)",
          .call = NUMERICS_CALL(diffuseColorFromSpecularGlossiness(u, v)),
          .u = colour("diffuse", 1),
          .v = colour("specular", 1),
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(2e-7, 1e-3, "absolute: what is reflected is taken from 1") },
        { .file = "specular",
          .function = "perceptualRoughnessFromGlossiness(float)",
          .call = NUMERICS_CALL(perceptualRoughnessFromGlossiness(s.x)),
          .s = { unit("glossiness") },
          .range = { 0, 1 },
          .monotone = Monotone::Falling,
          .limits = absolute(6e-8, 5e-4, "absolute: taken from 1") },
    };
}

/// A direction behind the surface z = 0; the view is in front.
Row bentRow(std::string_view function, Call call, Limits limits) {
    return { .file = "refraction",
             .function = function,
             .call = call,
             .s = { ior() },
             .u = direction("view"),
             .range = { -1.01, 1.01 },
             .limits = limits,
             .openOutside = kNoIor };
}

/// A cosine or a length of the refracted ray.
Row insideRow(std::string_view function, Call call, Argument third, std::string_view why) {
    return { .file = "refraction",
             .function = function,
             .call = call,
             .s = { unit("nov"), ior(), third },
             .range = { 0, 1 },
             .monotone = Monotone::Rising,
             .limits = absolute(1e-6, 5e-3, why),
             .openOutside = kNoIor };
}

std::vector<Row> directionRows() {
    const Limits bent = absolute(2e-6, 2e-2, "absolute: sums of products that cancel at grazing angles");
    return {
        { .file = "refraction",
          .function = "refractOrReflect(vec3, vec3, float)",
          .call = NUMERICS_CALL(refractOrReflect(vec3(u.x, u.y, min(u.z, -u.z)), vec3(0, 0, 1), s.x)),
          .s = { number("eta", 0.25, 4) },
          .u = direction("incident"),
          .range = { -1.01, 1.01 },
          .noError = "next to total reflection one rounding of the index decides between two directions",
          .openOutside = "overflow, inf - inf" },
        bentRow("refractedInside(vec3, vec3, float)",
                NUMERICS_CALL(refractedInside(vec3(0, 0, 1), vec3(u.x, u.y, max(u.z, -u.z)), s.x)), bent),
        bentRow("refractedSolid(vec3, vec3, float)",
                NUMERICS_CALL(refractedSolid(vec3(0, 0, 1), vec3(u.x, u.y, max(u.z, -u.z)), s.x)), bent),
        insideRow("refractedCosine(float, float)", NUMERICS_CALL(refractedCosine(s.x, s.y)), {},
                  "absolute: a root and a division"),
        insideRow("solidPathLength(float, float, float)", NUMERICS_CALL(solidPathLength(s.x, s.y, s.z)),
                  unit("thickness"), "absolute: the error of refractedCosine()"),
        { .file = "refraction",
          .function = "solidExit(vec3, vec3, float, float)",
          .call = NUMERICS_CALL(solidExit(vec3(0, 0, 1), vec3(u.x, u.y, max(u.z, -u.z)), s.x, s.y)),
          .s = { ior(), unit("thickness") },
          .u = direction("view"),
          .range = { -1.01, 1.01 },
          .limits = absolute(3e-6, 3e-2, "absolute: the errors of refractedInside() and refractedCosine()"),
          .openOutside = kNoIor },
        { .file = "refraction",
          .function = "thinPathLength(float, float, float)",
          .call = NUMERICS_CALL(thinPathLength(s.x, s.y, s.z)),
          .s = { unit("nov"), number("ior", 1.0625, 4), unit("thickness") },
          .range = { 0, 32 },
          .monotone = Monotone::Falling,
          .limits = { .cpp = 2e-6,
                      .gpu = 2e-6,
                      .half = 3e-2,
                      .negligible = 1e-20,
                      .halfNegligible = 0.01,
                      .why = "the error of refractedCosine()" },
          .openOutside = kNoIor },
    };
}

/// Light that has crossed the first interface of a thin sheet.
Row sheetRow(std::string_view function, Call call) {
    return { .file = "refraction",
             .function = function,
             .call = call,
             .u = colour("f", 1),
             .v = colour("tint", 1),
             .range = { 0, 1 },
             .limits = absolute(1e-6, 3e-3, "absolute: what both interfaces let through cancels where f is almost 1"),
             .openOutside = "f -2 lets more through than arrives" };
}

std::vector<Row> transmissionRows() {
    return {
        { .file = "refraction",
          .function = "thinReflectance(vec3)",
          .call = NUMERICS_CALL(thinReflectance(u)),
          .u = colour("f", 1),
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 3e-7, .gpu = 3e-7, .half = 2e-3, .halfNegligible = 1e-3, .why = "three roundings" },
          .openOutside = "f -1 divides by zero" },
        sheetRow("thinFarReflectance(vec3, vec3)", NUMERICS_CALL(thinFarReflectance(u, v))),
        sheetRow("thinTransmittance(vec3, vec3)", NUMERICS_CALL(thinTransmittance(u, v))),
        { .file = "refraction",
          .function = "refractionPerceptualRoughness(float, float)",
          .call = NUMERICS_CALL(refractionPerceptualRoughness(s.x, s.y)),
          .s = { unit("perceptualRoughness"), ior() },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(2e-7, 1e-3, "absolute: 2 is taken from twice the index") },
        { .file = "refraction",
          .function = "transmittedDeviation(float)",
          .call = NUMERICS_CALL(transmittedDeviation(s.x)),
          .s = { unit("perceptualRoughness") },
          .range = { 0, 1.72 },
          .monotone = Monotone::Rising,
          .limits = absolute(4e-7, 3e-3, "absolute: two products") },
        { .file = "refraction",
          .function = "pictureLevel(float)",
          .call = NUMERICS_CALL(pictureLevel(s.x)),
          .s = { number("pixels", 0, 1e6) },
          .range = { 0, 21 },
          .monotone = Monotone::Rising,
          .limits = absolute(3e-6, 0, "absolute: the logarithm of the device"),
          .fp32Only = "squares exceed 65504" },
        { .file = "refraction",
          .function = "dispersedIor(float, float)",
          .call = NUMERICS_CALL(dispersedIor(s.x, s.y)),
          .s = { ior(), number("dispersion", 0, 8) },
          .range = { 1, 5 },
          .monotone = Monotone::Rising,
          .limits = relative(4e-7, 3e-3, "four roundings") },
        { .file = "refraction",
          .function = "transmittance(vec3, float)",
          .call = NUMERICS_CALL(transmittance(u, s.x)),
          .s = { inHalf(number("distance", 0, 1e4), 0, 64) },
          .u = inHalf(colour("absorption", 1e4), 0, 64),
          .range = { 0, 1 },
          .monotone = Monotone::Falling,
          .limits = absolute(3e-7, 3e-3, "absolute: the exponent is rounded"),
          .openOutside = "the power of e overflows for negative numbers" },
        { .file = "refraction",
          .function = "transmittanceWithoutThickness(vec3)",
          .call = NUMERICS_CALL(transmittanceWithoutThickness(u)),
          .u = colour("absorption", 10),
          .range = { 0, 1 },
          .monotone = Monotone::Falling,
          .limits = absolute(6e-8, 5e-4, "absolute: taken from 1") },
        { .file = "refraction",
          .function = "absorptionAtDistance(vec3, float)",
          .part = "times the distance",
          .call = NUMERICS_CALL(absorptionAtDistance(u, s.x) * s.x),
          .s = { number("distance", 0, 1e9) },
          .u = colour("color", 1),
          .range = { 0, 9.71 },
          .limits = absolute(1e-6, 0, "absolute: a logarithm next to 1"),
          .fp32Only = "short distances absorb more than 65504 per metre" },
    };
}

/// A row of a function of three colours.
Row mediumRow(std::string_view function, Call call, Interval range, Limits limits) {
    return { .file = "scatter", .function = function, .call = call, .range = range, .limits = limits };
}

std::vector<Row> mediumRows() {
    const Argument depth = inHalf(colour("depth", 64), 0, 64), loss = colour("loss", 1);
    const Argument anisotropy = number("anisotropy", -0.9990234375, 0.9990234375);
    std::vector<Row> rows{
        mediumRow("scatterLoss(vec3)", NUMERICS_CALL(scatterLoss(u)), { 0, 1.001 },
                  absolute(3e-7, 3e-3, "absolute: the colour is taken from 1")),
        mediumRow("scatterSimilarity(vec3, float)", NUMERICS_CALL(scatterSimilarity(u, s.x)), { 0, 2.001 },
                  absolute(3e-7, 2e-3, "absolute: the anisotropy is taken from 1")),
        mediumRow("ballTransmittance(vec3)", NUMERICS_CALL(ballTransmittance(u)), { 0, 1 },
                  relative(4e-7, 5e-3, "four roundings")),
        mediumRow("ballEscape(vec3)", NUMERICS_CALL(ballEscape(u)), { 0, 1 }, relative(6e-7, 6e-3, "seven roundings")),
        mediumRow("diffuseReflectedInside(float)", NUMERICS_CALL(diffuseReflectedInside(s.x)), { 0, 1 },
                  absolute(5e-7, 4e-3, "absolute: taken from 1")),
        mediumRow("scatteredShare(vec3, vec3, float)", NUMERICS_CALL(scatteredShare(u, v, s.x)), { 0, 1.001 },
                  absolute(2e-6, 2e-2, "absolute: the light that is left, next to what is lost")),
        mediumRow("scatteredFromBehind(vec3, float, float)", NUMERICS_CALL(scatteredFromBehind(u, s.x, s.y)), { 0, 1 },
                  absolute(5e-7, 3e-3, "absolute: backward scattering is taken from 1")),
    };
    rows[0].u = colour("color", 1);
    rows[0].monotone = Monotone::Falling;
    rows[0].openOutside = "color -1 has the root of a negative number";
    rows[1].u = loss;
    rows[1].s = { anisotropy };
    rows[2].u = rows[3].u = depth;
    rows[2].monotone = rows[3].monotone = Monotone::Falling;
    rows[2].openOutside = rows[3].openOutside = "a depth below -1 divides by zero";
    rows[4].s = { ior() };
    rows[4].monotone = Monotone::Rising;
    rows[4].openOutside = "ior 0 and -1 divide by zero";
    rows[5].u = depth;
    rows[5].v = loss;
    rows[5].s = { ior() };
    rows[5].openOutside = "a loss beyond 1 returns less than nothing, and ior 0 divides by zero";
    rows[6].u = depth;
    rows[6].s = { anisotropy, ior() };
    rows[6].openOutside = "ior 0 and a depth of -1 divide by zero";
    return rows;
}

std::vector<Row> subsurfaceRows() {
    const Argument power = inHalf(number("power", 0, 1000), 0, 64), opacity = unit("opacity");
    const Argument nol = number("nol", -1, 1), lov = number("lov", -1, 1);
    return {
        { .file = "cloth",
          .function = "clothSheenColor(vec3)",
          .call = NUMERICS_CALL(clothSheenColor(u)),
          .u = colour("baseColor", 1),
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 2e-7,
                      .gpu = 2e-7,
                      .half = 1e-3,
                      .negligible = 1e-12,
                      .why = "a root; GPUs may take denormal numbers as 0" } },
        { .file = "cloth",
          .function = "clothScatterAlbedo(vec3)",
          .call = NUMERICS_CALL(clothScatterAlbedo(u)),
          .u = colour("subsurfaceColor", 1),
          .range = { 0.5, 1.001 },
          .monotone = Monotone::Rising,
          .limits = absolute(5e-7, 4e-3, "absolute: a polynomial of third degree") },
        { .file = "cloth",
          .function = "diffuseCloth(float, vec3)",
          .call = NUMERICS_CALL(diffuseCloth(s.x, u)),
          .s = { nol },
          .u = colour("subsurfaceColor", 1),
          .range = { 0, 0.213 },
          .monotone = Monotone::Rising,
          .limits = absolute(2e-7, 1e-3, "absolute: cancels where light just reaches") },
        { .file = "subsurface",
          .function = "subsurfaceOpacity(float)",
          .call = NUMERICS_CALL(subsurfaceOpacity(s.x)),
          .s = { number("thickness", 0, 100) },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(1e-6, 2e-3, "absolute: a power of 2 from 1") },
        { .file = "subsurface",
          .function = "subsurfaceForward(float, float)",
          .call = NUMERICS_CALL(subsurfaceForward(s.x, s.y)),
          .s = { lov, power },
          .range = { 0, 111 },
          .monotone = Monotone::Falling,
          .limits = { .cpp = 1e-4,
                      .gpu = 2e-4,
                      .half = 5e-2,
                      .negligible = 1e-2,
                      .why = "a power of up to 1000 times the rounding of the angle" },
          .openOutside = "overflow of the power" },
        { .file = "subsurface",
          .function = "subsurfaceScatter(float, float, float, float)",
          .call = NUMERICS_CALL(subsurfaceScatter(s.x, s.y, s.z, s.w)),
          .s = { nol, lov, opacity, power },
          .range = { 0, 56 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 1e-4,
                      .gpu = 2e-4,
                      .half = 5e-2,
                      .negligible = 1e-1,
                      .why = "the error of subsurfaceForward()" },
          .openOutside = "opacity 2 wraps to a division by zero" },
        { .file = "subsurface",
          .function = "subsurfaceDiffuseScaling(vec3, float)",
          .call = NUMERICS_CALL(subsurfaceDiffuseScaling(u, s.x)),
          .s = { opacity },
          .u = colour("subsurfaceColor", 1),
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(2e-7, 1e-3, "absolute: taken from 1") },
        { .file = "subsurface",
          .function = "subsurfaceForwardRoughness(float)",
          .call = NUMERICS_CALL(subsurfaceForwardRoughness(s.x)),
          .s = { power },
          .range = { 0.1, 1 },
          .monotone = Monotone::Falling,
          .limits = { .cpp = 1e-6, .gpu = 4e-6, .half = 5e-3, .why = "a power" } },
    };
}

} // namespace

std::vector<Row> scatterRows() {
    std::vector<Row> rows = specularRows();
    for (std::vector<Row> const& more : { directionRows(), transmissionRows(), mediumRows(), subsurfaceRows() })
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace filament_core::shader::numerics
