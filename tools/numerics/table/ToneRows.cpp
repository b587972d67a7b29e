// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kStops = "scene-referred light has more stops than 16 bits have digits";
constexpr std::string_view kSum = "a sum of three products";
constexpr std::string_view kPower = "a power: the error of log2 and exp2";
constexpr std::string_view kCancels = "powers of a polynomial whose terms cancel";

Argument anyLight() { return { .name = "light", .kind = Kind::Colour, .low = -3e38, .high = 3e38 }; }

/// toneMapped() with one of its mappers.
Row mappedRow(std::string_view part, Call call, Monotone monotone = Monotone::Rising) {
    return { .file = "tone",
             .function = "toneMapped(vec3, ToneSettings)",
             .part = part,
             .call = call,
             .u = anyLight(),
             .range = { 0, 1 },
             .monotone = monotone,
             .limits = absolute(2e-5, 0, kCancels),
             .fp32Only = kStops };
}

/// displayColor() of one space.
Row displayRow(std::string_view part, Call call) {
    return { .file = "tone",
             .function = "displayColor(vec3, ToneSettings)",
             .part = part,
             .call = call,
             .u = anyLight(),
             .range = { 0, 1 },
             .monotone = Monotone::Rising,
             .limits = absolute(4e-5, 0, kPower),
             .fp32Only = kStops };
}

