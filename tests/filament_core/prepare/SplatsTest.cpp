// SPDX-License-Identifier: Apache-2.0
// Splats of a view: projection against closed forms, order, culling, extreme numbers, and the same bits for any number
// of workers.
#include "base/math/Half.h"
#include "filament_core/prepare/PrepareSplats.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <limits>

namespace filament_core::prepare {
namespace {

constexpr uint2 kSplatView{ 200, 100 };

/// Lists that make a cloud.
struct CloudText {
    std::vector<float3> positions, scales, harmonics;
    std::vector<float4> rotations;
    std::vector<float> opacities;
    uint32_t degree = 0;
    SplatColors colors = SplatColors::Srgb;

    void add(float3 position, float3 scale, float opacity = 0.5f, float4 rotation = { 0, 0, 0, 1 }) {
        positions.push_back(position);
        scales.push_back(scale);
        opacities.push_back(opacity);
        rotations.push_back(rotation);
        harmonics.resize(harmonics.size() + size_t{ degree + 1 } * (degree + 1), float3(0));
    }
    SplatCloudDesc desc() const {
        return { .positions = positions,
                 .rotations = rotations,
                 .scales = scales,
                 .opacities = opacities,
                 .degree = degree,
                 .harmonics = harmonics,
                 .colors = colors,
                 .name = "test" };
    }
};

struct SplatScene {
    BoxScene boxes;
    scene::MaterialInstance const* material = boxes.material(shader::Blending::Transparent);

    Renderable add(CloudText const& text, double4x4 const& world = double4x4(1.0), Layers layers = kDefaultLayers) {
        Result<SplatCloud> cloud = SplatCloud::create(text.desc());
        EXPECT_TRUE(cloud.ok()) << (cloud ? "" : cloud.error().message);
        scene::MinMax const& bounds = cloud->data()->bounds;
        return scene::addSplats(boxes.scene,
                                { .material = material,
                                  .boundsMin = bounds.min,
                                  .boundsMax = bounds.max,
                                  .worldFromObject = world,
                                  .layers = layers },
                                cloud->data());
    }

    /// From 4 metres along -z, 90 degrees of height: 50 pixels are a slope of 1.
    static ViewInput view() {
        return { .camera = Camera::lookAt({ 0, 0, 4 }, { 0, 0, 0 }, { .verticalFovDegrees = 90 }), .size = kSplatView };
    }

