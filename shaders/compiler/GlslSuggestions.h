// SPDX-License-Identifier: Apache-2.0
/// Makes the GLSL compiler's errors ones that authors can act on.
///   Out     one line for each line of the author's text that is wrong, in the order of the text: "file:line: reason",
///           with what was probably meant. Errors in the engine's text, which follow from the author's, disappear
///           behind those, or point to the author's block.
///   Limits  50 lines. Thread: any.
#pragma once

#include "base/Result.h"
#include "shaders/compiler/MaterialDefinition.h"

#include <span>

namespace filament_core::shader {

/// `error` may have several lines.
Error withSuggestion(Error const& error, MaterialDefinition const& definition);

/// All of them as one, without repetitions. There is at least one.
Error joined(std::span<const Error> errors);

} // namespace filament_core::shader