std::vector<Row> agxRows() {
    return {
        { .file = "tone",
          .function = "agxContrast(float)",
          .call = NUMERICS_CALL(agxContrast(s.x)),
          .s = { unit("x") },
          .range = { -0.01, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(1e-5, 0, "terms of up to 40 cancel"),
          .fp32Only = kStops },
        { .file = "tone",
          .function = "agxLog(float)",
          .call = NUMERICS_CALL(agxLog(s.x)),
          .s = { number("x", 0, 65504) },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(3e-6, 0, "the rounding of a logarithm"),
          .fp32Only = kStops },
        { .file = "tone",
          .function = "toneMapAgx(vec3, int)",
          .call = NUMERICS_CALL(toneMapAgx(u, int(s.x))),
          .s = { integer("mapper", 9, 10) },
          .u = colour("x", 1e4),
          .range = { 0, 3 },
          .limits = absolute(2e-4, 0, kCancels),
          .fp32Only = kStops },
    };
}

std::vector<Row> curveRows() {
    return {
        { .file = "tone",
          .function = "displayWeight(float, float, float)",
          .call = NUMERICS_CALL(displayWeight(s.x, s.y, s.z)),
          .s = { number("brightest", 0, 65504), number("alpha", 6e-8, 1), number("perHalfWhite", 0.01, 100) },
          .range = { 0, 1 },
          .limits = relative(1e-6, 0, "a sum and a division"),
          .fp32Only = kStops },
        { .file = "tone",
          .function = "toneMapPbrNeutral(vec3)",
          .call = NUMERICS_CALL(toneMapPbrNeutral(u)),
          .u = colour("x", 1e4),
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(2e-5, 0, "the least component is taken off twice"),
          .fp32Only = kStops,
          .openOutside = "negative light has a negative offset" },
        { .file = "tone",
          .function = "toneMapGeneric(vec3, vec4)",
          .call = NUMERICS_CALL(toneMapGeneric(u, vec4(1.5f, 1.0625f, 0.5f, 8.0f))),
          .u = colour("x", 1e4),
          .range = { 0, 1.1 },
          .monotone = Monotone::Rising,
          .limits = absolute(1e-5, 0, kPower),
          .fp32Only = kStops,
          .openOutside = "negative light has no power" },
        { .file = "tone",
          .function = "displayRangeColor(int)",
          .call = NUMERICS_CALL(displayRangeColor(int(s.x))),
          .s = { integer("stop", -1, 16) },
          .range = { 0, 1 },
          .limits = absolute(1e-7, 0, "exact"),
          .fp32Only = kStops },
        { .file = "tone",
          .function = "toneMapDisplayRange(vec3)",
          .call = NUMERICS_CALL(toneMapDisplayRange(u)),
          .u = colour("x", 65504),
          .range = { 0, 1 },
          .limits = absolute(1e-5, 0, "the rounding of a logarithm"),
          .fp32Only = kStops },
    };
}

std::vector<Row> mappedRows() {
    return {
        mappedRow("linear", NUMERICS_CALL(toneMapped(u, toneSettings(kToneMapLinear, vec4(0.0f), 0, 0.0f)))),
        mappedRow("AgX", NUMERICS_CALL(toneMapped(u, toneSettings(kToneMapAgx, vec4(0.0f), 0, 0.0f)))),
        mappedRow("golden", NUMERICS_CALL(toneMapped(u, toneSettings(kToneMapAgxGolden, vec4(0.0f), 0, 0.0f))),
                  Monotone::No),
        mappedRow("punchy", NUMERICS_CALL(toneMapped(u, toneSettings(kToneMapAgxPunchy, vec4(0.0f), 0, 0.0f))),
                  Monotone::No),
        mappedRow("neutral", NUMERICS_CALL(toneMapped(u, toneSettings(kToneMapPbrNeutral, vec4(0.0f), 0, 0.0f)))),
        mappedRow("generic", NUMERICS_CALL(toneMapped(
                                     u, toneSettings(kToneMapGeneric, vec4(1.5f, 1.0625f, 0.5f, 8.0f), 0, 0.0f)))),
        mappedRow("range", NUMERICS_CALL(toneMapped(u, toneSettings(kToneMapDisplayRange, vec4(0.0f), 0, 0.0f))),
                  Monotone::No),
        { .file = "tone",
          .function = "toneMappedIncludesTransfer(int)",
          .call = NUMERICS_CALL(toneMappedIncludesTransfer(int(s.x))),
          .s = { integer("mapper", 0, 10) },
          .range = { 0, 1 },
          .limits = { .why = "exact" } },
    };
}

std::vector<Row> spaceRows() {
    return {
        { .file = "tone",
          .function = "pqFromLinear(float)",
          .call = NUMERICS_CALL(pqFromLinear(s.x)),
          .s = { unit("x") },
          .range = { 0, 1.00001 },
          .monotone = Monotone::Rising,
          .limits = absolute(2e-5, 0, "a power of 79 of a rounded number"),
          .fp32Only = kStops },
        { .file = "tone",
          .function = "pqFromLinear(vec3)",
          .call = NUMERICS_CALL(pqFromLinear(u)),
          .u = colour("x", 1),
          .range = { 0, 1.00001 },
          .monotone = Monotone::Rising,
          .limits = absolute(2e-5, 0, "a power of 79 of a rounded number"),
          .fp32Only = kStops },
        { .file = "tone",
          .function = "displayP3FromRec709(vec3)",
          .call = NUMERICS_CALL(displayP3FromRec709(u)),
          .u = colour("x", 1e4),
          .range = { 0, 10'001 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-6, 0, kSum),
          .fp32Only = kStops },
        { .file = "tone",
          .function = "rec2020FromRec709(vec3)",
          .call = NUMERICS_CALL(rec2020FromRec709(u)),
          .u = colour("x", 1e4),
          .range = { 0, 10'001 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-6, 0, kSum),
          .fp32Only = kStops },
        { .file = "tone",
          .function = "encodedForDisplay(vec3, ToneSettings)",
          .call = NUMERICS_CALL(encodedForDisplay(u, toneSettings(0, vec4(0.0f), int(s.x), 0.015625f))),
          .s = { integer("space", 0, 3) },
          .u = { .name = "color", .kind = Kind::Colour, .low = -1e4, .high = 1e4 },
          .range = { 0, 1.00001 },
          .limits = absolute(4e-5, 0, kPower),
          .fp32Only = kStops },
        displayRow("sRGB", NUMERICS_CALL(displayColor(u, toneSettings(kToneMapAces, vec4(0.0f), 0, 0.0f)))),
        displayRow("P3", NUMERICS_CALL(displayColor(u, toneSettings(kToneMapFilmic, vec4(0.0f), 2, 0.0f)))),
        displayRow("PQ", NUMERICS_CALL(displayColor(u, toneSettings(kToneMapMobile, vec4(0.0f), 3, 0.015625f)))),
        { .file = "tone",
          .function = "displayColor(vec3, ToneSettings)",
          .part = "HDR",
          .call = NUMERICS_CALL(displayColor(u, toneSettings(kToneMapLinear, vec4(0.0f), 3, 0.015625f))),
          .u = anyLight(),
          .range = { 0, 1.00001 },
          .monotone = Monotone::Rising,
          .limits = absolute(4e-5, 0, kPower),
          .fp32Only = kStops },
    };
}

std::vector<Row> nightRows() {
    return {
        { .file = "grading",
          .function = "nightVision(vec3, float)",
          .call = NUMERICS_CALL(nightVision(u, s.x)),
          .s = { unit("amount") },
          .u = colour("light", 100),
          .range = { -30, 300 },
          .limits = { .cpp = 1e-5, .gpu = 1e-5, .negligible = 1e-2, .why = "gains of opposite signs cancel" },
          .fp32Only = kStops,
          .openOutside = "negative light has no gain" },
    };
}

} // namespace

std::vector<Row> toneRows() {
    std::vector<Row> rows = agxRows();
    for (std::vector<Row> const& more : { curveRows(), mappedRows(), spaceRows(), nightRows() })
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace filament_core::shader::numerics
