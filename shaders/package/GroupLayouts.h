// SPDX-License-Identifier: Apache-2.0
/// The layouts of the bind groups that the engine binds. They are fixed, whatever a shader reads, so that groups stay
/// bound across materials: every program has the same View group, and all programs of a kind the same Pass group.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/interface/SamplerBudget.h"
#include "shaders/package/Package.h"

namespace filament_core::shader {

PassKind passKind(MaterialPackage const& package);
/// Screen-space reflections or refraction.
bool readsScreen(MaterialPackage const& package);

/// Every ViewBinding.
backend::BindGroupLayout viewGroupLayout();

/// PassUniforms, and those of kEngineTextures that such materials read.
backend::BindGroupLayout passGroupLayout(PassKind kind);

/// Of the dispatch shaders/compute/fog_light.comp.
backend::ProgramLayout fogLightLayout();

/// Samplers that a group takes in the fragment stage.
uint32_t samplerCount(backend::BindGroupLayout const& group);

/// Every DeformationBinding. Of the vertex stage alone: uniforms that fragments see cost far more to bind again.
backend::BindGroupLayout deformationGroupLayout();

/// The layout for the programs of a variant: that of the package, with the Deformation group if the variant deforms,
/// and with subpass inputs instead of currentPixel textures if it is merged. These read colour attachments 0, 1, ... in
/// the order of the parameters.
backend::ProgramLayout programLayout(MaterialPackage const& package, uint16_t variantKey);

} // namespace filament_core::shader
