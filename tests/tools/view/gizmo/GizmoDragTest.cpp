// SPDX-License-Identifier: Apache-2.0
// Handles of nodes: what is drawn can be grabbed, and what is grabbed stays under the pointer, with every camera.
#include "tests/tools/view/gizmo/RandomGizmos.h"

#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <numbers>

namespace filament_core::view {
namespace {

Handle const* find(std::vector<Handle> const& handles, GizmoPart part) {
    for (Handle const& handle : handles)
        if (handle.part == part) return &handle;
    return nullptr;
}

GizmoPart axisPart(int axis) { return static_cast<GizmoPart>(static_cast<int>(GizmoPart::AxisX) + axis); }
GizmoPart planePart(int axis) { return static_cast<GizmoPart>(static_cast<int>(GizmoPart::PlaneX) + axis); }

TEST(GizmoHandles, HaveTheSameSizeOnTheScreenWhereverTheObjectIs) {
    Draw draw(1);
    for (int round = 0; round < kRounds; ++round) {
        RandomGizmo random(draw);
        random.frame.axes = double3x3(random.view.camera.worldFromView); // x and y across the view
        const std::vector<Handle> handles = handlesOf(GizmoMode::Move, random.frame, random.view);
        const auto origin = pixelOf(random.view, random.frame.originWorld);
        ASSERT_TRUE(origin.has_value());
        for (const GizmoPart part : { GizmoPart::AxisX, GizmoPart::AxisY }) {
            Handle const* arrow = find(handles, part);
            if (!arrow) continue; // towards the eye, beside the middle of a wide image
            ASSERT_EQ(arrow->area.size(), 3u);
            EXPECT_NEAR(glm::length(arrow->area[1] - *origin), kHandlePixels, 1e-6) << "its tip";
        }
        if (random.cosineOfView(random.frame.axes[2]) > 0.99) {
            EXPECT_EQ(find(handles, GizmoPart::AxisZ), nullptr) << "seen from its end";
        }
    }
}

/// By search along the line, not by a formula: the distance has one minimum there.
double apart(std::array<double2, 2> const& line, double2 pixel) {
    double low = 0, high = 1;
    const auto at = [&](double t) { return glm::length(line[0] + (line[1] - line[0]) * t - pixel); };
    for (int i = 0; i < 60; ++i) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
    }
    return at((low + high) / 2);
}

/// A ray to the right crosses the outline of an area an odd number of times.
bool isInside(std::vector<double2> const& area, double2 pixel) {
    bool inside = false;
    for (size_t i = 0; i < area.size(); ++i) {
        const double2 a = area[i], b = area[(i + 1) % area.size()];
        if ((a.y > pixel.y) == (b.y > pixel.y)) continue;
        if (a.x + (b.x - a.x) * (pixel.y - a.y) / (b.y - a.y) > pixel.x) inside = !inside;
    }
    return inside;
}

/// Pixels between a place and what is drawn of a handle.
double apart(Handle const& handle, double2 pixel) {
    if (isInside(handle.area, pixel)) return 0;
    double least = 1e9;
    for (auto const& line : handle.lines) least = std::min(least, apart(line, pixel));
    for (size_t i = 0; i < handle.area.size(); ++i)
        least = std::min(least, apart({ handle.area[i], handle.area[(i + 1) % handle.area.size()] }, pixel));
    return least;
}

/// What is grabbed at a pixel is the nearest handle, and only within kGrabPixels.
void expectNearest(std::vector<Handle> const& handles, double2 pixel) {
    const GizmoPart found = partAt(handles, pixel);
    double nearest = 1e9;
    for (Handle const& handle : handles) nearest = std::min(nearest, apart(handle, pixel));
    if (found == GizmoPart::None) {
        EXPECT_GT(nearest, kGrabPixels - 1e-6) << pixel.x << ", " << pixel.y;
        return;
    }
    EXPECT_LT(nearest, kGrabPixels + 1e-6) << pixel.x << ", " << pixel.y;
    EXPECT_LT(apart(*find(handles, found), pixel), nearest + 1e-6) << toString(found);
}

TEST(GizmoHandles, WhatIsDrawnCanBeGrabbedAndNothingElse) {
    Draw draw(2);
    int taken = 0, missed = 0;
    for (int round = 0; round < kRounds / 4; ++round) {
        const RandomGizmo random(draw);
        for (const GizmoMode mode : { GizmoMode::Move, GizmoMode::Rotate, GizmoMode::Scale }) {
            const std::vector<Handle> handles = handlesOf(mode, random.frame, random.view);
            EXPECT_NE(find(handles, GizmoPart::Screen), nullptr);
            for (Handle const& handle : handles) {
                for (auto const& line : handle.lines) {
                    const double2 middle = (line[0] + line[1]) * 0.5;
                    EXPECT_EQ(partAt({ handle }, middle), handle.part);
                    EXPECT_NE(partAt(handles, middle), GizmoPart::None);
                }
                double2 center(0);
                for (double2 const& point : handle.area) center += point / static_cast<double>(handle.area.size());
                if (!handle.area.empty()) {
                    EXPECT_EQ(partAt({ handle }, center), handle.part);
                }
            }
            const double2 origin = *pixelOf(random.view, random.frame.originWorld);
            for (int i = 0; i < 6; ++i) {
                const double2 pixel = origin + draw.picture() * (1.5 * kHandlePixels);
                expectNearest(handles, pixel);
                ++(partAt(handles, pixel) == GizmoPart::None ? missed : taken);
            }
        }
        EXPECT_TRUE(handlesOf(GizmoMode::Off, random.frame, random.view).empty());
    }
    EXPECT_GT(taken, kRounds / 2);
    EXPECT_GT(missed, kRounds / 2);
}

TEST(GizmoHandles, OfWhatIsBehindTheEyeThereAreNone) {
    Draw draw(3);
    for (int round = 0; round < 100; ++round) {
        RandomGizmo random(draw);
        const double3 back = double3(random.view.camera.worldFromView[2]);
        random.frame.originWorld = random.view.camera.position() + back * draw.logarithmic(0.01, 10);
        for (const GizmoMode mode : { GizmoMode::Move, GizmoMode::Rotate, GizmoMode::Scale })
            EXPECT_TRUE(handlesOf(mode, random.frame, random.view).empty());
    }
}

TEST(GizmoHandles, TheAxesOfAMatrixAreRightAngledWhateverItIs) {
    Draw draw(4);
    for (int round = 0; round < kRounds; ++round) {
        double4x4 matrix = randomPlace(draw);
        if (draw.coin()) matrix[0] += matrix[1] * draw.number(-1, 1); // shear
        if (draw.coin()) matrix[2] = -matrix[2];
        const double3x3 axes = axesOf(matrix);
        EXPECT_LT(largest(double4x4(glm::transpose(axes) * axes), double4x4(1.0)), 1e-9);
        EXPECT_GT(glm::determinant(axes), 0);
        EXPECT_LT(glm::length(axes[0] - glm::normalize(double3(matrix[0]))), 1e-12);
    }
    EXPECT_EQ(axesOf(double4x4(0.0)), double3x3(1.0));
    EXPECT_EQ(axesOf(glm::scale(double4x4(1.0), double3(1, 0, 1))), double3x3(1.0));
}

TEST(GizmoDrag, WhatIsMovedStaysUnderThePointer) {
    Draw draw(5);
    int axes = 0, planes = 0;
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const int k = round % 3;
        const double length = random.length();
        const double3 axis = random.frame.axes[k], u = random.frame.axes[(k + 1) % 3],
                      v = random.frame.axes[(k + 2) % 3];
        const double3 along = axis * (draw.number(-3, 3) * length);
        const double3 tip = random.frame.originWorld + axis * (0.7 * length);
        if (const auto drag = random.drag(GizmoMode::Move, axisPart(k), tip, tip + along);
            drag && random.cosineOfView(axis) < 0.95) {
            const double3 moved(worldChange(drag->first, drag->second)[3]);
            EXPECT_LT(glm::length(moved - along), 1e-6 * length);
            ++axes;
        }
        const double3 across = u * (draw.number(-2, 2) * length) + v * (draw.number(-2, 2) * length);
        const double3 corner = random.frame.originWorld + (u + v) * (0.4 * length);
        if (const auto drag = random.drag(GizmoMode::Move, planePart(k), corner, corner + across);
            drag && random.cosineOfView(axis) > 0.4) {
            const double3 moved(worldChange(drag->first, drag->second)[3]);
            EXPECT_LT(glm::length(moved - across), 1e-5 * length);
            ++planes;
        }
        double4x4 const& camera = random.view.camera.worldFromView;
        const double3 inView = double3(camera[0]) * (draw.number(-2, 2) * length) + double3(camera[1]) * length;
        const auto drag = random.drag(GizmoMode::Move, GizmoPart::Screen, random.frame.originWorld,
                                      random.frame.originWorld + inView);
        ASSERT_TRUE(drag.has_value());
        EXPECT_LT(glm::length(double3(worldChange(drag->first, drag->second)[3]) - inView), 1e-6 * length);
    }
    EXPECT_GT(axes, kRounds / 2);
    EXPECT_GT(planes, kRounds / 4);
}

