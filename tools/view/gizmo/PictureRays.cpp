// SPDX-License-Identifier: Apache-2.0
#include "tools/view/gizmo/PictureRays.h"

#include "tools/view/camera/CameraControl.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

constexpr double kParallel = 1e-9; // sine of the angle between a ray and a line or a plane that it never meets

double3 inWorld(Camera const& camera, double3 inView) { return double3(camera.worldFromView * double4(inView, 1)); }

double3 inView(Camera const& camera, double3 inWorld) {
    return glm::transpose(double3x3(camera.worldFromView)) * (inWorld - camera.position());
}

/// How far from the ray's origin anything is looked for.
double farthest(PictureRay const& ray, double3 pointWorld) {
    const double distance = glm::length(pointWorld - ray.originWorld);
    return kFarthest * std::max(ray.heightMeters > 0 ? ray.heightMeters : distance, 1e-6);
}

double3 someDirectionAcross(double3 direction) {
    const double3 axis = std::abs(direction.x) < 0.7 ? double3(1, 0, 0) : double3(0, 1, 0);
    return glm::normalize(glm::cross(direction, axis));
}

} // namespace

PictureRay rayThrough(PictureView const& view, double2 pixel) {
    const double2 picture = pictureFromPixel(pixel, view.size);
    const double3 at = inWorld(view.camera, view.camera.viewFromPicture(picture, 1, view.aspect()));
    if (view.camera.lens.isOrthographic()) {
        const double3 forward = -double3(view.camera.worldFromView[2]);
        return { at - forward, forward, static_cast<double>(view.camera.lens.orthographicHeight) };
    }
    return { view.camera.position(), glm::normalize(at - view.camera.position()) };
}

double depthOf(PictureView const& view, double3 pointWorld) { return -inView(view.camera, pointWorld).z; }

std::optional<double2> pixelOf(PictureView const& view, double3 pointWorld) {
    const double3 point = inView(view.camera, pointWorld);
    if (!view.camera.lens.isOrthographic() && !(point.z < 0)) return std::nullopt;
    const double3 upperLeft = view.camera.viewFromPicture({ -1, -1 }, -point.z, view.aspect());
    const double3 lowerRight = view.camera.viewFromPicture({ 1, 1 }, -point.z, view.aspect());
    const double2 share = double2(point - upperLeft) / double2(lowerRight - upperLeft);
    return share * double2(view.size);
}

double metersPerPixel(PictureView const& view, double3 pointWorld) {
    const double depth = view.camera.lens.isOrthographic() ? 1 : std::max(depthOf(view, pointWorld), 1e-9);
    const double3 top = view.camera.viewFromPicture({ 0, -1 }, depth, view.aspect());
    const double3 bottom = view.camera.viewFromPicture({ 0, 1 }, depth, view.aspect());
    return (top.y - bottom.y) / view.size.y;
}

double3 towardsEye(PictureView const& view, double3 pointWorld) {
    const double3 back = double3(view.camera.worldFromView[2]);
    if (view.camera.lens.isOrthographic()) return back;
    const double3 way = view.camera.position() - pointWorld;
    return glm::length(way) > 0 ? glm::normalize(way) : back;
}

double alongLine(PictureRay const& ray, double3 originWorld, double3 axis) {
    // Both closest points: Ericson 2005, "Real-Time Collision Detection", section 5.1.8, with directions of length 1.
    const double limit = farthest(ray, originWorld);
    const double3 between = originWorld - ray.originWorld;
    const double b = glm::dot(axis, ray.direction), sine2 = 1 - b * b;
    const double c = glm::dot(axis, between), f = glm::dot(ray.direction, between);
    const double away = b >= 0 ? limit : -limit; // towards the vanishing point
    if (sine2 < kParallel * kParallel) return away;
    const double t = (b * f - c) / sine2, onRay = (f - b * c) / sine2;
    return onRay < 0 && ray.heightMeters == 0 ? away : std::clamp(t, -limit, limit);
}

double3 onPlane(PictureRay const& ray, double3 pointWorld, double3 normal) {
    const double limit = farthest(ray, pointWorld);
    const double cosine = glm::dot(ray.direction, normal), height = glm::dot(pointWorld - ray.originWorld, normal);
    if (std::abs(cosine) > kParallel && (height / cosine >= 0 || ray.heightMeters > 0)) {
        const double3 offset = ray.originWorld + height / cosine * ray.direction - pointWorld;
        return pointWorld + offset * std::min(1.0, limit / std::max(glm::length(offset), 1e-300));
    }
    const double3 across = ray.direction - cosine * normal; // towards the horizon
    const double length = glm::length(across);
    return length > kParallel ? pointWorld + across * (limit / length) : pointWorld;
}

double3 onSphere(PictureRay const& ray, double3 centerWorld, double radiusMeters, bool isNearSide) {
    const double3 towards = centerWorld - ray.originWorld;
    const double along = glm::dot(towards, ray.direction);
    const double3 nearest = ray.originWorld + (ray.heightMeters > 0 ? along : std::max(along, 0.0)) * ray.direction;
    const double3 beside = nearest - centerWorld;
    const double distance = glm::length(beside);
    const bool passes = distance > radiusMeters;
    const double inside = passes ? std::max(2 * radiusMeters - distance, 0.0) : distance;
    const double3 across = distance > 0 ? beside / distance : someDirectionAcross(ray.direction);
    const double half = std::sqrt(std::max(radiusMeters * radiusMeters - inside * inside, 0.0));
    const double side = isNearSide != passes ? -half : half;
    const double3 through = glm::normalize(ray.direction - glm::dot(ray.direction, across) * across);
    const double3 point = across * inside + through * side;
    return centerWorld + point * (radiusMeters / std::max(glm::length(point), 1e-300));
}

} // namespace filament_core::view
