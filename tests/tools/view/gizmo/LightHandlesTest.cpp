// SPDX-License-Identifier: Apache-2.0
// Handles of lights: directions, ranges and cones follow the pointer, and no drag makes a light that a document
// refuses.
#include "tools/view/gizmo/LightHandles.h"
#include "tests/tools/view/gizmo/RandomGizmos.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace filament_core::view {
namespace {

/// Where the light is what the generated handles are of.
template <class L>
GizmoLight lightAt(RandomGizmo const& random, double4x4 const& worldFromLight, double3 aimWorld, L light = {}) {
    const double4x4 lightFromWorld = glm::inverse(worldFromLight);
    if constexpr (requires { light.positionWorld; })
        light.positionWorld = double3(lightFromWorld * double4(random.frame.originWorld, 1));
    light.directionWorld = float3(double3x3(lightFromWorld) * aimWorld);
    return { .light = light, .worldFromLight = worldFromLight, .elsewhereWorld = random.frame.originWorld };
}

double3 aimOf(GizmoLight const& light, LightDesc const& dragged) {
    const double3 local = std::visit(
            [](auto const& held) {
                if constexpr (requires { held.axisWorld; })
                    return double3(held.axisWorld);
                else
                    return double3(held.directionWorld);
            },
            dragged);
    return glm::normalize(double3x3(light.worldFromLight) * local);
}

bool isSeenFromTheEye(RandomGizmo const& random, double3 direction) {
    const double3 tip = random.frame.originWorld + direction * random.length();
    return glm::dot(direction, towardsEye(random.view, tip)) > 0.1;
}

std::vector<LightDesc> lightsOfEveryKind() {
    return { SunLight{},
             PointLight{ .rangeMeters = 2 },
             SpotLight{ .rangeMeters = 3 },
             RectLight{},
             DiscLight{},
             SpotLight{ .innerConeRadians = 1.5703f, .outerConeRadians = 1.5707f },
             SpotLight{ .innerConeRadians = 0, .outerConeRadians = 0.0005f },
             TubeLight{} };
}

TEST(LightHandles, DirectionsStayUnderThePointer) {
    Draw draw(1);
    int checked = 0;
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const double3 before = randomDirection(draw), after = randomDirection(draw);
        if (!isSeenFromTheEye(random, before) || !isSeenFromTheEye(random, after)) continue;
        const GizmoLight light = lightAt<SpotLight>(random, randomPlace(draw), before);
        const GizmoFrame frame = frameOf(light, GizmoAxes::World);
        EXPECT_LT(glm::length(frame.originWorld - random.frame.originWorld),
                  1e-9 * (1 + glm::length(frame.originWorld)));
        const auto drag =
                random.drag(GizmoMode::Move, GizmoPart::Direction, random.frame.originWorld + before * random.length(),
                            random.frame.originWorld + after * random.length());
        if (!drag) continue;
        const LightDesc dragged = draggedLight(drag->first, drag->second, {}, light);
        EXPECT_LT(glm::length(aimOf(light, dragged) - after), 1e-5);
        ++checked;
    }
    EXPECT_GT(checked, kRounds / 10);
}

TEST(LightHandles, ADragPastTheOutlineReachesTheFarSide) {
    RandomGizmo random = [] {
        Draw draw(2);
        return RandomGizmo(draw);
    }();
    random.view = { Camera::lookAt({ 0, 0, 5 }, double3(0), Lens::orthographic(-1, 1, -1, 1)), { 600, 600 } };
    random.frame = { .pixels = 100 };
    const GizmoLight sun = lightAt<SunLight>(random, double4x4(1.0), double3(0, 0, 1)); // at the eye
    const GizmoDrag drag{ GizmoMode::Move, GizmoPart::Direction, random.frame, random.view, { 300, 300 } };
    double last = 2;
    for (double x = 300; x <= 500; x += 5) {
        const double3 aim = aimOf(sun, draggedLight(drag, { x, 300 }, {}, sun));
        EXPECT_LT(aim.z, last) << x;
        last = aim.z;
    }
    EXPECT_NEAR(last, -1, 1e-6);
}

