// SPDX-License-Identifier: Apache-2.0
#include "tools/view/gizmo/GizmoHandles.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace filament_core::view {
namespace {

// Shares of the length of an arrow.
constexpr double kArrowBegin = 0.15, kTip = 0.16, kPlaneBegin = 0.3, kPlaneEnd = 0.5, kCenter = 0.1, kOuterRing = 1.2;
constexpr double kLeastSine = 0.2;  // of the angle between the view and an arrow, or a plane, that can be dragged
constexpr double kRingBehind = 0.1; // of its radius: how much of a ring is seen beyond its outline
constexpr int kCircleLines = 64;

/// Calls visit(from, to) for the sides of a polygon in the circle of radius 1.
template <class Visit>
void forCircle(Visit const& visit) {
    double2 last(1, 0);
    for (int i = 1; i <= kCircleLines; ++i) {
        const double angle = 2 * std::numbers::pi * i / kCircleLines;
        const double2 next(std::cos(angle), std::sin(angle));
        visit(last, next);
        last = next;
    }
}

struct Builder {
    GizmoMode mode;
    GizmoFrame const& frame;
    PictureView const& view;
    double length; ///< metres
    std::vector<Handle> handles{};

    double3 at(double3 inAxes) const { return frame.originWorld + frame.axes * (inAxes * length); }
    double cosineOfView(int axis) const {
        return std::abs(glm::dot(frame.axes[axis], towardsEye(view, frame.originWorld)));
    }

    void addCenter() {
        Handle handle{ .part = GizmoPart::Screen };
        addDot(handle, view, frame.originWorld, 2 * kCenter * frame.pixels);
        handles.push_back(std::move(handle));
    }

    void addAxis(int axis) {
        const double cosine = cosineOfView(axis);
        if (cosine * cosine > 1 - kLeastSine * kLeastSine) return;
        Handle handle{ .part = static_cast<GizmoPart>(static_cast<int>(GizmoPart::AxisX) + axis) };
        double3 direction(0);
        direction[axis] = 1;
        addLine(handle, view, at(direction * kArrowBegin), at(direction));
        if (mode == GizmoMode::Scale)
            addDot(handle, view, at(direction), kTip * frame.pixels);
        else
            addTip(handle, at(direction * (1 - kTip)), at(direction));
        handles.push_back(std::move(handle));
    }

    void addTip(Handle& handle, double3 baseWorld, double3 tipWorld) const {
        const auto base = pixelOf(view, baseWorld), tip = pixelOf(view, tipWorld);
        if (!base || !tip || glm::length(*tip - *base) == 0) return;
        const double2 along = glm::normalize(*tip - *base);
        const double2 across = double2(-along.y, along.x) * (kTip / 2 * frame.pixels);
        handle.area = { *base - across, *tip, *base + across };
    }

    void addPlane(int axis) {
        if (cosineOfView(axis) < kLeastSine) return;
        Handle handle{ .part = static_cast<GizmoPart>(static_cast<int>(GizmoPart::PlaneX) + axis) };
        double3 u(0), v(0);
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
        const std::array<double3, 4> corners{ u * kPlaneBegin + v * kPlaneBegin, u * kPlaneEnd + v * kPlaneBegin,
                                              u * kPlaneEnd + v * kPlaneEnd, u * kPlaneBegin + v * kPlaneEnd };
        for (double3 const& corner : corners) {
            const std::optional<double2> pixel = pixelOf(view, at(corner));
            if (!pixel) return;
            handle.area.push_back(*pixel);
        }
        handles.push_back(std::move(handle));
    }

    /// The half of the ring that faces the eye.
    void addRing(int axis) {
        Handle handle{ .part = static_cast<GizmoPart>(static_cast<int>(GizmoPart::AxisX) + axis) };
        const double3 x = frame.axes[(axis + 1) % 3], y = frame.axes[(axis + 2) % 3];
        const double3 eye = towardsEye(view, frame.originWorld);
        forCircle([&](double2 from, double2 to) {
            const double3 begin = x * from.x + y * from.y, end = x * to.x + y * to.y;
            const bool isInFront = glm::dot(begin + end, eye) / 2 > -kRingBehind;
            if (isInFront) addLine(handle, view, frame.originWorld + begin * length, frame.originWorld + end * length);
        });
        handles.push_back(std::move(handle));
    }

    void addOuterRing() {
        const std::optional<double2> center = pixelOf(view, frame.originWorld);
        if (!center) return;
        Handle handle{ .part = GizmoPart::Screen };
        const double radius = kOuterRing * frame.pixels;
        forCircle([&](double2 from, double2 to) {
            handle.lines.push_back({ *center + radius * from, *center + radius * to });
        });
        handles.push_back(std::move(handle));
    }
};

double distanceTo(std::array<double2, 2> const& line, double2 pixel) {
    const double2 along = line[1] - line[0];
    const double square = glm::dot(along, along);
    const double t = square > 0 ? std::clamp(glm::dot(pixel - line[0], along) / square, 0.0, 1.0) : 0.0;
    return glm::length(pixel - line[0] - along * t);
}

double cross(double2 a, double2 b) { return a.x * b.y - a.y * b.x; }

bool contains(std::vector<double2> const& area, double2 pixel) {
    bool left = false, right = false;
    for (size_t i = 0; i < area.size(); ++i) {
        const double side = cross(area[(i + 1) % area.size()] - area[i], pixel - area[i]);
        left |= side > 0;
        right |= side < 0;
    }
    return area.size() > 2 && !(left && right);
}

double distanceTo(Handle const& handle, double2 pixel) {
    double least = std::numeric_limits<double>::infinity();
    if (contains(handle.area, pixel)) return 0;
    for (auto const& line : handle.lines) least = std::min(least, distanceTo(line, pixel));
    for (size_t i = 0; i < handle.area.size(); ++i)
        least = std::min(least, distanceTo({ handle.area[i], handle.area[(i + 1) % handle.area.size()] }, pixel));
    return least;
}

} // namespace

