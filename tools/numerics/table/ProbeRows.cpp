// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kKilometres = "positions reach kilometres";

Argument offset(std::string_view name, double high) {
    return { .name = name, .kind = Kind::Offset, .low = 0, .high = high };
}

} // namespace

std::vector<Row> probeRows() {
    return {
        { .file = "probes",
          .function = "probeWeight(vec3, vec3, float)",
          .call = NUMERICS_CALL(probeWeight(u, v, s.x)),
          .s = { number("inverseBlend", 1e-9, 1e6) },
          .u = offset("local", 1e6),
          .v = colour("halfExtent", 1e3),
          .range = { 0, 1 },
          .noError = "a step where the blend distance is short",
          .fp32Only = kKilometres },
        { .file = "probes",
          .function = "probeShare(float, float)",
          .call = NUMERICS_CALL(probeShare(s.x, s.y)),
          .s = { unit("weight"), unit("left") },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = absolute(1e-9, 1e-6, "one of the two, or 0 for a denormal number"),
          .openOutside = "the result is one of the arguments" },
        { .file = "probes",
          .function = "probeRayLength(vec3, vec3, vec3)",
          .call = NUMERICS_CALL(probeRayLength(u, v, vec3(s.x, s.y, s.z))),
          .s = { number("width", 0, 1e3), number("height", 0, 1e3), number("depth", 0, 1e3) },
          .u = offset("local", 1e6),
          .v = direction("direction"),
          .range = { 0, 2e6 },
          .noError = "on a face the distance to it cancels",
          .fp32Only = kKilometres },
        { .file = "probes",
          .function = "probeDirection(vec3, vec3, float)",
          .call = NUMERICS_CALL(probeDirection(u, v, s.x)),
          .s = { number("rayLength", 0, 1e6) },
          .u = offset("fromCapture", 1e6),
          .v = direction("direction"),
          .range = { -2.01e6, 2.01e6 },
          .limits = { .cpp = 1e-6, .gpu = 1e-6, .negligible = 2e6, .why = "absolute: a sum may cancel" },
          .fp32Only = kKilometres },
    };
}

} // namespace filament_core::shader::numerics
