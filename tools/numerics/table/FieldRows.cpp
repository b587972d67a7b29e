// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {
namespace {

constexpr std::string_view kThinBoxes = "1 / half a side of a thin box is beyond half floats";

} // namespace

std::vector<Row> fieldRows() {
    return {
        { .file = "field",
          .function = "fieldPlace(vec3, vec3)",
          .call = NUMERICS_CALL(fieldPlace(u, v)),
          .u = { .name = "fromCenter", .kind = Kind::Offset, .low = 0, .high = 1e4 },
          .v = { .name = "inverseHalf", .kind = Kind::Colour, .low = 1e-4, .high = 1e6 },
          .range = { -1, 1 },
          .limits = { .cpp = 1e-6, .gpu = 1e-6, .negligible = 1, .why = "absolute: near the middle it is small" },
          .fp32Only = kThinBoxes },
        { .file = "field",
          .function = "fieldValue(vec4, vec3)",
          .call = NUMERICS_CALL(fieldValue(vec4(u, s.x), v)),
          .s = { number("middle", 0, 1e4) },
          .u = { .name = "change", .kind = Kind::Offset, .low = 0, .high = 1e4 },
          .v = direction("place"),
          .range = { -2e4, 4e4 },
          .limits = { .cpp = 1e-6, .gpu = 1e-6, .negligible = 4e4, .why = "absolute: a sum may cancel" },
          .fp32Only = kThinBoxes },
    };
}

} // namespace filament_core::shader::numerics
