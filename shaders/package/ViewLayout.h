// SPDX-License-Identifier: Apache-2.0
/// The shapes of the bind groups that the engine binds: fixed, whatever a shader happens to read, so that group 0,
/// which is bound once a view, stays bound across materials.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/package/Package.h"

namespace filament::shader {

/// Surface: every ViewBinding. PostProcess: FrameUniforms alone.
backend::BindGroupLayout viewGroupLayout(MaterialDomain domain = MaterialDomain::Surface);

/// Every DeformationBinding. Of the vertex stage alone: uniforms that fragments see cost far more to bind again.
backend::BindGroupLayout deformationGroupLayout();

/// What the programs of a variant are made with: the layout of the material, and group 2 where the variant deforms.
backend::ProgramLayout programLayout(backend::ProgramLayout const& material, uint16_t variantKey);

} // namespace filament::shader