    SplatPacket prepare(ViewInput const& of = view(), int workers = 0) {
        jobs::JobSystem jobs({ .workers = workers });
        arena.reset();
        return prepareSplats(jobs, arena, boxes.scene, makeViewSpace(of), of.size);
    }
    Arena arena;
};

float2 inPixels(float2 ndc) { return 0.5f * ndc * float2(kSplatView); }

TEST(Splats, ASphereInTheMiddleIsACircleOfItsProjectedSizeAndTheLowPass) {
    SplatScene scene;
    CloudText text;
    text.add({ 0, 0, 0 }, float3(0.2f));
    scene.add(text);
    const SplatPacket packet = scene.prepare();
    ASSERT_EQ(packet.count(), 1u);
    SplatQuad const& quad = packet.lists[0].quads[0];
    const float sigma = std::sqrt(2.5f * 2.5f + 0.3f); // 0.2 m at 4 m, 50 pixels a slope of 1
    EXPECT_NEAR(quad.center.x, 0, 1e-6f);
    for (float2 const& axis : quad.axes) EXPECT_NEAR(glm::length(inPixels(axis)), 3 * sigma, 1e-4f);
    EXPECT_NEAR(glm::dot(inPixels(quad.axes[0]), inPixels(quad.axes[1])), 0, 1e-3f);
    EXPECT_EQ(floatFromHalf(quad.color[3]), 0.5f);
    EXPECT_EQ(floatFromHalf(quad.color[0]), 0.5f) << "coefficients of 0: the bias";
}

TEST(Splats, TurnedAndScaledNodesAreTheSameAsTurnedAndScaledSplats) {
    CloudText plain, turned;
    const float half = std::sqrt(0.5f);
    plain.add({ 0, 0, 0 }, { 0.4f, 0.1f, 0.2f });
    turned.add({ 0.5f, 0.25f, 0 }, { 0.8f, 0.2f, 0.4f }, 0.5f, { 0, 0, half, half });
    SplatScene byNode, bySplat;
    const double4x4 place = glm::translate(double4x4(1), double3(0.5, 0.25, 0));
    byNode.add(plain, glm::scale(glm::rotate(place, glm::radians(90.0), double3(0, 0, 1)), double3(2)));
    bySplat.add(turned);
    SplatQuad const a = byNode.prepare().lists[0].quads[0], b = bySplat.prepare().lists[0].quads[0];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.center[c], b.center[c], 1e-6f);
    for (size_t i = 0; i < 2; ++i) // of either sign
        EXPECT_NEAR(std::abs(glm::dot(a.axes[i], b.axes[i])), glm::dot(b.axes[i], b.axes[i]), 1e-6f);
    EXPECT_GT(std::abs(inPixels(a.axes[0]).y), 10 * std::abs(inPixels(a.axes[0]).x)) << "the long axis is upright";
}

/// Zwicker et al.: the image of points around the centre, by finite differences of the whole projection.
TEST(Splats, TheAxesAreThoseOfTheProjectionOfNearbyPoints) {
    Random random(7);
    for (int turn = 0; turn < 200; ++turn) {
        SplatScene scene;
        CloudText text;
        const auto number = [&](double low, double high) { return static_cast<float>(random.within(low, high)); };
        const float3 at(number(-2, 2), number(-1, 1), number(-3, 1)),
                scale(number(0.01, 0.3), number(0.01, 0.3), number(0.01, 0.3));
        const float4 rotation(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1));
        text.add(at, scale, 1, rotation);
        scene.add(text);
        const SplatPacket packet = scene.prepare();
        if (packet.count() == 0) continue;
        SplatQuad const& quad = packet.lists[0].quads[0];
        const float4x4 clipFromView = makeViewSpace(SplatScene::view()).clipFromView;
        const auto project = [&](double3 p) {
            const float4 clip = clipFromView * float4(float3(p - double3(0, 0, 4)), 1);
            return double2(clip.x, clip.y) / static_cast<double>(clip.w) * 0.5 * double2(kSplatView);
        };
        constexpr double kStep = 1e-2;
        const scene::Covariance s = scene::splatCovariance(rotation, scale);
        const double3x3 sigma(s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz);
        double3 gradients[2];
        for (int axis = 0; axis < 3; ++axis) {
            double3 step(0);
            step[axis] = kStep;
            const double2 change = (project(double3(at) + step) - project(double3(at) - step)) / (2 * kStep);
            gradients[0][axis] = change.x, gradients[1][axis] = change.y;
        }
        const auto spread = [&](int i, int k) {
            return glm::dot(gradients[i], sigma * gradients[k]) + (i == k ? 0.3 : 0);
        };
        const double2 u = double2(inPixels(quad.axes[0])) / 3.0, v = double2(inPixels(quad.axes[1])) / 3.0;
        const double scaleOf = spread(0, 0) + spread(1, 1);
        EXPECT_NEAR(u.x * u.x + v.x * v.x, spread(0, 0), 2e-3 * scaleOf);
        EXPECT_NEAR(u.y * u.y + v.y * v.y, spread(1, 1), 2e-3 * scaleOf);
        EXPECT_NEAR(u.x * u.y + v.x * v.y, spread(0, 1), 2e-3 * scaleOf);
    }
}

TEST(Splats, AreSortedByTheirDistanceFarthestFirstOverAllClouds) {
    SplatScene scene;
    Random random(3);
    for (int cloud = 0; cloud < 4; ++cloud) {
        CloudText text;
        for (int i = 0; i < 3000; ++i)
            text.add(float3(random.within(-1, 1), random.within(-1, 1), random.within(-1, 1)), float3(0.01f));
        text.add({ 0, 0, 0.5f }, float3(0.01f)); // one distance in all clouds
        scene.add(text);
    }
    const SplatPacket packet = scene.prepare();
    SplatList const& list = packet.lists[0];
    ASSERT_EQ(packet.count(), 4u * 3001);
    for (size_t i = 1; i < list.size(); ++i) {
        EXPECT_LE(list.order[i - 1].key, list.order[i].key);
        const bool areEqual = list.order[i - 1].key == list.order[i].key;
        EXPECT_TRUE(!areEqual || list.order[i - 1].draw < list.order[i].draw);
    }
}

