// SPDX-License-Identifier: Apache-2.0
#include "tools/view/camera/CameraControl.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core::view {
namespace {

constexpr double kPole = std::numbers::pi / 2 - kPoleMargin;
constexpr double3 kUp{ 0, 1, 0 };
constexpr double kLeastGap = 0.01; // from the eye to a framed box, of its diagonal

/// A turn as heading about the up of the world, elevation above the horizon, and roll about the view:
/// R_y(heading) R_x(elevation) R_z(roll).
struct Angles {
    double heading, elevation, roll;
};

glm::dmat3 turnOf(Camera const& camera) { return glm::dmat3(camera.worldFromView); }

glm::dmat3 rotation(double radians, double3 const& axis) { return glm::mat3_cast(glm::angleAxis(radians, axis)); }

glm::dmat3 turnOf(Angles const& angles) {
    return rotation(angles.heading, kUp) * rotation(angles.elevation, double3(1, 0, 0)) *
           rotation(angles.roll, double3(0, 0, 1));
}

/// Of a view along the up of the world, heading and roll are the same: the roll is 0.
Angles anglesOf(glm::dmat3 const& turn) {
    const double3 back = turn[2];
    const double level = std::hypot(back.x, back.z), elevation = std::atan2(-back.y, level);
    if (level < 1e-12) {
        const double3 right = turn[0];
        return { std::atan2(-right.z, right.x), elevation, 0 };
    }
    return { std::atan2(back.x, back.z), elevation, std::atan2(turn[0].y, turn[1].y) };
}

Camera withTurn(Camera const& camera, glm::dmat3 const& turn, double3 position) {
    Camera turned = camera;
    turned.worldFromView =
            double4x4(double4(turn[0], 0), double4(turn[1], 0), double4(turn[2], 0), double4(position, 1));
    return turned;
}

Camera moved(Camera const& camera, double3 inView) {
    return withTurn(camera, turnOf(camera), camera.position() + turnOf(camera) * inView);
}

/// Beyond the pole only the way back is open.
double elevated(double elevation, double up) {
    const double least = std::min(-kPole, elevation), most = std::max(kPole, elevation);
    return std::clamp(elevation + up, least, most);
}

/// The integral of cos(a + b t) from 0 to t, for any b.
double integralOfCos(double a, double b, double t) {
    const double half = b * t / 2;
    const double sinc = std::abs(half) < 1e-4 ? 1 - half * half / 6 : std::sin(half) / half;
    return t * std::cos(a + half) * sinc;
}
double integralOfSin(double a, double b, double t) { return integralOfCos(a - std::numbers::pi / 2, b, t); }

/// Where a velocity of the camera's axes leads while heading and elevation turn at constant rates. With v after the
/// roll, R_x(e) v = (x, y cos e - z sin e, y sin e + z cos e), and R_y(h) turns x and z; products of sines and cosines
/// are sums.
double3 way(Angles const& from, double headingRate, double elevationRate, double3 v, double t) {
    const double h = from.heading, e = from.elevation, hRate = headingRate, eRate = elevationRate;
    const double sumCos = integralOfCos(h + e, hRate + eRate, t), lessCos = integralOfCos(h - e, hRate - eRate, t);
    const double sumSin = integralOfSin(h + e, hRate + eRate, t), lessSin = integralOfSin(h - e, hRate - eRate, t);
    const double sinSin = (lessCos - sumCos) / 2, cosCos = (lessCos + sumCos) / 2;
    const double sinCos = (sumSin + lessSin) / 2, cosSin = (sumSin - lessSin) / 2; // of the heading, of the elevation
    return { v.x * integralOfCos(h, hRate, t) + v.y * sinSin + v.z * sinCos,
             v.y * integralOfCos(e, eRate, t) - v.z * integralOfSin(e, eRate, t),
             -v.x * integralOfSin(h, hRate, t) + v.y * cosSin + v.z * cosCos };
}

/// When the elevation arrives at the pole; at most `seconds`.
double timeToPole(double elevation, double rate, double seconds) {
    if (rate == 0) return seconds;
    const double left = elevated(elevation, rate > 0 ? 10 : -10) - elevation;
    return std::clamp(left / rate, 0.0, seconds);
}

/// Tangents (perspective) or metres (parallel) of the edges of the image.
struct Edges {
    double left, right, bottom, top;
};

Edges edgesOf(Camera const& camera, double aspect) {
    const double3 upperLeft = camera.viewFromPicture({ -1, -1 }, 1, aspect);
    const double3 lowerRight = camera.viewFromPicture({ 1, 1 }, 1, aspect);
    return { upperLeft.x, lowerRight.x, lowerRight.y, upperLeft.y };
}

Edges inside(Edges edges, double margin) {
    const double dx = (edges.right - edges.left) * margin / 2, dy = (edges.top - edges.bottom) * margin / 2;
    return { edges.left + dx, edges.right - dx, edges.bottom + dy, edges.top - dy };
}

/// Of the corners of a box in the axes of the camera: the least and the most of x + z `slope`.
struct Extent {
    double least = 1e300, most = -1e300;
    void add(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

template <class Visit>
void forEachCorner(Box const& box, glm::dmat3 const& turn, Visit const& visit) {
    for (int i = 0; i < 8; ++i) {
        const double3 corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                             i & 4 ? box.max.z : box.min.z);
        visit(glm::transpose(turn) * corner);
    }
}

/// A point at depth e.z - z is in the image between the slopes l and r if e.x + l (e.z - z) <= x <= e.x + r (e.z -
/// z). All corners are if most(x + r z) - r e.z <= e.x <= least(x + l z) - l e.z, which leaves a place for e.x once
/// e.z >= (most - least) / (r - l): there the box touches both edges.
struct Axis {
    double low, high; ///< slopes
    Extent atLow{}, atHigh{};
    void add(double across, double z) {
        atLow.add(across + low * z);
        atHigh.add(across + high * z);
    }
    double leastBack() const { return (atHigh.most - atLow.least) / (high - low); }
    double across(double back) const { return (atHigh.most - high * back + atLow.least - low * back) / 2; }
};

Camera framedPerspective(Camera const& camera, Box const& box, Edges const& edges) {
    const glm::dmat3 turn = turnOf(camera);
    Axis x{ edges.left, edges.right }, y{ edges.bottom, edges.top };
    Extent depth;
    forEachCorner(box, turn, [&](double3 const& corner) {
        x.add(corner.x, corner.z);
        y.add(corner.y, corner.z);
        depth.add(corner.z);
    });
    const double size = glm::length(box.max - box.min);
    const double nearMeters = static_cast<double>(camera.lens.nearMeters);
    const double least =
            depth.most + (size > 0 ? kLeastGap * size : 100 * nearMeters); // a line along the view fills nothing
    const double back = std::max({ x.leastBack(), y.leastBack(), least });
    const double gap = back - depth.most; // from the eye to the nearest corner
    Camera framed = withTurn(camera, turn, turn * double3(x.across(back), y.across(back), back));
    if (gap < 2 * nearMeters) framed.lens.nearMeters = static_cast<float>(gap / 2);
    return framed;
}

Camera framedParallel(Camera const& camera, Box const& box, Edges const& edges, double aspect) {
    const glm::dmat3 turn = turnOf(camera);
    Extent x, y, z;
    forEachCorner(box, turn, [&](double3 const& corner) {
        x.add(corner.x);
        y.add(corner.y);
        z.add(corner.z);
    });
    const double zoom =
            std::max((x.most - x.least) / (edges.right - edges.left), (y.most - y.least) / (edges.top - edges.bottom));
    Camera framed = camera;
    if (zoom > 0)
        framed.lens.orthographicHeight = static_cast<float>(static_cast<double>(camera.lens.orthographicHeight) * zoom);
    const double size = std::max(glm::length(box.max - box.min), 1e-6);
    framed.lens.farMeters = std::max(framed.lens.farMeters, static_cast<float>(4 * size) + framed.lens.nearMeters);
    const double3 middle = framed.viewFromPicture({ 0, 0 }, 1, aspect);
    const double back = z.most + size + static_cast<double>(framed.lens.nearMeters);
    return withTurn(framed, turn,
                    turn * double3((x.least + x.most) / 2 - middle.x, (y.least + y.most) / 2 - middle.y, back));
}

} // namespace

double2 pictureFromPixel(double2 pixel, uint2 size) { return pixel / double2(size) * 2.0 - 1.0; }

double distanceTo(Camera const& camera, double3 pointWorld, double leastMeters) {
    return std::max(leastMeters, glm::dot(camera.position() - pointWorld, double3(camera.worldFromView[2])));
}

double3 pointAt(Camera const& camera, double2 picture, double distanceMeters, double aspect) {
    return double3(camera.worldFromView * double4(camera.viewFromPicture(picture, distanceMeters, aspect), 1));
}

Camera orbited(Camera const& camera, double3 targetWorld, double yawRadians, double pitchRadians) {
    const double3 offset = glm::transpose(turnOf(camera)) * (camera.position() - targetWorld);
    Angles angles = anglesOf(turnOf(camera));
    angles.heading += yawRadians;
    angles.elevation = elevated(angles.elevation, -pitchRadians); // up around the target, so the view goes down
    const glm::dmat3 turn = turnOf(angles);
    return withTurn(camera, turn, targetWorld + turn * offset);
}

Camera panned(Camera const& camera, double2 from, double2 to, double distanceMeters, double aspect) {
    return moved(camera, camera.viewFromPicture(from, distanceMeters, aspect) -
                                 camera.viewFromPicture(to, distanceMeters, aspect));
}

Camera zoomed(Camera const& camera, double2 picture, double factor, double distanceMeters, double aspect) {
    const double3 held = camera.viewFromPicture(picture, distanceMeters, aspect);
    if (!camera.lens.isOrthographic()) return moved(camera, held * (1 - factor));
    Camera zoomed = camera;
    zoomed.lens.orthographicHeight =
            std::clamp(static_cast<float>(static_cast<double>(camera.lens.orthographicHeight) * factor), 1e-6f, 1e12f);
    return moved(zoomed, held - zoomed.viewFromPicture(picture, distanceMeters, aspect));
}

Camera turned(Camera const& camera, double rightRadians, double upRadians) {
    Angles angles = anglesOf(turnOf(camera));
    angles.heading -= rightRadians;
    angles.elevation = elevated(angles.elevation, upRadians);
    return withTurn(camera, turnOf(angles), camera.position());
}

Camera flown(Camera const& camera, FlyKeys const& keys, FlySpeed const& speed, double seconds) {
    const Angles from = anglesOf(turnOf(camera));
    const double headingRate = -keys.turnRight * speed.turnRadiansPerSecond;
    const double elevationRate = keys.turnUp * speed.turnRadiansPerSecond;
    const double3 velocity =
            rotation(from.roll, double3(0, 0, 1)) * double3(keys.right, keys.up, -keys.forward) * speed.metersPerSecond;
    const double turning = timeToPole(from.elevation, elevationRate, seconds);
    const Angles atPole{ from.heading + headingRate * turning, from.elevation + elevationRate * turning, from.roll };
    const double rest = seconds - turning;
    const double3 position = camera.position() + way(from, headingRate, elevationRate, velocity, turning) +
                             way(atPole, headingRate, 0, velocity, rest);
    return withTurn(camera, turnOf(Angles{ atPole.heading + headingRate * rest, atPole.elevation, from.roll }),
                    position);
}

Camera framed(Camera const& camera, Box const& box, double aspect, double margin) {
    if (box.empty()) return camera;
    const Edges edges = inside(edgesOf(camera, aspect), margin);
    return camera.lens.isOrthographic() ? framedParallel(camera, box, edges, aspect)
                                        : framedPerspective(camera, box, edges);
}

Camera framedAlong(Camera const& camera, double3 directionWorld, Box const& box, double aspect, double margin) {
    const double3 up = std::abs(directionWorld.y) > 0.999 * glm::length(directionWorld)
                               ? double3(0, 0, directionWorld.y < 0 ? -1 : 1)
                               : kUp;
    const Camera along = Camera::lookAt(double3(0), directionWorld, camera.lens, camera.exposure, up);
    return framed(along, box, aspect, margin);
}

Camera asParallel(Camera const& camera, double distanceMeters) {
    if (camera.lens.isOrthographic()) return camera;
    Camera parallel = camera;
    const double height =
            2 * distanceMeters * std::tan(glm::radians(static_cast<double>(camera.lens.verticalFovDegrees)) / 2);
    parallel.lens.orthographicHeight = static_cast<float>(height);
    parallel.lens.farMeters =
            std::max(camera.lens.farMeters, camera.lens.nearMeters + static_cast<float>(4 * distanceMeters));
    return parallel;
}

Camera asPerspective(Camera const& camera, double verticalFovDegrees, double distanceMeters) {
    Camera perspective = camera;
    const double height = camera.viewFromPicture({ 0, -1 }, distanceMeters, 1).y -
                          camera.viewFromPicture({ 0, 1 }, distanceMeters, 1).y;
    perspective.lens.orthographicHeight = 0;
    perspective.lens.verticalFovDegrees = static_cast<float>(verticalFovDegrees);
    perspective.lens.nearMeters = std::max(camera.lens.nearMeters, static_cast<float>(distanceMeters * 1e-4));
    const double distance = height / 2 / std::tan(glm::radians(verticalFovDegrees) / 2);
    return moved(perspective, { 0, 0, distance - distanceMeters });
}

Camera withPlaceOf(Camera const& current, Camera const& other) {
    Camera camera = other;
    camera.exposure = current.exposure;
    return camera;
}

} // namespace filament_core::view