TEST(GizmoDrag, WhatIsTurnedStaysUnderThePointer) {
    Draw draw(6);
    int rings = 0;
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const int k = round % 3;
        const double3 axis = random.frame.axes[k], origin = random.frame.originWorld;
        const double3 x = random.frame.axes[(k + 1) % 3] * random.length(), y = glm::cross(axis, x);
        const double begin = draw.number(-3, 3), angle = draw.number(-3, 3);
        const auto at = [&](double radians) { return origin + x * std::cos(radians) + y * std::sin(radians); };
        const auto drag = random.drag(GizmoMode::Rotate, axisPart(k), at(begin), at(begin + angle));
        if (!drag || random.cosineOfView(axis) < 0.4) continue;
        const double4x4 expected = rotationAbout(origin, axis, angle);
        EXPECT_LT(largest(worldChange(drag->first, drag->second), expected), 1e-6 * (1 + glm::length(origin)));
        ++rings;
    }
    EXPECT_GT(rings, kRounds / 4);
}

TEST(GizmoDrag, ARingSeenFromItsEdgeTurnsTheWayItIsPulled) {
    Draw draw(7);
    int rings = 0;
    for (int round = 0; round < kRounds; ++round) {
        RandomGizmo random(draw);
        const double3 origin = random.frame.originWorld, eye = towardsEye(random.view, origin);
        const double3 axis = glm::normalize(glm::cross(eye, randomDirection(draw)));
        random.frame.axes = double3x3(axis, eye, glm::cross(axis, eye));
        const double angle = draw.number(-0.3, 0.3);
        const double3 front = eye * random.length();
        const double3 turned = double3x3(rotationAbout(double3(0), axis, angle)) * front;
        const auto drag = random.drag(GizmoMode::Rotate, GizmoPart::AxisX, origin + front, origin + turned);
        if (!drag) continue;
        const double4x4 change = worldChange(drag->first, drag->second);
        const double3 result = double3x3(change) * front;
        EXPECT_LT(glm::length(result - turned), 0.15 * glm::length(turned - front) + 1e-9);
        ++rings;
    }
    EXPECT_GT(rings, kRounds / 2);
}

