// SPDX-License-Identifier: Apache-2.0
/// GlslSuggestions: "did you mean" for the errors of the GLSL compiler, which knows no names of materials.
///   Thread  any. Fails: never; an error about nothing that a material declares stays as it is.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

namespace filament::shader {

/// For misspelt members of MaterialInputs, parameters, constants and variables.
Error withSuggestion(Error error, MaterialDefinition const& definition);

} // namespace filament::shader