TEST(Splats, AreTheSameForAnyNumberOfWorkers) {
    SplatScene scene;
    Random random(11);
    CloudText text;
    text.degree = 3;
    for (int i = 0; i < 20'000; ++i) {
        text.add(float3(random.within(-3, 3), random.within(-2, 2), random.within(-3, 3)),
                 float3(random.within(0, 0.1), random.within(0, 0.1), random.within(0, 0.1)),
                 static_cast<float>(random.within(0, 1)));
        for (size_t k = 0; k < 16; ++k)
            text.harmonics[text.harmonics.size() - 1 - k] = float3(static_cast<float>(random.within(-1, 1)));
    }
    scene.add(text);
    std::vector<SplatVertex> first;
    for (const int workers : { 0, 1, 2, 5 }) {
        const SplatPacket packet = scene.prepare(SplatScene::view(), workers);
        std::vector<SplatVertex> vertices(4 * packet.count());
        jobs::JobSystem jobs({ .workers = workers });
        writeSplatVertices(jobs, packet.lists[0], vertices);
        if (first.empty()) first = vertices;
        ASSERT_EQ(vertices.size(), first.size());
        EXPECT_EQ(std::memcmp(vertices.data(), first.data(), vertices.size() * sizeof(SplatVertex)), 0) << workers;
    }
    EXPECT_GT(first.size(), 10'000u);
    EXPECT_LT(first.size(), 80'000u) << "some are out of view";
}

TEST(Splats, ThoseThatCannotBeSeenAreLeftOut) {
    CloudText text;
    text.add({ 0, 0, 0 }, float3(0.1f));
    text.add({ 0, 0, 0 }, float3(0.1f), 0);   // transparent
    text.add({ 0, 0, 4 }, float3(0.1f));      // at the eye
    text.add({ 0, 0, 5 }, float3(0.1f));      // behind it
    text.add({ 0, 0, 3.999f }, float3(0.1f)); // before the near plane
    text.add({ 9, 0, 0 }, float3(0.1f));      // beside the view
    text.add({ 9, 0, 0 }, float3(2));         // which reaches into it
    SplatScene scene;
    const Renderable cloud = scene.add(text);
    EXPECT_EQ(scene.prepare().count(), 2u);
    scene::setVisible(scene.boxes.scene.renderables, cloud, false);
    EXPECT_EQ(scene.prepare().count(), 0u);
    scene::setVisible(scene.boxes.scene.renderables, cloud, true);
    ViewInput otherLayer = SplatScene::view();
    otherLayer.visibleLayers = 2;
    EXPECT_EQ(scene.prepare(otherLayer).count(), 0u);
    scene::setTransform(scene.boxes.scene, cloud, glm::scale(double4x4(1), double3(0)));
    EXPECT_EQ(scene.prepare().count(), 0u) << "a point";
    scene::removeRenderable(scene.boxes.scene, cloud);
    EXPECT_EQ(scene.prepare().inScene, 0u);
}

TEST(Splats, ExtremeNumbersGiveFiniteQuadsOrNone) {
    const auto axesOf = [](float3 scale, double4x4 const& world = double4x4(1)) -> std::vector<float> {
        SplatScene scene;
        CloudText text;
        text.degree = 1;
        text.add({ 0, 0, 0 }, scale, 1);
        scene.add(text, world);
        const SplatPacket packet = scene.prepare();
        std::vector<float> lengths;
        for (SortItem const& item : packet.lists[0].order) {
            SplatQuad const& quad = packet.lists[0].quads[item.draw];
            for (float2 const& axis : quad.axes) lengths.push_back(glm::length(inPixels(axis)) / 3);
            EXPECT_TRUE(std::isfinite(quad.center.x + quad.center.y + quad.center.z));
            EXPECT_EQ(floatFromHalf(quad.color[0]), 0.5f);
        }
        return lengths;
    };
    const std::vector<float> point = axesOf(float3(0));
    ASSERT_EQ(point.size(), 2u);
    for (const float length : point) EXPECT_FLOAT_EQ(length, std::sqrt(0.3f)) << "the low-pass alone";
    for (const float3 scale :
         { float3(1e6f), float3(1e12f), float3(1e15f), float3(1e15f, 0, 1e-15f), float3(1e-30f) }) {
        for (const float length : axesOf(scale)) EXPECT_TRUE(std::isfinite(length) && length > 0) << scale.x;
    }
    EXPECT_EQ(axesOf(float3(1e6f)).size(), 2u) << "it covers the view";
    double4x4 flat(1);
    flat[2][2] = 0; // without an inverse: only the colour of degree 0
    EXPECT_EQ(axesOf(float3(0.1f), flat).size(), 2u);
    EXPECT_EQ(axesOf(float3(0.1f), glm::scale(double4x4(1), double3(-1, 1, 1))).size(), 2u) << "mirrored";
}

TEST(Splats, CoefficientsAreThoseOfOrthonormalHarmonics) {
    // The integral of two of them over the sphere is 1 if they are the same, else 0. Sums over a product of
    // Gauss-Legendre nodes and equal angles are exact for these polynomials.
    const double nodes[5] = { 0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640, -0.9061798459386640 };
    const double weights[5] = { 0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                                0.2369268850561891 };
    constexpr int kAngles = 12;
    double sums[16][16] = {};
    for (int n = 0; n < 5; ++n) {
        for (int a = 0; a < kAngles; ++a) {
            const double turn = 2 * std::numbers::pi * (a + 0.25) / kAngles, r = std::sqrt(1 - nodes[n] * nodes[n]);
            const float3 direction(r * std::cos(turn), r * std::sin(turn), nodes[n]);
            double values[16];
            for (size_t k = 0; k < 16; ++k) {
                std::vector<float3> one(16, float3(0));
                one[k] = float3(1, -1, 0);
                const float3 color = splatColor(one, 3, direction); // one of both signs is not cut off
                values[k] = static_cast<double>(color.x - color.y) / 2;
                if (color.x == 0 || color.y == 0)
                    values[k] = static_cast<double>(color.y == 0 ? color.x - 0.5f : 0.5f - color.y);
            }
            for (int i = 0; i < 16; ++i)
                for (int k = 0; k < 16; ++k)
                    sums[i][k] += values[i] * values[k] * weights[n] * 2 * std::numbers::pi / kAngles;
        }
    }
    for (int i = 0; i < 16; ++i)
        for (int k = 0; k < 16; ++k) EXPECT_NEAR(sums[i][k], i == k ? 1 : 0, 2e-6) << i << ' ' << k;
}

TEST(Splats, SignsFollowTheCondonShortleyPhase) {
    const auto colorOf = [](size_t k, float3 direction) {
        std::vector<float3> one(16, float3(0));
        one[k] = float3(0.5f);
        return splatColor(one, 3, direction).x - 0.5f;
    };
    const float3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    EXPECT_NEAR(colorOf(1, y), -0.5f * 0.48860251f, 1e-6f);
    EXPECT_NEAR(colorOf(2, z), 0.5f * 0.48860251f, 1e-6f);
    EXPECT_NEAR(colorOf(3, x), -0.5f * 0.48860251f, 1e-6f);
    EXPECT_NEAR(colorOf(6, z), 0.5f * 0.63078313f, 1e-6f);
    EXPECT_NEAR(colorOf(8, x), 0.5f * 0.54627422f, 1e-6f);
    EXPECT_NEAR(colorOf(12, z), 0.5f * 0.74635267f, 1e-6f);
    EXPECT_NEAR(colorOf(15, x), -0.5f * 0.59004359f, 1e-6f);
    EXPECT_NEAR(colorOf(9, y), 0.5f * 0.59004359f, 1e-6f);
}

TEST(Splats, CloudsWithWrongNumbersAreRefusedByName) {
    CloudText good;
    good.add({ 0, 0, 0 }, float3(1));
    good.add({ 1, 0, 0 }, float3(1));
    const auto errorOf = [&](auto&& change) {
        CloudText text = good;
        change(text);
        const Result<SplatCloud> made = SplatCloud::create(text.desc());
        return made ? "created" : made.error().message;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(errorOf([](CloudText&) {}), "created");
    EXPECT_EQ(errorOf([&](CloudText& t) { t.positions[1].y = nan; }),
              "splats 'test': splat 1: its position is not finite");
    EXPECT_EQ(errorOf([&](CloudText& t) { t.scales[0].z = -1; }),
              "splats 'test': splat 0: its scales are not from 0 to 1e15");
    EXPECT_EQ(errorOf([&](CloudText& t) { t.scales[0].z = nan; }),
              "splats 'test': splat 0: its scales are not from 0 to 1e15");
    EXPECT_EQ(errorOf([&](CloudText& t) { t.opacities[1] = 1.5f; }),
              "splats 'test': splat 1: its opacity is not from 0 to 1");
    EXPECT_EQ(errorOf([&](CloudText& t) { t.rotations[1] = float4(0); }),
              "splats 'test': splat 1: its rotation has no length; 0, 0, 0, 1 rotates nothing");
    EXPECT_EQ(errorOf([&](CloudText& t) { t.harmonics[1].x = nan; }),
              "splats 'test': splat 1: its harmonics are not finite");
    EXPECT_EQ(errorOf([](CloudText& t) { t.scales.pop_back(); }), "splats 'test': 1 scales for 2 splats; give 2");
    EXPECT_EQ(errorOf([](CloudText& t) { t.degree = 2; }), "splats 'test': 2 harmonics for 2 splats; give 18");
    EXPECT_EQ(errorOf([](CloudText& t) { t.degree = 4; }), "splats 'test': degree 4 of harmonics; 0 to 3 are possible");
    EXPECT_EQ(errorOf([](CloudText& t) { t = {}; }), "splats 'test': there are none; give at least one");
}

} // namespace
} // namespace filament_core::prepare
