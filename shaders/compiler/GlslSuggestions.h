// SPDX-License-Identifier: Apache-2.0
/// GlslSuggestions: "did you mean" for errors of the GLSL compiler, which does not know the names of materials.
///   Thread  any. Fails: never; other errors are not changed.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

namespace filament::shader {

/// For misspelt members of MaterialInputs, parameters, constants and variables.
Error withSuggestion(Error error, MaterialDefinition const& definition);

} // namespace filament::shader
