// SPDX-License-Identifier: Apache-2.0
/// The declarations generated from a material's lists: the MaterialParams block, samplers, constants and variables.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/compiler/GlslGenerator.h"
#include "shaders/compiler/MaterialDefinition.h"
#include "shaders/compiler/StageText.h"

namespace filament_core::shader {

/// The specialisation constants of <filament_core/Quality.h>: kQualityConstants of ShaderInterface.h.
void declareQuality(StageText& out);
/// Those of kVariantConstants of Package.h, for stages that several variants share.
void declareVariants(StageText& out);
/// Those of the first that unlit materials have.
void declareUnlitQuality(StageText& out);
/// Uniform block `materialParams`, textures `materialParams_name`, constants `materialConstants_name` (and, as in the
/// guide's text, `materialConstant_name`). With kVariantMerged the currentPixel textures are subpass inputs.
void declareInterface(StageText& out, MaterialDefinition const& definition, uint16_t variantKey = 0);
/// Whether the parameter is a subpass input of such a variant.
bool isSubpassInput(Parameter const& parameter, uint16_t variantKey);

/// `VARYING vec4 variable_name` from location 5 on, past that of the instance index; `VARYING` is defined by the stage.
void declareVariables(StageText& out, MaterialDefinition const& definition, MaterialNeeds const& needs);
/// What an effect writes, from this location on, and the macros with which shaders/post uses it.
void declareOutputs(StageText& out, MaterialDefinition const& definition, uint32_t firstLocation);
/// What a surface with outputs writes, and the macro with which outputs_main.glsl uses it.
void declareSurfaceOutputs(StageText& out, MaterialDefinition const& definition);
/// `materialParams_name` of ParameterSource::transformName.
void declareTransforms(StageText& out, MaterialDefinition const& definition);

/// Free locations for custom attributes on their way to the fragment stage.
std::vector<uint32_t> customLocations(MaterialDefinition const& definition, MaterialNeeds const& needs);
/// `VARYING vec4 vertex_customN`, and the macro with which surface/vertex_main.glsl writes them.
void declareCustomVaryings(StageText& out, MaterialDefinition const& definition, MaterialNeeds const& needs);

/// The macros with which surface/vertex_main.glsl clears and writes the variables.
void defineVariableMacros(StageText& out, MaterialDefinition const& definition);

} // namespace filament_core::shader