std::string_view toString(GizmoMode mode) {
    constexpr std::array<std::string_view, 4> kNames{ "off", "move", "rotate", "scale" };
    return kNames[static_cast<size_t>(mode)];
}

std::string_view toString(GizmoAxes axes) { return axes == GizmoAxes::Local ? "own axes" : "axes of the world"; }

std::string_view toString(GizmoPart part) {
    constexpr std::array<std::string_view, 12> kNames{ "",          "x",       "y",          "z",
                                                       "y and z",   "z and x", "x and y",    "the view",
                                                       "direction", "range",   "outer cone", "inner cone" };
    return kNames[static_cast<size_t>(part)];
}

bool isAxis(GizmoPart part) { return part >= GizmoPart::AxisX && part <= GizmoPart::AxisZ; }
bool isPlane(GizmoPart part) { return part >= GizmoPart::PlaneX && part <= GizmoPart::PlaneZ; }
int axisOf(GizmoPart part) {
    return static_cast<int>(part) - static_cast<int>(isPlane(part) ? GizmoPart::PlaneX : GizmoPart::AxisX);
}

double3x3 axesOf(double4x4 const& worldFromNode) {
    double3x3 axes(worldFromNode);
    for (int i = 0; i < 3; ++i) {
        for (int before = 0; before < i; ++before) axes[i] -= axes[before] * glm::dot(axes[before], axes[i]);
        const double length = glm::length(axes[i]);
        const double whole = glm::length(double3(worldFromNode[i]));
        if (!(length > 1e-9 * whole)) return double3x3(1.0); // nor is it larger if the axis is 0
        axes[i] /= length;
    }
    if (glm::determinant(axes) < 0) axes[2] = -axes[2];
    return axes;
}

double handleMeters(GizmoFrame const& frame, PictureView const& view) {
    return frame.pixels * metersPerPixel(view, frame.originWorld);
}

std::vector<Handle> handlesOf(GizmoMode mode, GizmoFrame const& frame, PictureView const& view) {
    const double depth = depthOf(view, frame.originWorld);
    if (mode == GizmoMode::Off || !(depth > static_cast<double>(view.camera.lens.nearMeters))) return {};
    Builder builder{ mode, frame, view, handleMeters(frame, view) };
    if (mode == GizmoMode::Rotate) {
        for (int axis = 0; axis < 3; ++axis) builder.addRing(axis);
        builder.addOuterRing();
        return std::move(builder.handles);
    }
    builder.addCenter();
    for (int axis = 0; axis < 3; ++axis) builder.addAxis(axis);
    for (int axis = 0; axis < 3; ++axis) builder.addPlane(axis);
    return std::move(builder.handles);
}

GizmoPart partAt(std::vector<Handle> const& handles, double2 pixel, double scale) {
    double least = kGrabPixels * scale;
    GizmoPart found = GizmoPart::None;
    for (Handle const& handle : handles) {
        if (handle.part == GizmoPart::None) continue;
        const double distance = distanceTo(handle, pixel);
        if (distance > least || (distance == least && found != GizmoPart::None)) continue;
        least = distance;
        found = handle.part;
    }
    return found;
}

void addLine(Handle& handle, PictureView const& view, double3 fromWorld, double3 toWorld) {
    if (!view.camera.lens.isOrthographic()) {
        const double from = depthOf(view, fromWorld), to = depthOf(view, toWorld);
        const double least = static_cast<double>(view.camera.lens.nearMeters);
        if (!(std::max(from, to) > least)) return;
        const double3 cut = from == to ? fromWorld : glm::mix(fromWorld, toWorld, (least - from) / (to - from));
        if (from < least) fromWorld = cut;
        if (to < least) toWorld = cut;
    }
    const auto a = pixelOf(view, fromWorld), b = pixelOf(view, toWorld);
    if (a && b) handle.lines.push_back({ *a, *b });
}

void addCircle(Handle& handle, PictureView const& view, double3 centerWorld, double3 x, double3 y) {
    forCircle([&](double2 from, double2 to) {
        addLine(handle, view, centerWorld + x * from.x + y * from.y, centerWorld + x * to.x + y * to.y);
    });
}

void addDot(Handle& handle, PictureView const& view, double3 atWorld, double pixels) {
    const std::optional<double2> at = pixelOf(view, atWorld);
    if (!at) return;
    const double half = pixels / 2;
    handle.area = { *at + double2(-half, -half), *at + double2(half, -half), *at + double2(half, half),
                    *at + double2(-half, half) };
}

} // namespace filament_core::view
