// SPDX-License-Identifier: Apache-2.0
/// LightBounds: how far lights reach in the space of a view, a little more than they really do.
///   Space   x and y as in view space; depth is -z: metres in front of the camera.
///   In      lights as the shaders read them: their rounding is that of the data, not of the scene.
///   Thread  any; pure. Memory: none. Fails: never; a light whose reach is not a number reaches everywhere.
#pragma once

#include "filament_core/prepare/ViewConstants.h"

#include <limits>

namespace filament_core::prepare {

/// How much a test is widened, for the rounding of the shaders and its own. Factors of the default; tests shrink them
/// to prove that they are needed.
struct FroxelMargins {
    float factor = 1;

    /// Of a range: 1 / range^2 and the ratio to it are rounded (5 roundings, 2^-24 each).
    float range() const { return 1e-5f * factor; }
    /// Of a place, relative to its distance from the camera: three products and their sum, in the shader and here.
    float place() const { return 1e-6f * factor; }
    /// Of the cosine of a cone's angle: the offset is its multiple, rounded, and the direction has unit length within
    /// it.
    float cosine() const { return 2e-6f * factor; }
    /// Of a tile border, for each unit that the terms of its sum have.
    float tile() const { return 2e-6f * factor; }
};

inline constexpr float kEverywhere = std::numeric_limits<float>::infinity();

/// Includes every point that the light reaches.
struct LightSphere {
    float3 center{ 0 };
    float radius = kEverywhere;
};

/// Includes the directions in which a spot shines; none for other lights and for angles of 90 degrees and more.
struct LightCone {
    float3 apex{ 0 };
    float3 axis{ 0 }; ///< unit
    float cosine = -1, sine = 0;
    bool isNarrow = false;
};

struct LightBounds {
    LightSphere sphere;
    LightCone cone;
};

LightBounds boundsOf(shader::PunctualLight const& light, ViewSpace const& space, FroxelMargins margins);

/// False only if no point of the sphere is in the cone.
bool intersects(LightCone const& cone, float3 center, float radius);

} // namespace filament_core::prepare
