// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/table/Call.h"

namespace filament_core::shader::numerics {

std::vector<Row> mathRows() {
    constexpr std::string_view kSplit = "the split halves a 24-bit significand";
    constexpr std::string_view kPhase = "as a phase: the division and the sine round";
    const Argument any = inHalf(number("x", -3e38, 3e38), -65504, 65504);
    const Argument anyVector{ .name = "x", .kind = Kind::Colour, .low = -100, .high = 100 };
    return {
        { .file = "math",
          .function = "sq(float)",
          .call = NUMERICS_CALL(sq(s.x)),
          .s = { inHalf(number("x", -1e19, 1e19), -255, 255) },
          .range = { 0, kInfinity },
          .limits = { .cpp = 6e-8, .gpu = 6e-8, .half = 5e-4, .halfNegligible = 1e-4, .why = "one rounding" } },
        { .file = "math",
          .function = "pow5(float)",
          .call = NUMERICS_CALL(pow5(s.x)),
          .s = { unit("x") },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 3e-7,
                      .gpu = 3e-7,
                      .half = 3e-3,
                      .halfNegligible = 1e-2,
                      .why = "three roundings; in 16 bits x^4 becomes denormal below x = 0.09" } },
        { .file = "math",
          .function = "oneMinusExp(float)",
          .call = NUMERICS_CALL(oneMinusExp(s.x)),
          .s = { inHalf(number("x", 0, 1e30), 0, 65504) },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .cpp = 3e-7,
                      .gpu = 1e-6,
                      .half = 4e-3,
                      .why = "below 1/8 a series without cancellation, above it 1 - e^-x loses three bits" },
          .openOutside = "the power of e overflows for negative numbers" },
        { .file = "math",
          .function = "productError(float, float)",
          .call = NUMERICS_CALL(productError(s.x, s.y) / (s.x * s.y)),
          .s = { number("a", 1e-15, 1e15), number("b", 1e-15, 1e15) },
          .range = { -0x1p-24, 0x1p-24 },
          .noError = "what 32 bits round off is no error of 64 bits",
          .fp32Only = kSplit,
          .openOutside = "a product below the normal numbers has no exact error" },
        { .file = "math",
          .function = "moduloStep(float, float)",
          .call = NUMERICS_CALL(onCircle(vec2(moduloStep(s.x, s.y), s.y))),
          .s = { number("x", 0, 1e7), number("modulus", 0.1, 1e4) },
          .range = { -1, 1 },
          .limits = absolute(2e-6, 0, kPhase),
          .fp32Only = kSplit },
        { .file = "math",
          .function = "timeModulo(float, float, float)",
          .call = NUMERICS_CALL(onCircle(vec2(timeModulo(s.x, s.y, s.z), s.z))),
          .s = { number("seconds", 0, 1e7), number("rest", -0.5, 0.5), number("modulus", 0.1, 1e4) },
          .range = { -1, 1 },
          .limits = absolute(4e-6, 0, "as a phase, and `rest` may be five times the modulus"),
          .fp32Only = kSplit },
        { .file = "math",
          .function = "saturate(float)",
          .call = NUMERICS_CALL(saturate(s.x)),
          .s = { any },
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .gpu = 1e-9, .why = "exact, but GPUs may take denormal numbers as 0" } },
        { .file = "math",
          .function = "saturate(vec3)",
          .call = NUMERICS_CALL(saturate(u)),
          .u = anyVector,
          .range = { 0, 1 },
          .monotone = Monotone::Rising,
          .limits = { .gpu = 1e-9, .why = "exact, but GPUs may take denormal numbers as 0" } },
    };
}

} // namespace filament_core::shader::numerics
