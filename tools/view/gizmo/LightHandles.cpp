// SPDX-License-Identifier: Apache-2.0
#include "tools/view/gizmo/LightHandles.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core::view {
namespace {

constexpr double kDotPixels = 11;
constexpr float kLeastRange = 0.001f;

template <class L>
concept HasPosition = requires(L light) {
    light.positionWorld;
};
template <class L>
concept HasRange = requires(L light) {
    light.rangeMeters;
};

/// The direction or the axis of a light.
template <class L>
auto* axisIn(L& light) {
    if constexpr (requires { light.axisWorld; })
        return &light.axisWorld;
    else
        return &light.directionWorld;
}

bool isAimed(GizmoLight const& light) { return light.hasProfile || !std::holds_alternative<PointLight>(light.light); }

/// In the world, of length 1.
double3 aimOf(LightDesc const& any, double4x4 const& worldFromLight) {
    const double3 local = std::visit([](auto const& light) { return double3(*axisIn(light)); }, any);
    const double3 aim = double3x3(worldFromLight) * local;
    return glm::length(aim) > 0 ? glm::normalize(aim) : double3(0, 0, -1);
}

/// Across the aim, and as far across the view as it can be.
double3 besideAim(double3 aim, GizmoFrame const& frame, PictureView const& view) {
    const double3 beside = glm::cross(aim, towardsEye(view, frame.originWorld));
    if (glm::length(beside) > 1e-6) return glm::normalize(beside);
    const double3 right = double3(view.camera.worldFromView[0]);
    return glm::normalize(right - aim * glm::dot(aim, right));
}

struct Cone {
    GizmoPart part;
    double radians, side; ///< side: of besideAim(), 1 or -1
};

std::vector<Cone> conesOf(LightDesc const& any) {
    auto const* spot = std::get_if<SpotLight>(&any);
    if (!spot) return {};
    return { { GizmoPart::OuterCone, static_cast<double>(spot->outerConeRadians), 1 },
             { GizmoPart::InnerCone, static_cast<double>(spot->innerConeRadians), -1 } };
}

struct Handles {
    GizmoFrame const& frame;
    PictureView const& view;
    double length; ///< metres
    std::vector<Handle> handles{};
    Handle lines{}; ///< without a part

    void addDot(GizmoPart part, double3 atWorld) {
        Handle handle{ .part = part };
        view::addDot(handle, view, atWorld, kDotPixels * frame.pixels / kHandlePixels);
        handles.push_back(std::move(handle));
    }

    void addDirection(double3 aim) {
        addDot(GizmoPart::Direction, frame.originWorld + aim * length);
        addLine(lines, view, frame.originWorld, frame.originWorld + aim * length);
    }

    void addCone(Cone const& cone, double3 aim, double3 beside) {
        const double3 center = frame.originWorld + aim * (std::cos(cone.radians) * length);
        const double3 x = beside * (std::sin(cone.radians) * length), y = glm::cross(aim, x);
        addDot(cone.part, center + cone.side * x);
        addCircle(lines, view, center, x, y);
        for (const double side : { 1.0, -1.0 }) addLine(lines, view, frame.originWorld, center + side * x);
    }

