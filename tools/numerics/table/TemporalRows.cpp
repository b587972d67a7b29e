// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kLuminance = "a sum of three products";
constexpr std::string_view kFromHalves = "the colours of the history are fp16 already, and its weights need more";

} // namespace

std::vector<Row> temporalRows() {
    return {
        { .file = "temporal",
          .function = "finiteLight(float)",
          .call = NUMERICS_CALL(finiteLight(s.x)),
          .s = { number("light", -3e38, 3e38) },
          .range = { 0, 65504 },
          .monotone = Monotone::Rising,
          .limits = relative(1e-9, 0, "exact; the smallest numbers become 0"),
          .fp32Only = kFromHalves },
        { .file = "temporal",
          .function = "finiteLight(vec4)",
          .call = NUMERICS_CALL(vec3(finiteLight(vec4(s)))),
          .s = { number("r", -3e38, 3e38), number("g", -3e38, 3e38), number("b", -3e38, 3e38) },
          .range = { 0, 65504 },
          .limits = relative(1e-9, 0, "exact; the smallest numbers become 0"),
          .fp32Only = kFromHalves },
        { .file = "temporal",
          .function = "compressedLight(vec3)",
          .call = NUMERICS_CALL(compressedLight(u)),
          .u = colour("light", 65504),
          .range = { 0, 13.9 },
          .limits = relative(1e-6, 0, kLuminance),
          .fp32Only = kFromHalves },
        { .file = "temporal",
          .function = "expandedLight(vec3)",
          .call = NUMERICS_CALL(expandedLight(u)),
          .u = colour("compressed", 1),
          .range = { 0, 65504 },
          .noError = "near white it is as steep as the compression is flat",
          .fp32Only = kFromHalves },
        { .file = "temporal",
          .function = "ycocgFromLight(vec3)",
          .call = NUMERICS_CALL(ycocgFromLight(u)),
          .u = colour("light", 14),
          .range = { -7, 14 },
          .limits = absolute(5e-6, 0, "differences cancel"),
          .fp32Only = kFromHalves },
        { .file = "temporal",
          .function = "lightFromYcocg(vec3)",
          .call = NUMERICS_CALL(lightFromYcocg(u)),
          .u = colour("color", 14),
          .range = { -28, 28 },
          .limits = absolute(1e-5, 0, "differences cancel"),
          .fp32Only = kFromHalves },
    };
}

} // namespace filament_core::shader::numerics
