// SPDX-License-Identifier: Apache-2.0
/// DefinitionRules: rules that involve several properties: contradictions, and the number of samplers.
///   Thread  any. Fails: InvalidArgument at the line of the offending property, with the cure.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

namespace filament::shader {

Result<void> checkRules(MaterialDefinition const& definition);

/// Materials guide, 13 and 7: by feature level, shading model and filter; never more than a fragment stage of 16
/// textures has room for beside those of the view.
uint32_t samplerBudget(MaterialDefinition const& definition);

} // namespace filament::shader
