// SPDX-License-Identifier: Apache-2.0
/// The shapes of the bind groups that the engine binds. They do not depend on what a shader happens to read, so that
/// groups stay bound across materials: the View group is the same for every program, and the Pass group for all of a
/// kind.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/package/Package.h"

namespace filament::shader {

/// What the Pass group of a material holds besides PassUniforms.
enum class PassKind : uint8_t {
    Lit,     ///< surfaces under lights: the textures of the environment
    Unlit,   ///< surfaces that light does not reach, the sky among them
    Picture, ///< the domain postprocess
};
inline constexpr size_t kPassKinds = 3;

PassKind passKind(MaterialDomain domain, ShadingModel shading);

/// Every ViewBinding.
backend::BindGroupLayout viewGroupLayout();

/// The PassBindings of such materials.
backend::BindGroupLayout passGroupLayout(PassKind kind);

/// Every DeformationBinding. Of the vertex stage alone: uniforms that fragments see cost far more to bind again.
backend::BindGroupLayout deformationGroupLayout();

/// What the programs of a variant are made with: the layout of the package; with the Deformation group where the
/// variant deforms; with subpass inputs in place of the currentPixel textures where it is merged. These then are colour
/// attachments 0, 1, ... in the order of the parameters.
backend::ProgramLayout programLayout(MaterialPackage const& package, uint16_t variantKey);

} // namespace filament::shader