TEST(GizmoDrag, PlanesDoNotTurnAndNothingOfALightScales) {
    Draw draw(13);
    for (int round = 0; round < 100; ++round) {
        const RandomGizmo random(draw);
        const double2 from = draw.picture() * 500.0, to = draw.picture() * 500.0;
        for (const GizmoPart part : { GizmoPart::PlaneX, GizmoPart::PlaneY, GizmoPart::PlaneZ, GizmoPart::None,
                                      GizmoPart::Direction, GizmoPart::Range, GizmoPart::InnerCone }) {
            const GizmoDrag turn{ GizmoMode::Rotate, part, random.frame, random.view, from };
            EXPECT_EQ(worldChange(turn, to), double4x4(1.0)) << toString(part);
            const GizmoDrag scale{ GizmoMode::Scale, part, random.frame, random.view, from };
            if (!isPlane(part)) {
                EXPECT_EQ(scaleChange(scale, to), double3(1)) << toString(part);
            }
        }
    }
}

TEST(GizmoDrag, ScaleIsTheRatioOfTheDistances) {
    Draw draw(8);
    int checked = 0;
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const int k = round % 3;
        const double3 axis = random.frame.axes[k], origin = random.frame.originWorld;
        const double factor = draw.logarithmic(0.1, 3);
        const auto drag = random.drag(GizmoMode::Scale, axisPart(k), origin + axis * random.length(),
                                      origin + axis * (factor * random.length()));
        if (!drag || random.cosineOfView(axis) > 0.95) continue;
        double3 expected(1);
        expected[k] = factor;
        EXPECT_LT(glm::length(scaleChange(drag->first, drag->second) - expected), 1e-6);
        ++checked;
    }
    EXPECT_GT(checked, kRounds / 2);
}