    void addRange(double meters) {
        const double3 right = double3(view.camera.worldFromView[0]), up = double3(view.camera.worldFromView[1]);
        addDot(GizmoPart::Range, frame.originWorld + up * meters);
        addCircle(lines, view, frame.originWorld, right * meters, up * meters);
    }
};

double rangeOf(LightDesc const& any) {
    return std::visit(
            [](auto const& light) {
                if constexpr (HasRange<std::remove_cvref_t<decltype(light)>>)
                    return static_cast<double>(light.rangeMeters);
                else
                    return 0.0;
            },
            any);
}

/// Where a pixel is on the sphere around the origin on which the tips of the handles are, as a direction.
double3 onSphereOf(GizmoDrag const& drag, double2 pixel, bool isNearSide) {
    const double radius = handleMeters(drag.frame, drag.view);
    const double3 at = onSphere(rayThrough(drag.view, pixel), drag.frame.originWorld, radius, isNearSide);
    return (at - drag.frame.originWorld) / radius;
}

bool isNear(GizmoDrag const& drag, double3 direction) {
    const double3 origin = drag.frame.originWorld;
    const double3 tip = origin + direction * handleMeters(drag.frame, drag.view);
    return glm::dot(direction, towardsEye(drag.view, tip)) >= 0; // this side of the sphere's outline
}

/// Heading about +Y and elevation in whole steps.
double3 snappedDirection(double3 direction, double step) {
    if (!(step > 0)) return direction;
    const double elevation = snapped(std::asin(std::clamp(direction.y, -1.0, 1.0)), step);
    const double heading = snapped(std::atan2(direction.x, direction.z), step);
    return { std::cos(elevation) * std::sin(heading), std::sin(elevation), std::cos(elevation) * std::cos(heading) };
}

/// Everything of the light that has a direction.
void turn(LightDesc& any, double3x3 const& rotation) {
    std::visit(
            [&]<class L>(L& light) {
                *axisIn(light) = float3(rotation * double3(*axisIn(light)));
                if constexpr (requires { light.upWorld; }) light.upWorld = float3(rotation * double3(light.upWorld));
            },
            any);
}

/// And everything that has a place.
void transform(LightDesc& any, double4x4 const& change) {
    std::visit(
            [&]<class L>(L& light) {
                if constexpr (HasPosition<L>) light.positionWorld = double3(change * double4(light.positionWorld, 1));
            },
            any);
    turn(any, double3x3(change));
}

void setAim(LightDesc& any, GizmoDrag const& drag, double2 to, GizmoSteps const& steps,
            double4x4 const& worldFromLight) {
    const double3 before = aimOf(any, worldFromLight);
    const bool isNearSide = isNear(drag, before);
    const double3x3 way = shortestRotation(onSphereOf(drag, drag.from, isNearSide), onSphereOf(drag, to, isNearSide));
    const double3 aim = snappedDirection(way * before, steps.radians);
    const double3x3 toWorld(worldFromLight), toLight = glm::inverse(toWorld);
    turn(any, toLight * shortestRotation(before, aim) * toWorld);
    std::visit([&](auto& light) { *axisIn(light) = float3(glm::normalize(toLight * aim)); }, any); // exactly
}

void setRange(LightDesc& any, GizmoDrag const& drag, double2 to, GizmoSteps const& steps) {
    const double3 up = double3(drag.view.camera.worldFromView[1]), origin = drag.frame.originWorld;
    const double moved =
            alongLine(rayThrough(drag.view, to), origin, up) - alongLine(rayThrough(drag.view, drag.from), origin, up);
    const double range = snapped(rangeOf(any) + moved, steps.meters);
    std::visit(
            [&]<class L>(L& light) {
                if constexpr (HasRange<L>) light.rangeMeters = std::max(static_cast<float>(range), kLeastRange);
            },
            any);
}

void setCone(SpotLight& light, GizmoDrag const& drag, double2 to, GizmoSteps const& steps,
             double4x4 const& worldFromLight) {
    const double3 aim = aimOf(light, worldFromLight);
    const bool isOuter = drag.part == GizmoPart::OuterCone;
    const double before = static_cast<double>(isOuter ? light.outerConeRadians : light.innerConeRadians);
    const double3 beside = besideAim(aim, drag.frame, drag.view) * (isOuter ? 1.0 : -1.0);
    const bool isNearSide = isNear(drag, aim * std::cos(before) + beside * std::sin(before));
    const auto angleAt = [&](double2 pixel) {
        const double3 at = onSphereOf(drag, pixel, isNearSide);
        return std::atan2(glm::dot(at, beside), glm::dot(at, aim)); // below 0 beyond the axis
    };
    const auto angle = static_cast<float>(snapped(before + angleAt(to) - angleAt(drag.from), steps.radians / 3));
    if (isOuter)
        light.outerConeRadians = std::clamp(angle, std::min(light.innerConeRadians + kLeastCone, kMostCone), kMostCone);
    else
        light.innerConeRadians = std::clamp(angle, 0.0f, std::max(light.outerConeRadians - kLeastCone, 0.0f));
}

} // namespace

GizmoFrame frameOf(GizmoLight const& light, GizmoAxes axes) {
    GizmoFrame frame{ .originWorld = light.elsewhereWorld };
    std::visit(
            [&]<class L>(L const& held) {
                if constexpr (HasPosition<L>)
                    frame.originWorld = double3(light.worldFromLight * double4(held.positionWorld, 1));
            },
            light.light);
    if (axes == GizmoAxes::Local && isAimed(light))
        frame.axes = double3x3(Camera::lookAt(double3(0), aimOf(light.light, light.worldFromLight)).worldFromView);
    return frame;
}

std::vector<Handle> lightHandles(GizmoLight const& light, GizmoFrame const& frame, PictureView const& view) {
    if (!(depthOf(view, frame.originWorld) > static_cast<double>(view.camera.lens.nearMeters))) return {};
    Handles all{ frame, view, handleMeters(frame, view) };
    if (isAimed(light)) {
        const double3 aim = aimOf(light.light, light.worldFromLight), beside = besideAim(aim, frame, view);
        all.addDirection(aim);
        for (Cone const& cone : conesOf(light.light)) all.addCone(cone, aim, beside);
    }
    if (const double range = rangeOf(light.light); range > 0) all.addRange(range);
    all.handles.push_back(std::move(all.lines));
    return std::move(all.handles);
}

LightDesc draggedLight(GizmoDrag const& drag, double2 to, GizmoSteps const& steps, GizmoLight const& light) {
    double4x4 const& worldFromLight = light.worldFromLight;
    if (!(std::abs(glm::determinant(double3x3(worldFromLight))) > 0)) return light.light;
    LightDesc result = light.light;
    if (drag.part == GizmoPart::Direction) {
        setAim(result, drag, to, steps, worldFromLight);
    } else if (drag.part == GizmoPart::Range) {
        setRange(result, drag, to, steps);
    } else if (drag.part == GizmoPart::OuterCone || drag.part == GizmoPart::InnerCone) {
        if (auto* spot = std::get_if<SpotLight>(&result)) setCone(*spot, drag, to, steps, worldFromLight);
    } else if (drag.mode == GizmoMode::Move || drag.mode == GizmoMode::Rotate) {
        transform(result, glm::inverse(worldFromLight) * worldChange(drag, to, steps) * worldFromLight);
    }
    return result;
}

} // namespace filament_core::view
