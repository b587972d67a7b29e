// SPDX-License-Identifier: Apache-2.0
/// DefinitionRules: what no single property can say of a material: contradictions, and how many samplers it may have.
///   Thread  any. Fails: InvalidArgument at the line of the property that asks too much, with the cure.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

namespace filament::shader {

Result<void> checkRules(MaterialDefinition const& definition);

/// Materials guide, 13 and 7: by feature level, shading model and filter; never more than a fragment stage of 16
/// textures has room for beside those of the view.
uint32_t samplerBudget(MaterialDefinition const& definition);

} // namespace filament::shader
