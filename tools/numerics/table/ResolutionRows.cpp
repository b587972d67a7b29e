// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kSteep = "the inverse is steep near 1: 16 bits leave bright light no digits";
constexpr std::string_view kWeights = "sums of products up to 2.5 cancel: the error is absolute";

} // namespace

std::vector<Row> resolutionRows() {
    return {
        { .file = "resolution",
          .function = "catmullRomWeights(float)",
          .part = "of the first three",
          .call = NUMERICS_CALL(vec3(catmullRomWeights(s.x))),
          .s = { unit("f") },
          .range = { -0.075, 1.002 },
          .limits = absolute(4e-7, 3e-3, kWeights) },
        { .file = "resolution",
          .function = "catmullRomWeights(float)",
          .part = "of the last",
          .call = NUMERICS_CALL(catmullRomWeights(s.x).w),
          .s = { unit("f") },
          .range = { -0.075, 1e-7 },
          .limits = absolute(4e-7, 3e-3, kWeights) },
        { .file = "resolution",
          .function = "boundedLight(vec3)",
          .call = NUMERICS_CALL(boundedLight(u)),
          .u = colour("light", 65504),
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = relative(3e-7, 0, "a sum and a division"),
          .fp32Only = kSteep },
        { .file = "resolution",
          .function = "lightFromBounded(vec3)",
          .call = NUMERICS_CALL(lightFromBounded(u)),
          .u = colour("bounded", 1),
          .range = { 0, 65504 },
          .monotone = Monotone::Rising,
          .noError = "near 1 it is as steep as its inverse is flat",
          .fp32Only = kSteep },
        { .file = "resolution",
          .function = "monotony(float, float, float)",
          .call = NUMERICS_CALL(monotony(s.x, s.y, s.z)),
          .s = { unit("before"), unit("here"), unit("after") },
          .range = { 0, 1 },
          .noError = "a quotient of differences that may both vanish" },
        { .file = "resolution",
          .function = "edgeShape(float, float, float)",
          .call = NUMERICS_CALL(edgeShape(s.x, s.y, s.z)),
          .s = { number("gradientX", -1, 1), number("gradientY", -1, 1), unit("edge") },
          .range = { 0.2099, 2.0001 },
          .limits = relative(1e-6, 4e-3, "a division and a few products") },
        { .file = "resolution",
          .function = "edgeKernel(float, float)",
          .part = "within the radius",
          .call = NUMERICS_CALL(edgeKernel(s.x, s.y)),
          .s = { number("x", 0, 2), number("lobe", 0.21, 0.5) },
          .range = { -0.25, 1.001 },
          .limits = absolute(1e-6, 5e-3, "squares of differences that cancel at the zeros: the error is absolute") },
        { .file = "resolution",
          .function = "sharpeningWeight(vec3, vec3)",
          .call = NUMERICS_CALL(sharpeningWeight(u * v, v)),
          .u = colour("least / most", 1),
          .v = colour("most", 1),
          .range = { -0.1875, 0 },
          .limits = absolute(2e-5, 5e-2,
                             "1 - most and 1 - least cancel near white, and there are few digits near black") },
        { .file = "resolution",
          .function = "sampleShare(float, float)",
          .call = NUMERICS_CALL(sampleShare(s.x, s.y)),
          .s = { number("away", -2, 2), number("ramp", 0.0625, 0.5) },
          .range = { 0, 1 },
          .limits = absolute(2e-6, 2e-2, "a difference, magnified by the narrowest ramp") },
    };
}

} // namespace filament_core::shader::numerics