TEST(GizmoDrag, ScaleNeverMirrorsOrFlattens) {
    Draw draw(9);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const auto part = static_cast<GizmoPart>(1 + round % 7);
        const GizmoDrag drag{ GizmoMode::Scale, part, random.frame, random.view, draw.picture() * 2000.0 };
        const double3 scale = scaleChange(drag, draw.picture() * 2000.0, { .scale = draw.coin() ? 0.1 : 0 });
        for (int i = 0; i < 3; ++i) {
            EXPECT_GE(scale[i], kLeastScale);
            EXPECT_LE(scale[i], kMostScale);
        }
    }
}

TEST(GizmoDrag, StepsAreRoundNumbersThatAHandCanHit) {
    Draw draw(10);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const GizmoSteps steps = stepsOf(random.frame, random.view);
        const double pixels = steps.meters / metersPerPixel(random.view, random.frame.originWorld);
        EXPECT_GE(pixels, 8 * (1 - 1e-9));
        EXPECT_LT(pixels, 20 * (1 + 1e-9));
        const int k = round % 3;
        const double2 from = draw.picture() * 500.0, to = draw.picture() * 500.0;
        const GizmoDrag drag{ GizmoMode::Move, axisPart(k), random.frame, random.view, from };
        const double moved = glm::dot(double3(worldChange(drag, to, steps)[3]), random.frame.axes[k]);
        EXPECT_NEAR(std::remainder(moved, steps.meters), 0, 1e-6 * steps.meters + 1e-12 * std::abs(moved));
        const double exact = glm::dot(double3(worldChange(drag, to)[3]), random.frame.axes[k]);
        EXPECT_LE(std::abs(moved - exact), steps.meters / 2 * (1 + 1e-6) + 1e-12 * std::abs(moved));
    }
}

TEST(GizmoDrag, NodesFollowInTheSpaceOfTheirParents) {
    Draw draw(11);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const double4x4 worldFromParent = randomPlace(draw), parentFromNode = randomPlace(draw);
        const auto part = static_cast<GizmoPart>(1 + round % 7);
        const double2 from = draw.picture() * 300.0, to = draw.picture() * 300.0;
        for (const GizmoMode mode : { GizmoMode::Move, GizmoMode::Rotate }) {
            const GizmoDrag drag{ mode, part, random.frame, random.view, from };
            const auto result = draggedNode(drag, to, {}, worldFromParent, parentFromNode);
            ASSERT_TRUE(result.has_value());
            const double4x4 expected = worldChange(drag, to) * worldFromParent * parentFromNode;
            double size = 1;
            for (int i = 0; i < 4; ++i) size += glm::length(expected[i]);
            EXPECT_LT(largest(worldFromParent * *result, expected), 1e-9 * size);
            EXPECT_EQ(glm::row(*result, 3), double4(0, 0, 0, 1)) << "affine";
        }
        const GizmoDrag drag{ GizmoMode::Scale, part, random.frame, random.view, from };
        const auto result = draggedNode(drag, to, {}, worldFromParent, parentFromNode);
        EXPECT_EQ((*result)[3], parentFromNode[3]) << "about its own origin";
    }
    const GizmoDrag drag{ GizmoMode::Move, GizmoPart::AxisX, {}, {}, {} };
    EXPECT_FALSE(draggedNode(drag, { 1, 1 }, {}, double4x4(0.0), double4x4(1.0)).has_value());
}

TEST(GizmoDrag, TheShortestRotationTurnsOneDirectionIntoTheOther) {
    Draw draw(12);
    for (int round = 0; round < kRounds; ++round) {
        const double3 a = randomDirection(draw), b = round % 10 == 0 ? -a : randomDirection(draw);
        const double3x3 turn = shortestRotation(a, b);
        EXPECT_LT(glm::length(turn * a - b), 1e-6);
        EXPECT_NEAR(glm::determinant(turn), 1, 1e-9);
    }
}

} // namespace
} // namespace filament_core::view