TEST(LightHandles, AConeIsNeverNarrowerThanTheOneInsideOfIt) {
    Draw draw(3);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        SpotLight spot;
        spot.outerConeRadians = static_cast<float>(draw.number(0.3, 1.5));
        spot.innerConeRadians = static_cast<float>(draw.number(0, 0.25));
        const GizmoLight light = lightAt(random, double4x4(randomTurn(draw)), randomDirection(draw), spot);
        for (const GizmoPart part : { GizmoPart::OuterCone, GizmoPart::InnerCone }) {
            const GizmoDrag drag{ GizmoMode::Off, part, random.frame, random.view, draw.picture() * 500.0 };
            const SpotLight dragged = std::get<SpotLight>(draggedLight(drag, draw.picture() * 500.0, {}, light));
            EXPECT_LT(dragged.innerConeRadians, dragged.outerConeRadians);
            if (part == GizmoPart::OuterCone) {
                EXPECT_EQ(dragged.innerConeRadians, spot.innerConeRadians);
            } else {
                EXPECT_EQ(dragged.outerConeRadians, spot.outerConeRadians);
            }
        }
    }
}

TEST(LightHandles, ASpotSeenFromBesideOpensToWhereItsEdgeIsPulled) {
    const PictureView view{ Camera::lookAt({ 0, 0, 5 }, double3(0), Lens::orthographic(-1, 1, -1, 1)), { 600, 600 } };
    const GizmoFrame frame{ .pixels = 100 };
    GizmoLight light;
    light.light = SpotLight{ .directionWorld = { 1, 0, 0 }, .innerConeRadians = 0.1f, .outerConeRadians = 0.5f };
    for (const double radians : { 0.2, 0.7, 1.2 }) {
        const std::vector<Handle> handles = lightHandles(light, frame, view);
        const auto outer = std::ranges::find(handles, GizmoPart::OuterCone, &Handle::part);
        ASSERT_NE(outer, handles.end());
        const double2 dot = (outer->area[0] + outer->area[2]) * 0.5 - double2(300);
        EXPECT_NEAR(std::abs(std::atan2(dot.y, dot.x)), 0.5, 1e-6);
        const double side = dot.y > 0 ? 1 : -1;
        const double2 to = double2(300) + 100.0 * double2(std::cos(radians), side * std::sin(radians));
        const GizmoDrag drag{ GizmoMode::Off, GizmoPart::OuterCone, frame, view, dot + double2(300) };
        EXPECT_NEAR(std::get<SpotLight>(draggedLight(drag, to, {}, light)).outerConeRadians, radians, 1e-4);
        const float snapped = std::get<SpotLight>(draggedLight(drag, to, stepsOf(frame, view), light)).outerConeRadians;
        EXPECT_NEAR(std::remainder(static_cast<double>(snapped), std::numbers::pi / 36), 0, 1e-5);
    }
}

TEST(LightHandles, TheRangeIsWhereItsCircleIsPulled) {
    Draw draw(4);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        PointLight point;
        point.rangeMeters = static_cast<float>(random.length() * draw.number(0.5, 2));
        const GizmoLight light = lightAt(random, double4x4(1.0), double3(1, 0, 0), point);
        const double3 up = double3(random.view.camera.worldFromView[1]);
        const double wanted = random.length() * draw.number(0.2, 3);
        const auto drag = random.drag(GizmoMode::Move, GizmoPart::Range,
                                      random.frame.originWorld + up * static_cast<double>(point.rangeMeters),
                                      random.frame.originWorld + up * wanted);
        ASSERT_TRUE(drag.has_value());
        if (random.cosineOfView(up) > 0.95) continue;
        const PointLight dragged = std::get<PointLight>(draggedLight(drag->first, drag->second, {}, light));
        EXPECT_NEAR(dragged.rangeMeters, std::max(wanted, 0.001), 1e-4 * wanted + 1e-6);
    }
}

