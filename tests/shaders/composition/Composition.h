// SPDX-License-Identifier: Apache-2.0
/// Composition: a material's own fragment stage as a function of view and light, compiled as C++ from the text that the
/// compiler generates. Its .mat file is beside this header; its parameters are in composition.inc.
///   Frame   tangent +x, bitangent +y, normal +z; directions point away from the surface.
///   Thread  one: the text has global variables.
#pragma once

#include "tests/shaders/composition/GlslCpp.h"

#include <span>

namespace filament_core::shader::composition {

struct Inputs {
    vec3 color{ 1.0 }, tint{ 1.0 }; ///< of the base; of the layers above, below or behind
    double metallic = 0, roughness = 0.5, strength = 1, smallRoughness = 0.3;
    double coat = 1, sheen = 1, grooves = 1, film = 1, through = 1; ///< only for combinations.mat
    bool energyCompensation = true;
};

struct Composition {
    const char* name;
    /// Reflection of one light of illuminance 1: the BRDF times the cosine of the light.
    vec3 (*light)(Inputs const& inputs, vec3 view, vec3 light);
    /// Reflection of a white environment of radiance 1.
    vec3 (*environment)(Inputs const& inputs, vec3 view);
};

std::span<const Composition> compositions();

/// The split-sum table (DfgTable.h), with more samples and without rounding to 16 bits.
vec4 splitSum(vec2 uv);

} // namespace filament_core::shader::composition
