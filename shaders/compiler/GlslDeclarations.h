// SPDX-License-Identifier: Apache-2.0
/// The declarations generated from a material's lists: the MaterialParams block, samplers, constants and variables.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"
#include "shaders/compiler/StageText.h"

namespace filament::shader {

/// Uniform block `materialParams`, textures `materialParams_name`, constants `materialConstants_name` (and, as in the
/// guide's text, `materialConstant_name`).
/// The specialisation constants of <filament/Quality.h>: kQualityConstants of ShaderInterface.h.
void declareQuality(StageText& out);
void declareInterface(StageText& out, MaterialDefinition const& definition);

/// `VARYING vec4 variable_name` from location 5 on; `VARYING` is defined by the stage.
void declareVariables(StageText& out, MaterialDefinition const& definition);

/// The macros with which surface/vertex_main.glsl clears and writes the variables.
void defineVariableMacros(StageText& out, MaterialDefinition const& definition);

} // namespace filament::shader
