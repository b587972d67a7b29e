// SPDX-License-Identifier: Apache-2.0
// The views of shadow maps: everything that must be in a map is in it, and maps hold still.
#include "filament_core/prepare/FitShadows.h"

#include "shaders/lib/LibCpp.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace filament_core::prepare {
namespace {

constexpr double kSize = 1024; // texels

double3 direction(Random& random) {
    for (;;) {
        const double3 d(random.within(-1, 1), random.within(-1, 1), random.within(-1, 1));
        if (glm::dot(d, d) > 0.01 && glm::dot(d, d) < 1) return glm::normalize(d);
    }
}

ViewInput lookingAround(Random& random, double3 origin) {
    const double3 eye = origin + double3(random.within(-50, 50), random.within(-5, 50), random.within(-50, 50));
    const auto fov = static_cast<float>(random.within(5, 150));
    return { .camera = Camera::lookAt(eye, eye + direction(random), { .verticalFovDegrees = fov }),
             .size = { 100 + random.next() % 1900, 100 + random.next() % 1900 } };
}

LightSpaceBox boxOf(double3 center, double halfExtent, double3x3 const& axes) {
    return inLightSpace(axes, center, float3(static_cast<float>(halfExtent)));
}

/// A point of the world in texels of the map, and its depth.
double3 inMap(FittedShadow const& fitted, double3 world) {
    const float4x4 atlas = atlasFromWorld(fitted, fitted.camera.position(), 0, 0, kSize);
    const double4 at = double4x4(atlas) * double4(world - fitted.camera.position(), 1);
    return double3(at) / at.w;
}

TEST(FitShadows, ACascadeHoldsItsWholeSliceOfTheFrustum) {
    Random random(1);
    for (int i = 0; i < 3000; ++i) {
        const double3 origin = i % 3 ? double3(0) : double3(1e7, -3e6, 2e7);
        const ViewInput view = lookingAround(random, origin);
        const ViewSpace space = makeViewSpace(view);
        const double3x3 axes = worldFromLight(direction(random));
        const double nearest = random.within(0.01, 10), farthest = nearest * random.within(1.1, 300);
        bool covers = true;
        const LightSpaceBox scene = boxOf(space.cameraWorld, 1e6, axes);
        const FittedShadow fitted = fitCascade(space, { nearest, farthest }, axes, scene, covers);
        ASSERT_FALSE(covers);
        for (int corner = 0; corner < 8; ++corner) {
            const double depth = corner & 4 ? farthest : nearest;
            const double x = (corner & 1 ? depth : -depth) / static_cast<double>(space.clipFromView[0][0]);
            const double y = (corner & 2 ? depth : -depth) / static_cast<double>(space.clipFromView[1][1]);
            const double3 world = double3(view.camera.worldFromView * double4(x, y, -depth, 1));
            const double3 at = inMap(fitted, world);
            EXPECT_GT(std::min(at.x, at.y), 3) << i;
            EXPECT_LT(std::max(at.x, at.y), kSize - 3) << i;
            EXPECT_GE(at.z, 0);
            EXPECT_LE(at.z, 1);
        }
    }
}

TEST(FitShadows, AMapOfAWholeSceneHoldsAllOfItAndDoesNotDependOnTheCamera) {
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const double3x3 axes = worldFromLight(direction(random));
        const double half = std::pow(10.0, random.within(-4, 2));
        const double3 center(random.within(-1e5, 1e5), 3, -7);
        const LightSpaceBox scene = boxOf(center, half, axes);
        bool covers = false;
        const auto fit = [&] {
            const double3 eye = center + direction(random) * half * 10.0;
            const ViewSpace space = makeViewSpace({ .camera = Camera::lookAt(eye, center), .size = { 640, 480 } });
            return fitCascade(space, { half, 100 * half }, axes, scene, covers);
        };
        const FittedShadow first = fit(), second = fit();
        EXPECT_TRUE(covers);
        EXPECT_EQ(std::memcmp(&first.camera.worldFromView, &second.camera.worldFromView, sizeof(double4x4)), 0);
        EXPECT_EQ(first.clipFromView, second.clipFromView);
        for (int corner = 0; corner < 8; ++corner) {
            const double3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
            const double3 at = inMap(first, center + sign * half);
            EXPECT_GT(std::min(at.x, at.y), 3) << i << ' ' << half;
            EXPECT_LT(std::max(at.x, at.y), kSize - 3);
            EXPECT_GE(at.z, 0);
            EXPECT_LE(at.z, 1);
        }
    }
}

