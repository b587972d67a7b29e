// SPDX-License-Identifier: Apache-2.0
/// ReflectionProbe: the light around a place, which surfaces in a box reflect instead of the environment. Added to a
/// Scene, any number of them.
///   Parallax  a mirrored ray is followed to the walls of the box, and the cube is looked up there.
///   Blending  a box gives the light of what is in it and on its faces, and less and less up to blendMeters outside.
///             The smallest box comes first, others give what it leaves, and the environment what all of them leave.
///   Limits    a view uses up to Quality::reflectionProbes probes: of those whose boxes overlap lit surfaces in the
///             frustum, the nearest to the camera. All of their cubes have the size, the levels, the format and the
///             mapping of the environment's or, without an environment, of the smallest probe's. Formats are RGBA16F
///             and RGBM. Renderer::explain() says which probes a view leaves out, and why. The device needs arrays of
///             cubes: without them the environment lights all surfaces.
///   Affects   specular light of all lit materials, clear coats and sheens and refraction included, and diffuse light.
///             Diffuse light of probes is that of spherical harmonics, whatever Quality::diffuseIrradiance is. Fog and
///             background are those of the environment.
#pragma once

#include <filament_core/Objects.h>

#include <cstdint>
#include <string>

namespace filament_core {

/// All numbers are finite.
struct ReflectionProbeDesc {
    static constexpr uint32_t kMaxOfView = 8;

    double3 centerWorld{ 0 };       ///< of the box, metres
    float3 halfExtentMeters{ 1 };   ///< half of each side, > 0
    float3x3 worldFromBox{ 1.0f };  ///< axes of the box: three unit vectors at right angles
    float blendMeters = 0.25f;      ///< how far outside of the box its light ends, >= 0
    float3 captureInBoxMeters{ 0 }; ///< where the cube was captured, in the frame of the box, inside of it
    /// What is seen from there: filtered like an environment's (loadEnvironment()). Cubes and coefficients lie along
    /// the axes of the box; IndirectLightDesc::worldFromCube has no effect.
    IndirectLight light{};
    float intensity = 1;       ///< candela / m2 of a texel of 1, >= 0
    bool lightsDiffuse = true; ///< false: diffuse light is that of other probes and of the environment
    std::string name{};        ///< in Renderer::explain()
};

} // namespace filament_core
