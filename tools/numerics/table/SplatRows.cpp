// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kEdge = "in 16 bits the edge shows";

} // namespace

std::vector<Row> splatRows() {
    return {
        { .file = "splats",
          .function = "splatAlpha(float, vec2)",
          .part = "inside",
          .call = NUMERICS_CALL(splatAlpha(s.x, vec2(s.y, s.z))),
          .s = { unit("opacity"), number("x", -2, 2), number("y", -2.2, 2.2) },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = relative(8e-7, 0, "an exponential of up to 4.5, and a product"),
          .fp32Only = kEdge },
        { .file = "splats",
          .function = "splatMean(vec4)",
          .call = NUMERICS_CALL(splatMean(vec4(u, s.x))),
          .s = { number("cover", 1e-6, 1) },
          .u = colour("sums", 64),
          .range = { 0, 6.5e7 },
          .limits = { .cpp = 2e-7, .gpu = 2e-7, .negligible = 1e-25, .why = "a division; the smallest sums become 0" },
          .fp32Only = "sums reach the ends of 16 bits" },
    };
}

} // namespace filament_core::shader::numerics
