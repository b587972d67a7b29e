// SPDX-License-Identifier: Apache-2.0
/// DefinitionRules: rules that involve several properties: contradictions, and the number of samplers.
///   Thread  any. Fails: InvalidArgument at the line of the offending property, with the cure.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

namespace filament_core::shader {

Result<void> checkRules(MaterialDefinition const& definition);

/// Materials that are unlit or have no specular do not reflect the screen: the property is ignored, with a warning.
/// One text can so serve several shading models (Filament's glTF materials do that).
void leaveOutReflections(MaterialDefinition& definition);

/// Materials guide, table 13 and chapter 7: by feature level, shading model and filter. Below level 3 it is what
/// shaders/interface/SamplerBudget.h leaves to a material that every device can draw, or less.
uint32_t samplerBudget(MaterialDefinition const& definition);

} // namespace filament_core::shader
