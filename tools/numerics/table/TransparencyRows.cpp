// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kSums = "weights are ratios of distances, and sums of them reach the ends of 16 bits";

} // namespace

std::vector<Row> transparencyRows() {
    return {
        { .file = "transparency",
          .function = "transparencyWeight(float, float)",
          .call = NUMERICS_CALL(transparencyWeight(s.x, s.y)),
          .s = { number("distance", 1e-3, 1e6), number("nearest", 1e-3, 1e6) },
          .range = { 0.000244140625, 1 },
          .monotone = Monotone::Falling,
          .limits = relative(2e-7, 0, "a division"),
          .fp32Only = kSums },
        { .file = "transparency",
          .function = "countedAlpha(float)",
          .call = NUMERICS_CALL(countedAlpha(s.x)),
          .s = { number("alpha", -10, 10) },
          .range = { 0.0009765625, 1 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-9, 0, "exact"),
          .fp32Only = kSums },
        { .file = "transparency",
          .function = "boundedSum(vec3)",
          .call = NUMERICS_CALL(boundedSum(u)),
          .u = colour("light", 3e38),
          .range = { -65504, 65504 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-9, 0, "exact; the smallest numbers become 0"),
          .fp32Only = kSums },
        { .file = "transparency",
          .function = "weightedSurface(vec4, float)",
          .part = "light",
          .call = NUMERICS_CALL(vec3(weightedSurface(vec4(u, s.x), s.y))),
          .s = { unit("alpha"), number("weight", 0.000244140625, 1) },
          .u = colour("light", 65504),
          .range = { 0, 65504 },
          .limits = relative(2e-7, 0, "a product"),
          .fp32Only = kSums },
        { .file = "transparency",
          .function = "weightedSurface(vec4, float)",
          .part = "alpha",
          .call = NUMERICS_CALL(weightedSurface(vec4(u, s.x), s.y).w),
          .s = { unit("alpha"), number("weight", 0.000244140625, 1) },
          .u = colour("light", 65504),
          .range = { 3.8e-6, 16 },
          .monotone = Monotone::Rising,
          .limits = relative(2e-7, 0, "a product"),
          .fp32Only = kSums },
        { .file = "transparency",
          .function = "weightedMean(vec4, float)",
          .call = NUMERICS_CALL(vec3(weightedMean(vec4(u, s.x), s.y))),
          .s = { number("alphas", 0x1p-24, 65504), number("cover", 0.0009765625, 1) },
          .u = colour("light", 65504),
          .range = { 0, 65504 },
          .limits = relative(4e-7, 0, "a division and two products"),
          .fp32Only = kSums },
    };
}

} // namespace filament_core::shader::numerics
