// SPDX-License-Identifier: Apache-2.0
/// The shape of bind group 0, which the engine binds once a view: fixed, whatever a shader happens to read, so that the
/// group stays bound across materials.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/package/Package.h"

namespace filament::shader {

/// Surface: every ViewBinding. PostProcess: FrameUniforms alone.
backend::BindGroupLayout viewGroupLayout(MaterialDomain domain = MaterialDomain::Surface);

} // namespace filament::shader
