// SPDX-License-Identifier: Apache-2.0
/// The layouts of the bind groups that the engine binds. They are fixed, whatever a shader reads, so that group 0,
/// which is bound once per view, stays bound across materials.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/package/Package.h"

namespace filament::shader {

/// Surface: every ViewBinding. PostProcess: FrameUniforms alone.
backend::BindGroupLayout viewGroupLayout(MaterialDomain domain = MaterialDomain::Surface);

/// Every DeformationBinding. Visible to the vertex stage only: uniforms visible to fragments are far more expensive to
/// re-bind.
backend::BindGroupLayout deformationGroupLayout();

/// The layout for the programs of a variant: that of the material, and group 2 if the variant deforms.
backend::ProgramLayout programLayout(backend::ProgramLayout const& material, uint16_t variantKey);

} // namespace filament::shader