// What the texels of a map depend on is the same to the bit, or moved by a whole number of texels.
TEST(FitShadows, CascadesMoveInWholeTexelsAndSeldom) {
    Random random(3);
    uint32_t changes = 0, steps = 0;
    for (int walk = 0; walk < 50; ++walk) {
        const double3x3 axes = worldFromLight(direction(random));
        ViewInput view = lookingAround(random, double3(random.within(-1e6, 1e6)));
        const LightSpaceBox scene = boxOf(view.camera.position(), 1e5, axes);
        const double farthest = random.within(5, 50);
        bool covers = false;
        FittedShadow before = fitCascade(makeViewSpace(view), { 0.1, farthest }, axes, scene, covers);
        const double texel = static_cast<double>(before.widthMeters) / kSize;
        double3 at = view.camera.position();
        for (int step = 0; step < 100; ++step, ++steps) {
            at += direction(random) * texel * 0.5;
            view.camera = Camera::lookAt(at, at + direction(random), view.camera.lens); // turns all around
            const FittedShadow now = fitCascade(makeViewSpace(view), { 0.1, farthest }, axes, scene, covers);
            EXPECT_EQ(now.clipFromView, before.clipFromView);
            const double3 moved = (now.camera.position() - before.camera.position()) * axes / texel;
            EXPECT_NEAR(moved.x, std::round(moved.x), 1e-3);
            EXPECT_NEAR(moved.y, std::round(moved.y), 1e-3);
            EXPECT_NEAR(moved.z, std::round(moved.z), 1e-3);
            changes += now.camera.position() != before.camera.position();
            before = now;
        }
    }
    EXPECT_GT(changes, 0u) << "turning moves the centre of what is seen";
    EXPECT_LT(changes, steps);
}

TEST(FitShadows, AStillEyeMovedByPartsOfATexelChangesNothingMostOfTheTime) {
    Random random(4);
    const double3x3 axes = worldFromLight({ -0.4, -1, -0.6 });
    uint32_t changes = 0;
    bool covers = false;
    double3 at(0, 2, 0);
    const auto fit = [&] {
        const ViewSpace space = makeViewSpace({ .camera = Camera::lookAt(at, at + double3(0.3, -0.2, -1)) });
        return fitCascade(space, { 0.1, 20 }, axes, boxOf({}, 1e4, axes), covers);
    };
    FittedShadow before = fit();
    const double texel = static_cast<double>(before.widthMeters) / kSize;
    for (int step = 0; step < 2000; ++step) {
        at.x += 0.25 * texel;
        const FittedShadow now = fit();
        changes += std::memcmp(&now.camera.worldFromView, &before.camera.worldFromView, sizeof(double4x4)) != 0;
        before = now;
    }
    EXPECT_LE(changes, 3 * 2000u / 256) << "along each axis once in 64 texels";
    EXPECT_GT(changes, 0u);
}

TEST(FitShadows, SplitsMeetAndEndWhereTheRangeEnds) {
    for (const uint32_t count : { 1u, 2u, 3u, 4u }) {
        const auto slices = splitDepth({ 0.5, 80 }, count);
        EXPECT_LE(slices[0].nearest, 0.5);
        EXPECT_GE(slices[count - 1].farthest, 80);
        EXPECT_LT(slices[count - 1].farthest, 80 * 1.2);
        for (uint32_t i = 0; i + 1 < count; ++i) {
            EXPECT_EQ(slices[i].farthest, slices[i + 1].nearest);
            EXPECT_LT(slices[i].nearest, slices[i].farthest);
        }
    }
}

