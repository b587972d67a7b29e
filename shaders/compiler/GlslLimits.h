// SPDX-License-Identifier: Apache-2.0
/// checkGlslLimits: refuses text that glslang or the optimiser could only compile with gigabytes of memory or of stack:
/// they recurse once per operator of an expression and per block, expand macros without a limit, and inline all calls.
///   In      the text of one stage, with its macros; #line directives name the author's lines.
///   Method  estimates from above, without expanding: a macro counts with the size of its expansion, of its arguments
///           as often as its body repeats them; a function with the sizes of those that it calls.
///   Thread  any. Memory: the tokens of the macros.
///   Limits  kMaxNesting brackets, kMaxDepth operators and else along one path of a syntax tree, kMaxTokens after
///           expansion, kMaxInlined after inlining. Does not see what the preprocessor pastes together with ##.
///   Fails   InvalidArgument, "file:line: reason and cure".
///   Cost    about 1 ms for 100 KB.
#pragma once

#include "base/Result.h"

#include <cstdint>
#include <string_view>

namespace filament_core::shader {

/// glslang takes about 500 bytes of stack per operator, and a thread has 8 MiB. The largest values of the engine's and
/// the samples' materials are 27 operators, 14'900 tokens and 14'300 after inlining.
inline constexpr uint64_t kMaxNesting = 200, kMaxDepth = 3000, kMaxTokens = 1'000'000, kMaxInlined = 2'000'000;

Result<void> checkGlslLimits(std::string_view glsl, std::string_view name);

} // namespace filament_core::shader
