// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/FitShadows.h"

#include "base/math/Elementary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core::prepare {
namespace {

constexpr double kLogarithmicShare = 0.75; // of the splits
constexpr double kStepsOfMap = 16;         // a map's centre moves by a sixteenth of its width
constexpr double kMarginOfMap = 1.0 / 16;  // on each side of a perspective map, for filters
constexpr double kNearMeters = 1e-6;       // depth is its ratio to the distance: floats are as fine for any
constexpr double kWidestSpotRadians = 1.0471976;

// Upwards to five significant bits: what changes a little from frame to frame becomes the same number.
double roundedUp(double value) {
    if (!(value > 0)) return 0;
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return std::ldexp(std::ceil(mantissa * 32), exponent - 5);
}

// A quarter of an octave, to the outside.
// The splits follow from these ends. If they moved with every small change of what is visible, all cascades would be
// drawn again in each frame.
DepthSlice roundedOut(DepthSlice range) {
    const auto step = [](double depth, double round(double)) {
        return elementary::exp2(round(4 * elementary::log2(depth)) / 4);
    };
    range.nearest = step(std::max(range.nearest, 1e-6), std::floor);
    range.farthest = step(std::max(range.farthest, range.nearest * 1.0001), std::ceil);
    return range;
}

/// The corner of the screen that lies farthest from its centre, at a depth: x and y of view space.
double2 cornerAt(float4x4 const& clipFromView, double depth) {
    const double w = -static_cast<double>(clipFromView[2][3]) * depth + static_cast<double>(clipFromView[3][3]);
    const auto at = [&](int axis) {
        const double shift = -static_cast<double>(clipFromView[2][axis]) * depth + clipFromView[3][axis];
        const double scale = std::abs(static_cast<double>(clipFromView[axis][axis]));
        return (w + std::abs(shift)) / scale;
    };
    return { at(0), at(1) };
}

struct Sphere {
    double depth = 0, radius = 0; // its centre is at the image centre
};

/// The smallest with its centre on the axis of the view that contains a slice of the frustum.
Sphere sphereAround(float4x4 const& clipFromView, DepthSlice const& slice) {
    const double2 nearCorner = cornerAt(clipFromView, slice.nearest),
                  farCorner = cornerAt(clipFromView, slice.farthest);
    const double nearReach = glm::dot(nearCorner, nearCorner), farReach = glm::dot(farCorner, farCorner);
    const double length = slice.farthest - slice.nearest;
    // As far from the far corner as from the near one: (far - depth)^2 + farReach = (depth - near)^2 + nearReach. A
    // wide lens puts this point behind the far side, where the sphere around the far corners is the smallest.
    const double both = slice.farthest * slice.farthest - slice.nearest * slice.nearest + farReach - nearReach;
    const double depth = std::clamp(both / (2 * length), slice.nearest, slice.farthest);
    const double toFar = slice.farthest - depth, toNear = depth - slice.nearest;
    return { depth, std::sqrt(std::max(toFar * toFar + farReach, toNear * toNear + nearReach)) };
}

/// x, y in [-width / 2, width / 2]; depth 0 at the camera, 1 `depth` metres behind it, towards the light: floats are
/// finest where the receivers are, however far away casters may be.
float4x4 parallelClip(double width, double depth) {
    float4x4 clip(1.0f);
    clip[0][0] = static_cast<float>(2 / width);
    clip[1][1] = static_cast<float>(-2 / width);
    clip[2][2] = static_cast<float>(1 / depth);
    return clip;
}

float4x4 perspectiveClip(double tangent, double nearMeters) {
    float4x4 clip(0.0f);
    clip[0][0] = static_cast<float>(1 / tangent);
    clip[1][1] = static_cast<float>(-1 / tangent);
    clip[2][3] = -1;
    clip[3][2] = static_cast<float>(nearMeters);
    return clip;
}

double4x4 cameraAt(double3x3 const& axes, double3 const& position) {
    return double4x4(double4(axes[0], 0), double4(axes[1], 0), double4(axes[2], 0), double4(position, 1));
}

double3 faceDirection(uint32_t face) {
    double3 direction(0.0);
    direction[static_cast<int>(face / 2)] = face % 2 == 0 ? 1 : -1;
    return direction;
}

/// Around its direction: where the light shines.
double coneOf(scene::LightRecord const& light) {
    using Type = scene::LightRecord::Type;
    if (light.type == Type::Spot) return static_cast<double>(light.outerConeRadians);
    const bool hasBack = light.isArea() && light.type != Type::Tube && !light.isTwoSided;
    return hasBack ? std::numbers::pi / 2 : std::numbers::pi;
}

} // namespace

double3x3 worldFromLight(double3 const& direction) {
    const double3 back = -glm::normalize(direction);
    const double3 up = std::abs(back.y) < 0.99 ? double3(0, 1, 0) : double3(0, 0, -1);
    const double3 right = glm::normalize(glm::cross(up, back));
    return { right, glm::cross(back, right), back };
}

LightSpaceBox inLightSpace(double3x3 const& worldFromLight, double3 const& center, float3 const& halfExtent) {
    const double3 middle = center * worldFromLight; // the transposed matrix
    const double3 half = double3(halfExtent) * double3x3(glm::abs(worldFromLight[0]), glm::abs(worldFromLight[1]),
                                                         glm::abs(worldFromLight[2]));
    const double sum = glm::dot(middle, double3(1)) + glm::dot(half, double3(1));
    if (!std::isfinite(sum)) return {};
    return { middle - half, middle + half };
}

