// SPDX-License-Identifier: Apache-2.0
/// Lights, in photometric units. Plain descriptions: Scene::add takes them and returns a handle. For a light attached
/// to a node, "World" in a field's name means the space of that node.
///   Limits  of points and spots: 4096 that reach into a view, and 256 that reach any froxel, a cell a sixteenth of the
///           picture wide and at most half as deep as it is far away. Beyond, the dimmest at the camera are left out;
///           Renderer::explain() says how many.
///   Cost    that of the lights whose range includes what is drawn: give lamps a range. An unlimited light shades every
///           fragment.
#pragma once

#include <filament/Color.h>
#include <filament/Math.h>
#include <filament/Units.h>

namespace filament {

/// Parallel light; a scene has any number. The brightest is the sun of the uniforms and of the directional shader
/// variant. The others are among the 4096 lights of a view, in the order of the scene: they cost what an unlimited point
/// costs, and materials compiled without dynamic lighting do not see them.
struct SunLight {
    float3 directionWorld{ 0, -1, 0 }; ///< the direction in which the light travels; any length except zero
    Lux illuminance{ 110'000 };        ///< on a surface facing it, >= 0
    LinearColor color{ 1.0f };
};

struct PointLight {
    double3 positionWorld{ 0 };
    Candela intensity{ 100 }; ///< >= 0. From lumens: lm / (4 pi)
    LinearColor color{ 1.0f };
    float rangeMeters = 0; ///< the light is exactly zero beyond this range; 0: unlimited
};

struct SpotLight {
    double3 positionWorld{ 0 };
    float3 directionWorld{ 0, 0, -1 };
    Candela intensity{ 100 };
    LinearColor color{ 1.0f };
    float rangeMeters = 0;
    float innerConeRadians = 0;          ///< [0, outer)
    float outerConeRadians = 0.7853982f; ///< (inner, pi/2]
};

} // namespace filament