TEST(FitShadows, SpotsAndCubesSeeEveryDirectionInWhichTheyShine) {
    Random random(6);
    for (int i = 0; i < 5000; ++i) {
        scene::LightRecord light{ .type = i % 2 ? scene::LightRecord::Type::Spot : scene::LightRecord::Type::Point,
                                  .positionWorld = { random.within(-1e6, 1e6), 2, 3 },
                                  .directionWorld = float3(direction(random)),
                                  .outerConeRadians = static_cast<float>(random.within(1e-4, 1.5707)) };
        const double3 axis(light.directionWorld);
        double3 ray = direction(random);
        if (light.type == scene::LightRecord::Type::Spot) { // on the edge of the cone
            const double3 side = glm::normalize(glm::cross(axis, ray));
            const auto angle = static_cast<double>(light.outerConeRadians);
            ray = axis * std::cos(angle) + side * std::sin(angle);
        }
        bool isSeen = false;
        for (uint32_t face = 0; face < (takesCube(light) ? kCubeFaces : 1); ++face) {
            const bool shines = !takesCube(light) || shinesThrough(light, face);
            const FittedShadow fitted = fitPunctual(light, face);
            const double3 at = inMap(fitted, light.positionWorld + ray * 5.0);
            const bool inFront = glm::dot(ray, -double3(fitted.camera.worldFromView[2])) > 0;
            if (!inFront || std::min(at.x, at.y) < 3 || std::max(at.x, at.y) > kSize - 3) continue;
            EXPECT_TRUE(shines) << "face " << face << " is left out, but light goes through it";
            EXPECT_GT(at.z, 0);
            EXPECT_LT(at.z, 1);
            isSeen = true;
        }
        EXPECT_TRUE(isSeen) << i;
    }
}

TEST(FitShadows, CubesHaveTheFacesThatShadersLookUp) {
    const scene::LightRecord light{ .type = scene::LightRecord::Type::Point };
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const float3 along(direction(random));
        const int face = shader::lib::cubeFace(along);
        const float3 size = glm::abs(along), turned = shader::lib::inCubeFace(along, face);
        EXPECT_EQ(turned.z, std::max({ size.x, size.y, size.z })) << face << ": the face ahead";
        EXPECT_EQ(shader::lib::fromCubeFace(turned, face), along) << face;
        // From -1 to 1 over the map.
        const float4x4 map = atlasFromWorld(fitPunctual(light, static_cast<uint32_t>(face)), {}, -1, -1, 2);
        const float4 at = map * float4(along, 1);
        const float2 expected = float2(turned) / (turned.z * shader::lib::kFaceTangent);
        EXPECT_NEAR(at.w, turned.z, 1e-6f) << face;
        EXPECT_LT(glm::distance(float2(at.x, at.y) / at.w, expected), 1e-5f) << face;
    }
}

TEST(FitShadows, NumbersThatAreNoneAreLeftOut) {
    const double3x3 axes = worldFromLight({ 0, -1, 0 });
    EXPECT_TRUE(inLightSpace(axes, double3(NAN, 0, 0), float3(1)).isEmpty());
    EXPECT_TRUE(inLightSpace(axes, double3(0), float3(INFINITY, 1, 1)).isEmpty());
    EXPECT_FALSE(inLightSpace(axes, double3(0), float3(0)).isEmpty());
}

TEST(FitShadows, AxesAreRigidForAnyDirection) {
    Random random(8);
    for (int i = 0; i < 1000; ++i) {
        const double3 d = i < 6 ? double3(i == 0, i == 1, i == 2) - double3(i == 3, i == 4, i == 5) : direction(random);
        const double3x3 axes = worldFromLight(d);
        EXPECT_NEAR(glm::determinant(axes), 1, 1e-12);
        EXPECT_NEAR(glm::dot(axes[2], d), -1, 1e-12);
        EXPECT_NEAR(glm::dot(axes[0], axes[1]), 0, 1e-12);
    }
}

// A light of radius r at distance d, with a caster at c: similar triangles make the penumbra r (d - c) / c wide, to
// each side of the edge.
TEST(PenumbraOfDepth, FollowsSimilarTriangles) {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const double receiver = std::pow(10.0, random.within(-2, 3)), caster = receiver * random.within(0.01, 1);
        const auto radius = static_cast<float>(random.within(0, 1) * caster);
        scene::LightRecord light;
        light.type = scene::LightRecord::Type::Point;
        light.sourceRadius = radius;
        const FittedShadow fitted = fitPunctual(light, 0);
        const auto depth = [&](double distance) { return fitted.clipFromView[3][2] / static_cast<float>(distance); };
        const double width = fitted.widthPerMeter * receiver;
        const double penumbra = penumbraOfDepth(fitted, radius) * (depth(caster) - depth(receiver)) * width;
        EXPECT_NEAR(penumbra, radius * (receiver - caster) / caster, 1e-5 * receiver / caster * radius);
    }
    const FittedShadow sun{ .widthMeters = 20, .depthMeters = 5 };
    EXPECT_FLOAT_EQ(penumbraOfDepth(sun, 0.01f) * sun.widthMeters, 0.01f * sun.depthMeters);
    EXPECT_EQ(penumbraOfDepth(sun, 0), 0);
}

} // namespace
} // namespace filament_core::prepare
