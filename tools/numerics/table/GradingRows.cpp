// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kStops = "scene-referred light has more stops than 16 bits have digits";
constexpr std::string_view kCancels = "differences of colours cancel";
constexpr std::string_view kPower = "a power: the error of log2 and exp2";

std::vector<Row> logarithmRows() {
    return {
        { .file = "grading",
          .function = "gradingLog(float)",
          .call = NUMERICS_CALL(gradingLog(s.x)),
          .s = { number("x", 0, 65504) },
          .range = { 0.07, 1.5 },
          .monotone = Monotone::Rising,
          .limits = absolute(1e-6, 0, "the rounding of a logarithm"),
          .fp32Only = kStops },
        { .file = "grading",
          .function = "gradingLog(vec3)",
          .call = NUMERICS_CALL(gradingLog(u)),
          .u = colour("x", 65504),
          .range = { 0.07, 1.5 },
          .limits = absolute(1e-6, 0, "the rounding of a logarithm"),
          .fp32Only = kStops },
        { .file = "grading",
          .function = "lightFromGradingLog(float)",
          .call = NUMERICS_CALL(lightFromGradingLog(s.x)),
          .s = { number("x", 0, 1.5) },
          .range = { -0.01, 65536 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 2e-5, .gpu = 2e-5, .negligible = 1e-3, .why = "an exponent up to 16 is rounded" },
          .fp32Only = kStops },
        { .file = "grading",
          .function = "lightFromGradingLog(vec3)",
          .call = NUMERICS_CALL(lightFromGradingLog(u)),
          .u = colour("x", 1.5),
          .range = { -0.01, 65536 },
          .limits = { .cpp = 2e-5, .gpu = 2e-5, .negligible = 1e-3, .why = "an exponent up to 16 is rounded" },
          .fp32Only = kStops },
    };
}

std::vector<Row> colourRows() {
    return {
        { .file = "grading",
          .function = "rec709FromRec2020(vec3)",
          .call = NUMERICS_CALL(rec709FromRec2020(u)),
          .u = colour("x", 100),
          .range = { -80, 200 },
          .limits = absolute(4e-5, 0, kCancels),
          .fp32Only = kStops },
        { .file = "grading",
          .function = "luminanceOfRec2020(vec3)",
          .call = NUMERICS_CALL(luminanceOfRec2020(u)),
          .u = colour("x", 65504),
          .range = { 0, 65505 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-6, 0, "a sum of three products"),
          .fp32Only = kStops },
        { .file = "grading",
          .function = "tonalBalance(vec3, vec3, vec3, vec3, vec4)",
          .call = NUMERICS_CALL(tonalBalance(u, vec3(s.x), vec3(s.y), vec3(s.z), vec4(0.0f, 0.333f, 0.55f, 1.0f))),
          .s = { number("shadows", 0, 4), number("midtones", 0, 4), number("highlights", 0, 4) },
          .u = colour("light", 100),
          .range = { 0, 401 },
          .limits = { .cpp = 1e-5, .gpu = 1e-5, .negligible = 1e-2, .why = "weights that sum to 1 cancel" },
          .fp32Only = kStops },
        { .file = "grading",
          .function = "slopeOffsetPower(vec3, vec3, vec3, vec3)",
          .call = NUMERICS_CALL(slopeOffsetPower(u, vec3(s.x), vec3(s.y), vec3(s.z))),
          .s = { number("slope", 0, 4), number("offset", -1, 1), number("power", 0.1, 10) },
          .u = colour("x", 1.5),
          .range = { 0, 3e8 },
          .limits = { .cpp = 2e-4, .gpu = 2e-4, .negligible = 1e-2, .why = kPower },
          .fp32Only = kStops },
        { .file = "grading",
          .function = "contrasted(vec3, float)",
          .call = NUMERICS_CALL(contrasted(u, s.x)),
          .s = { number("contrast", 0, 2) },
          .u = colour("x", 1.5),
          .range = { -0.5, 3 },
          .limits = absolute(1e-6, 0, kCancels),
          .fp32Only = kStops },
        { .file = "grading",
          .function = "saturated(vec3, float, float)",
          .call = NUMERICS_CALL(saturated(u, s.x, s.y)),
          .s = { number("saturation", 0, 3), number("vibrance", 0, 3) },
          .u = colour("light", 100),
          .range = { 0, 1000 },
          .limits = absolute(2e-4, 0, kCancels),
          .fp32Only = kStops },
        { .file = "grading",
          .function = "gradingCurve(float, float, float, float)",
          .call = NUMERICS_CALL(gradingCurve(s.x, s.y, s.z, s.w)),
          .s = { number("x", 1e-20, 100), number("shadowGamma", 0.1, 10), number("midPoint", 1e-3, 100),
                 number("highlightScale", 0, 10) },
          .range = { 0, 1001 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 2e-4, .gpu = 2e-4, .negligible = 1e-3, .why = kPower },
          .fp32Only = kStops,
          .openOutside = "negative light has no power" },
        { .file = "grading",
          .function = "withinGamut(vec3)",
          .call = NUMERICS_CALL(withinGamut(u)),
          .u = { .name = "light", .kind = Kind::Colour, .low = -100, .high = 100 },
          .range = { 0, 1e4 },
          .noError = "luminance cancels where a component is negative",
          .fp32Only = kStops },
        { .file = "grading",
          .function = "graded(vec3, Grading)",
          .call = NUMERICS_CALL(graded(u, neutralGrading())),
          .u = colour("light", 100),
          .range = { 0, 101 },
          .limits = { .cpp = 1e-3,
                      .gpu = 1e-3,
                      .negligible = 1,
                      .why = "a logarithm there and back, and cancellation" },
          .fp32Only = kStops },
    };
}

std::vector<Row> exposureRows() {
    constexpr std::string_view kCounts = "16 bits cannot count the pixels of a picture";
    return {
        { .file = "exposure",
          .function = "binOfStops(float)",
          .call = NUMERICS_CALL(binOfStops(s.x)),
          .s = { number("stops", -30, 30) },
          .range = { 0, 64 },
          .monotone = Monotone::Rising,
          .limits = absolute(1e-5, 0, "a sum"),
          .fp32Only = kCounts },
        { .file = "exposure",
          .function = "stopsOfBin(float)",
          .call = NUMERICS_CALL(stopsOfBin(s.x)),
          .s = { number("bin", 0, 63) },
          .range = { -12, 12 },
          .monotone = Monotone::Rising,
          .limits = absolute(1e-5, 0, "a sum"),
          .fp32Only = kCounts },
        { .file = "exposure",
          .function = "countBetween(float, float, float, float)",
          .call = NUMERICS_CALL(countBetween(s.x, s.y, s.z, s.w)),
          .s = { number("before", 0, 20'000), number("count", 0, 20'000), number("low", 0, 20'000),
                 number("high", 0, 20'000) },
          .range = { 0, 20'000 },
          .limits = absolute(4e-3, 0, "differences of counts cancel"),
          .fp32Only = kCounts },
    };
}

} // namespace

std::vector<Row> gradingRows() {
    std::vector<Row> rows = logarithmRows();
    for (std::vector<Row> const& more : { colourRows(), exposureRows() })
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace filament_core::shader::numerics
