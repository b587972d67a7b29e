// SPDX-License-Identifier: Apache-2.0
/// FitShadows: the views from which shadow maps are drawn.
///   Sun     parallel projections, each around the bounding sphere of a slice of the camera's frustum (Zhang et al.
///           2006, "Parallel-Split Shadow Maps"): turning the camera does not change its size. The slices divide the
///           range of depth in which shadows can be seen. Centres move in steps of a sixteenth of a map, which is a
///           whole number of texels: between two steps a map does not change at all, so a still scene under a moving
///           camera is drawn again once in many frames. A scene that is smaller than the sphere is enclosed whole, and
///           then the map does not depend on the camera.
///   Spot    one projection around its cone; cones wider than 60 degrees to each side take the faces of a cube.
///   Point   the six faces of a cube; those of areas, too, less the one behind an area that shines to one side.
///   Space   light space: the view space of the map; x right, y up, the light travels along -z. Double precision.
///   Thread  any; pure.   Memory: none.   Fails: never. What is not finite is left out of the fit.
#pragma once

#include "base/math/Math.h"
#include "filament_core/prepare/ViewConstants.h"
#include "filament_core/scene/SceneData.h"

#include <array>
#include <cstdint>

namespace filament_core::prepare {

inline constexpr uint32_t kMaxCascades = 4;
inline constexpr uint32_t kCubeFaces = 6;

/// The axes of a light's view as columns; the same for the same direction.
double3x3 worldFromLight(double3 const& direction);

/// Axis-aligned in light space; empty where min > max.
struct LightSpaceBox {
    double3 min{ 1e300 }, max{ -1e300 };

    bool isEmpty() const { return min.x > max.x; }
    void add(LightSpaceBox const& other) { min = glm::min(min, other.min), max = glm::max(max, other.max); }
};

/// Of a box in the world. Boxes that are not finite are empty.
LightSpaceBox inLightSpace(double3x3 const& worldFromLight, double3 const& center, float3 const& halfExtent);

/// A part of the main view that shadows are seen in: metres in front of the camera.
struct DepthSlice {
    double nearest = 0, farthest = 0;
};

/// Where one map is drawn from.
struct FittedShadow {
    Camera camera{};
    float4x4 clipFromView{ 1.0f };
    float widthMeters = 0;   ///< of the map, for parallel light
    float depthMeters = 0;   ///< from depth 0 to 1, for parallel light
    float widthPerMeter = 0; ///< of the map, for each metre in front of the light, for others
};

/// Slices of `range` between logarithmic and uniform ones ("practical split scheme", Zhang et al. 2006, with weight
/// 0.75).
std::array<DepthSlice, kMaxCascades> splitDepth(DepthSlice const& range, uint32_t count);

/// One cascade. `scene`: everything that casts or receives, in light space.
/// Sets `coversScene` if no part of the scene is outside of the map.
FittedShadow fitCascade(ViewSpace const& mainView, DepthSlice const& slice, double3x3 const& worldFromLight,
                        LightSpaceBox const& scene, bool& coversScene);

/// True: the light is seen through the faces of a cube.
bool takesCube(scene::LightRecord const& light);
/// False: all of a face of the cube, +x, -x, +y, -y, +z, -z, lies where the light does not shine.
bool shinesThrough(scene::LightRecord const& light, uint32_t face);
/// `face`: 0 for a spot that takes no cube; else +x, -x, +y, -y, +z, -z.
FittedShadow fitPunctual(scene::LightRecord const& light, uint32_t face);

/// The radius of a penumbra, as a fraction of the map's width, per unit of depth between caster and receiver.
/// `sourceRadius`: LightRecord's. By similar triangles (Fernando 2005, "Percentage-Closer Soft Shadows"); the depths of
/// perspective maps are reciprocals, in which it is linear, too.
float penumbraOfDepth(FittedShadow const& fitted, float sourceRadius);

/// True: the depths of a map are reciprocal to the distance, not linear.
inline bool isPerspective(FittedShadow const& fitted) { return fitted.depthMeters <= 0; }

/// The ratio of the near plane to a distance beyond which nothing casts, for momentDepth(); 0 for parallel light.
/// `world`: everything that casts, axis-aligned in the world.
float nearOverFar(FittedShadow const& fitted, LightSpaceBox const& world);

/// From positions relative to the main camera to texels of the atlas, in xy, and depth, in z; all times w.
float4x4 atlasFromWorld(FittedShadow const& fitted, double3 const& mainCamera, double x, double y, double size);

} // namespace filament_core::prepare