TEST(LightHandles, MovedAndTurnedLightsAreWhereTheirHandlesSay) {
    Draw draw(5);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const double3 aim = randomDirection(draw);
        const GizmoLight light = lightAt<SpotLight>(random, randomPlace(draw), aim);
        const auto part = static_cast<GizmoPart>(1 + round % 7);
        const double2 from = draw.picture() * 300.0, to = draw.picture() * 300.0;
        for (const GizmoMode mode : { GizmoMode::Move, GizmoMode::Rotate }) {
            const GizmoDrag drag{ mode, part, random.frame, random.view, from };
            GizmoLight dragged = light;
            dragged.light = draggedLight(drag, to, {}, light);
            const double4x4 change = worldChange(drag, to);
            const double3 place(change * double4(random.frame.originWorld, 1));
            EXPECT_LT(glm::length(frameOf(dragged, GizmoAxes::World).originWorld - place),
                      1e-6 * (1 + glm::length(place)));
            EXPECT_LT(glm::length(aimOf(dragged, dragged.light) - double3x3(change) * aim), 1e-5);
        }
    }
}

TEST(LightHandles, NoDragMakesALightThatADocumentRefuses) {
    Draw draw(6);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        for (LightDesc const& any : lightsOfEveryKind()) {
            const auto mode = static_cast<GizmoMode>(round % 4);
            const auto part = static_cast<GizmoPart>(round % 12);
            GizmoLight light{ .light = any, .worldFromLight = randomPlace(draw) };
            const GizmoFrame frame = frameOf(light, draw.coin() ? GizmoAxes::Local : GizmoAxes::World);
            const GizmoDrag drag{ mode, part, frame, random.view, draw.picture() * 2000.0 };
            const GizmoSteps steps = draw.coin() ? stepsOf(frame, random.view) : GizmoSteps{};
            Document document;
            document.lights = { { .light = draggedLight(drag, draw.picture() * 2000.0, steps, light) } };
            const Result<void> checked = check(document);
            EXPECT_TRUE(checked.ok()) << checked.error().message;
        }
    }
}

TEST(LightHandles, TheUpOfAnAimedAreaTurnsWithItsAim) {
    Draw draw(8);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const GizmoLight light{ .light = RectLight{} };
        const GizmoDrag drag{ GizmoMode::Off, GizmoPart::Direction, frameOf(light, GizmoAxes::World), random.view,
                              draw.picture() * 2000.0 };
        const LightDesc dragged = draggedLight(drag, draw.picture() * 2000.0, {}, light);
        auto const& area = std::get<RectLight>(dragged);
        EXPECT_NEAR(glm::dot(area.directionWorld, area.upWorld), 0, 1e-5f);
        EXPECT_NEAR(glm::length(area.upWorld), 1, 1e-5f);
    }
}

TEST(LightHandles, EachKindHasThoseOfItsFields) {
    const PictureView view{ Camera::lookAt({ 1, 2, 5 }, double3(0)), { 640, 360 } };
    const auto partsOf = [&](GizmoLight const& light) {
        std::vector<GizmoPart> parts;
        for (Handle const& handle : lightHandles(light, {}, view))
            if (handle.part != GizmoPart::None) parts.push_back(handle.part);
        return parts;
    };
    using Parts = std::vector<GizmoPart>;
    EXPECT_EQ(partsOf({ .light = SunLight{} }), Parts({ GizmoPart::Direction }));
    EXPECT_EQ(partsOf({ .light = PointLight{} }), Parts());
    EXPECT_EQ(partsOf({ .light = PointLight{ .rangeMeters = 1 } }), Parts({ GizmoPart::Range }));
    EXPECT_EQ(partsOf({ .light = PointLight{}, .hasProfile = true }), Parts({ GizmoPart::Direction }));
    EXPECT_EQ(partsOf({ .light = SpotLight{ .rangeMeters = 1 } }),
              Parts({ GizmoPart::Direction, GizmoPart::OuterCone, GizmoPart::InnerCone, GizmoPart::Range }));
    EXPECT_EQ(partsOf({ .light = TubeLight{} }), Parts({ GizmoPart::Direction }));
}

} // namespace
} // namespace filament_core::view