std::array<DepthSlice, kMaxCascades> splitDepth(DepthSlice const& range, uint32_t count) {
    const DepthSlice whole = roundedOut(range);
    std::array<DepthSlice, kMaxCascades> slices{};
    double begin = whole.nearest;
    for (uint32_t i = 0; i < count; ++i) {
        const double part = (i + 1.0) / count;
        const double logarithmic = whole.nearest * elementary::pow(whole.farthest / whole.nearest, part);
        const double uniform = whole.nearest + (whole.farthest - whole.nearest) * part;
        const double end = kLogarithmicShare * logarithmic + (1 - kLogarithmicShare) * uniform;
        slices[i] = { begin, end };
        begin = end;
    }
    return slices;
}

FittedShadow fitCascade(ViewSpace const& mainView, DepthSlice const& slice, double3x3 const& worldFromLight,
                        LightSpaceBox const& scene, bool& coversScene) {
    const Sphere sphere = sphereAround(mainView.clipFromView, slice);
    // Rounding its place moves the map by up to half a step. It is wider by as much, so that it still holds the sphere.
    const double ofSlice = roundedUp(sphere.radius / (0.5 - 0.5 / kStepsOfMap) * (1 + kMarginOfMap));
    const double3 extent = scene.max - scene.min;
    const double ofScene = roundedUp(std::max({ extent.x, extent.y, 1e-6 }) * (1 + kMarginOfMap));
    coversScene = ofScene <= ofSlice;
    const double width = coversScene ? ofScene : ofSlice;

    // The middle of the map's far side: what is nearer to the light has a depth above 0.
    const double depth = roundedUp(std::max(extent.z, width * 1e-3) * (1 + kMarginOfMap));
    double3 center = (scene.min + scene.max) * 0.5;
    center.z -= depth / 2;
    if (!coversScene) {
        // The far side is that of the sphere, beyond which no point of the slice receives shadows, or that of the
        // scene, whichever is nearer to the light.
        const double3 onAxis = mainView.cameraWorld + double3(mainView.forward) * sphere.depth;
        const double step = width / kStepsOfMap;
        const double3 steps = glm::round((onAxis * worldFromLight) / step);
        center = { steps.x * step, steps.y * step, std::max(center.z, (steps.z - kStepsOfMap / 2) * step) };
    }
    return { .camera = { .worldFromView = cameraAt(worldFromLight, worldFromLight * center) },
             .clipFromView = parallelClip(width, depth),
             .widthMeters = static_cast<float>(width),
             .depthMeters = static_cast<float>(depth) };
}

bool takesCube(scene::LightRecord const& light) {
    return light.type != scene::LightRecord::Type::Sun && coneOf(light) > kWidestSpotRadians;
}

bool shinesThrough(scene::LightRecord const& light, uint32_t face) {
    constexpr double kCornerOfFace = 0.9553166; // atan(sqrt(2)): from its axis
    const double away =
            elementary::acos(std::clamp(glm::dot(faceDirection(face), double3(light.directionWorld)), -1.0, 1.0));
    return away <= coneOf(light) + kCornerOfFace + 1e-3;
}

FittedShadow fitPunctual(scene::LightRecord const& light, uint32_t face) {
    const bool isCube = takesCube(light);
    const double3x3 axes = worldFromLight(isCube ? faceDirection(face) : double3(light.directionWorld));
    const double cone = isCube ? 1.0 : std::max(elementary::tan(static_cast<double>(light.outerConeRadians)), 1e-4);
    const double tangent = cone / (1 - 2 * kMarginOfMap);
    return { .camera = { .worldFromView = cameraAt(axes, light.positionWorld) },
             .clipFromView = perspectiveClip(tangent, kNearMeters),
             .widthPerMeter = static_cast<float>(2 * tangent) };
}

float penumbraOfDepth(FittedShadow const& fitted, float sourceRadius) {
    if (!isPerspective(fitted)) return sourceRadius * fitted.depthMeters / fitted.widthMeters;
    return sourceRadius / (static_cast<float>(kNearMeters) * fitted.widthPerMeter);
}

float nearOverFar(FittedShadow const& fitted, LightSpaceBox const& world) {
    if (!isPerspective(fitted) || world.isEmpty()) return 0;
    const double3 forward = -double3(fitted.camera.worldFromView[2]);
    const double3 middle = (world.min + world.max) * 0.5 - fitted.camera.position();
    const double farMeters =
            roundedUp(glm::dot(middle, forward) + glm::dot((world.max - world.min) * 0.5, glm::abs(forward)));
    return farMeters > kNearMeters ? static_cast<float>(kNearMeters / farMeters) : 1.0f;
}

float4x4 atlasFromWorld(FittedShadow const& fitted, double3 const& mainCamera, double x, double y, double size) {
    double4x4 atlasFromClip(1.0);
    atlasFromClip[0][0] = atlasFromClip[1][1] = size / 2;
    atlasFromClip[3][0] = x + size / 2;
    atlasFromClip[3][1] = y + size / 2;
    // In double precision up to the product: both cameras may be far from the origin, and only their difference is
    // small.
    const double3x3 viewFromWorld = glm::transpose(double3x3(fitted.camera.worldFromView));
    double4x4 viewFromMain(viewFromWorld);
    viewFromMain[3] = double4(viewFromWorld * (mainCamera - fitted.camera.position()), 1);
    return float4x4(atlasFromClip * double4x4(fitted.clipFromView) * viewFromMain);
}

} // namespace filament_core::prepare
