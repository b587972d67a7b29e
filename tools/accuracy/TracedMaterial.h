// SPDX-License-Identifier: Apache-2.0
/// TracedMaterial: a scene whose model is a material (tools/conformance/MaterialModel.h), as the path tracer takes it:
/// the same mesh, and the values as what they are named after.
///   Names   parameters are named like the members of MaterialInputs that they set: baseColor, metallic, roughness,
///           reflectance, ior, clearCoat, clearCoatRoughness, sheenColor, sheenRoughness, anisotropy, transmission,
///           absorption, thickness, microThickness, dispersion. What the text does beyond that is not known here: the
///           material must do no more. wallHeight stands for the occlusion of scenes/materials/corner.mat.
///   Model   lit and cloth; refraction through solids or sheets as the material declares.
///   Thread  any; compiles the material.
///   Fails   NotFound with the nearest name, Unsupported: scene and shading model; what the compiler says.
#pragma once

#include "tools/conformance/SceneFile.h"
#include "tools/reference/Reference.h"

namespace filament::accuracy {

/// What a scene's materials have: which approximations its pictures hold.
struct MaterialFeatures {
    bool coat = false, sheen = false, refraction = false; ///< refraction: through a solid or a sheet
    bool solid = false;
};

struct TracedMaterial {
    reference::ReferenceModel model; ///< where it stands is the scene's
    MaterialFeatures features;
};

Result<TracedMaterial> tracedMaterialOf(conformance::SceneSpec const& spec);

} // namespace filament::accuracy
