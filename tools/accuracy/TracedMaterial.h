// SPDX-License-Identifier: Apache-2.0
/// TracedMaterial: converts a scene whose model is a material (toolkit/scenes/MaterialModel.h) for the path tracer:
/// the same mesh, with the parameter values interpreted by their names.
///   Names   parameters are named like the members of MaterialInputs that they set: baseColor, metallic, roughness,
///           reflectance, ior, clearCoat, clearCoatRoughness, sheenColor, sheenRoughness, anisotropy, transmission,
///           absorption, thickness, microThickness, dispersion, emissive (rgb, not exposed). Anything else in the
///           material's text is unknown here: the material must not do more, and has some parameter. wallHeight stands
///           for the occlusion of scenes/materials/corner.mat.
///   Model   lit and cloth; refraction through solids or sheets as the material declares.
///   Thread  any; compiles the material.
///   Fails   NotFound with the nearest name; Unsupported: the shading model, or no parameter; errors of the compiler.
#pragma once

#include "toolkit/scenes/SceneFile.h"
#include "tools/reference/Reference.h"

namespace filament_core::accuracy {

/// The features of a scene's materials: which approximations its pictures contain.
struct MaterialFeatures {
    bool coat = false, sheen = false, refraction = false; ///< refraction: through a solid or a sheet
    bool solid = false;
};

struct TracedMaterial {
    reference::ReferenceModel model; ///< where it stands is the scene's
    MaterialFeatures features;
};

/// Of one of the scene's copies.
Result<TracedMaterial> tracedMaterialOf(tools::SceneSpec const& spec, size_t copy = 0);

} // namespace filament_core::accuracy
