// SPDX-License-Identifier: Apache-2.0
/// The shader library as C++: exactly the text that the GPU runs, in namespace filament_core::shader::lib, on GLM's
/// types.
///   Use     tests check the BRDF before anything is drawn; the environment baker samples with the same functions.
///   Differs arrays decay to pointers (irradianceSh takes 9 float4), OUT(T) is T&, and transcendental functions are
///   those of base/math/Elementary.h, rounded from double precision.
///   Rules   for the .glsl files: no swizzles but .x .y .z .w, literals end in f, vec3(v4) truncates, built-ins are
///           those of GlslBuiltIns.h, functions only.
///   Memory  none. Thread: pure functions.
#pragma once

#include "shaders/lib/GlslBuiltIns.h"

#include <filament_core/Math.h>

namespace filament_core::shader::lib {

using glm::uint;
using glm::vec2;
using glm::vec3;
using glm::vec4;

using namespace glsl;

// GLSL functions have no linkage: they are internal here, and not every file that includes them calls all of them.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
namespace {

#include "shaders/lib/math.glsl"
// the others in alphabetical order: the lobes that extend brdf.glsl come after it
#include "shaders/lib/aa.glsl"
#include "shaders/lib/ao.glsl"
#include "shaders/lib/area_shadows.glsl"
#include "shaders/lib/brdf.glsl"
#include "shaders/lib/brdf_anisotropic.glsl"
#include "shaders/lib/cloth.glsl"
#include "shaders/lib/coat.glsl"
#include "shaders/lib/color.glsl"
#include "shaders/lib/distance.glsl"
#include "shaders/lib/exposure.glsl"
#include "shaders/lib/field.glsl"
#include "shaders/lib/fog.glsl"
#include "shaders/lib/fog_noise.glsl"
#include "shaders/lib/fresnel.glsl"
#include "shaders/lib/grading.glsl"
#include "shaders/lib/ground.glsl"
#include "shaders/lib/ibl.glsl"
#include "shaders/lib/iridescence.glsl"
#include "shaders/lib/light.glsl"
#include "shaders/lib/look_ups.glsl"
#include "shaders/lib/ltc.glsl"
#include "shaders/lib/moments.glsl"
#include "shaders/lib/noise.glsl"
#include "shaders/lib/normals.glsl"
#include "shaders/lib/occlusion.glsl"
#include "shaders/lib/parallax.glsl"
#include "shaders/lib/plausible.glsl"
#include "shaders/lib/probes.glsl"
#include "shaders/lib/profiles.glsl"
#include "shaders/lib/reflection.glsl"
#include "shaders/lib/refraction.glsl"
#include "shaders/lib/resolution.glsl"
#include "shaders/lib/sampling.glsl"
#include "shaders/lib/scatter.glsl"
#include "shaders/lib/screen_occlusion.glsl"
#include "shaders/lib/sheen.glsl"
#include "shaders/lib/specular.glsl"
#include "shaders/lib/splats.glsl"
#include "shaders/lib/subsurface.glsl"
#include "shaders/lib/tangent.glsl"
#include "shaders/lib/temporal.glsl"
#include "shaders/lib/tone.glsl"
#include "shaders/lib/transparency.glsl"

} // namespace
#pragma GCC diagnostic pop

#undef OUT

} // namespace filament_core::shader::lib
