// SPDX-License-Identifier: Apache-2.0
// Contact shadows on both APIs: a thin pole darkens what a ray towards the light says, a bare plane stays bright under
// any light and at any scale, and only for lights that enable them.
#include "tests/filament_core/engine/ShadowStage.h"

#include <array>

namespace filament_core {
namespace {

using prepare::Random;
using test::ShadowStage;

constexpr double kPoleHalf = 0.01, kPoleHeight = 0.2; // metres, times the scale

float3 sunAt(double elevationDegrees, double azimuthDegrees) {
    const double e = glm::radians(elevationDegrees), a = glm::radians(azimuthDegrees);
    return float3(double3(-std::cos(e) * std::cos(a), -std::cos(e) * std::sin(a), -std::sin(e)));
}

View contactView(double3 eye, double3 at, double scale, uint2 size = { 96, 72 }) {
    View view{ .camera = Camera::lookAt(eye * scale, at * scale,
                                        { .verticalFovDegrees = 40, .nearMeters = static_cast<float>(1e-3 * scale) },
                                        {}, { 0, 0, 1 }),
               .size = size };
    view.quality.shadows = ShadowFilter::Off;
    view.effects.contactShadows.distanceMeters = static_cast<float>(0.3 * scale);
    view.effects.contactShadows.thicknessMeters = static_cast<float>(0.1 * scale);
    view.effects.contactShadows.steps = 64;
    return view;
}

struct ContactScene {
    ShadowStage& stage;
    Scene scene;

    ContactScene(ShadowStage& of, double scale) : stage(of), scene(of.engine) {
        stage.square.add(scene, stage.white, {}, 4 * scale);
    }
    void addPole(double scale) {
        stage.addBox(scene, double3(0, 0, kPoleHeight / 2) * scale,
                     double3(kPoleHalf, kPoleHalf, kPoleHeight / 2) * scale);
    }
    Image draw(View const& view) { return test::renderLinear(stage.engine, scene, view); }
};

/// The point of the plane z = 0 that a pixel shows; nothing above the horizon.
std::optional<double3> planePointOf(View const& view, uint32_t x, uint32_t y) {
    const double4x4 clip(view.camera.clipFromView(static_cast<float>(view.size.x) / static_cast<float>(view.size.y)));
    const double2 ndc((x + 0.5) / view.size.x * 2 - 1, (y + 0.5) / view.size.y * 2 - 1);
    const double3 ray = double3x3(view.camera.worldFromView) * double3(ndc.x / clip[0][0], ndc.y / clip[1][1], -1);
    if (ray.z >= 0) return std::nullopt;
    return view.camera.position() + ray * (-view.camera.position().z / ray.z);
}

/// Where a ray enters and leaves a box of the pole's size, grown by a margin on all sides; first above second: it
/// misses.
double2 passesPole(double3 from, double3 direction, double margin) {
    const double3 low = double3(-kPoleHalf, -kPoleHalf, 0) - margin,
                  high = double3(kPoleHalf, kPoleHalf, kPoleHeight) + margin;
    double2 inside(-1e9, 1e9);
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (low[axis] - from[axis]) / direction[axis], b = (high[axis] - from[axis]) / direction[axis];
        inside = { std::max(inside.x, std::min(a, b)), std::min(inside.y, std::max(a, b)) };
    }
    return inside;
}

struct PoleComparison {
    size_t dark = 0, bright = 0, wrong = 0;
};

/// Pixels of the plane whose ray clearly meets the pole within reach, or clearly misses it.
PoleComparison comparePole(View const& view, Image const& with, Image const& without, double3 toLight) {
    PoleComparison found;
    for (uint32_t y = 0; y < view.size.y; ++y) {
        for (uint32_t x = 0; x < view.size.x; ++x) {
            const std::optional<double3> point = planePointOf(view, x, y);
            if (!point || glm::length(*point) > 1) continue;
            const double3 eye = view.camera.position();
            const double2 seen = passesPole(eye, *point - eye, 0.012);
            if (seen.x <= seen.y && seen.y > 0) continue; // the pole itself, or its edge
            const float light = test::halfPixel(with, x, y).x / test::halfPixel(without, x, y).x;
            const double2 core = passesPole(*point, toLight, -0.003), near = passesPole(*point, toLight, 0.03);
            const bool isHit = core.x < core.y && core.x > 0 && core.y < 0.2; // before it fades
            const bool isMiss = near.x > near.y || near.y < 0 || near.x > 0.3;
            if (isHit) ++found.dark, found.wrong += light > 0.01f ? 1 : 0;
            if (isMiss) ++found.bright, found.wrong += light != 1 ? 1 : 0;
        }
    }
    return found;
}

TEST(ContactShadows, APoleDarkensWhatARaySays) {
    constexpr uint2 kSize{ 240, 180 };
    for (const double elevation : { 25.0, 50.0, 75.0 }) {
        for (const double azimuth : { 20.0, 160.0, 250.0 }) {
            std::array<Image, 2> images;
            for (size_t api = 0; api < 2; ++api) {
                ShadowStage stage(test::kBothApis[api]);
                View view = contactView({ 0.25, -0.7, 0.5 }, { 0, 0, 0.05 }, 1, kSize);
                view.effects.contactShadows.thicknessMeters = 0.03f; // of the pole, across its edges
                const float3 direction = sunAt(elevation, azimuth);
                ContactScene asked(stage, 1), unasked(stage, 1);
                for (ContactScene* scene : { &asked, &unasked }) scene->addPole(1);
                asked.scene.add(SunLight{ .directionWorld = direction, .contactShadows = true });
                unasked.scene.add(SunLight{ .directionWorld = direction });
                images[api] = asked.draw(view);
                const PoleComparison found = comparePole(view, images[api], unasked.draw(view), -double3(direction));
                EXPECT_GT(found.dark, elevation < 60 ? 30u : 1u) << elevation << ' ' << azimuth;
                EXPECT_GT(found.bright, 10'000u);
                EXPECT_EQ(found.wrong, 0u) << "of " << found.dark << " dark pixels at " << elevation << ' ' << azimuth;
            }
            EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u);
        }
    }
}

TEST(ContactShadows, ABarePlaneHasNoneAtAnySunAndScale) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        for (const double scale : { 0.01, 1.0, 30.0, 1000.0 }) {
            for (const double elevation : { 1.0, 3.0, 10.0, 30.0, 60.0, 90.0 }) {
                for (const double height : { 0.02, 0.4, 2.0 }) {
                    const View view = contactView({ 0.3, -1.5, height }, { 0, 0, 0 }, scale);
                    ContactScene asked(stage, scale), unasked(stage, scale);
                    const float3 direction = sunAt(elevation, 37 + 50 * elevation);
                    asked.scene.add(SunLight{ .directionWorld = direction, .contactShadows = true });
                    unasked.scene.add(SunLight{ .directionWorld = direction });
                    EXPECT_EQ(test::differingPixels(asked.draw(view), unasked.draw(view)), 0u)
                            << scale << " m, sun at " << elevation << " degrees, camera at " << height;
                }
            }
        }
    }
}

TEST(ContactShadows, OnlyLightsThatAskHaveThem) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const View view = contactView({ 0.25, -0.7, 0.5 }, { 0, 0, 0.05 }, 1);
        const auto draw = [&](bool first, bool second) {
            ContactScene scene(stage, 1);
            scene.addPole(1);
            scene.scene.add(PointLight{
                    .positionWorld = { 0.3, 0.2, 0.3 }, .intensity = Candela{ 2000 }, .contactShadows = first });
            scene.scene.add(SpotLight{ .positionWorld = { -0.3, 0.1, 0.3 },
                                       .directionWorld = { 0.3f, -0.1f, -0.3f },
                                       .intensity = Candela{ 2000 },
                                       .contactShadows = second });
            return scene.draw(view);
        };
        const Image none = draw(false, false), first = draw(true, false), second = draw(false, true),
                    both = draw(true, true);
        EXPECT_GT(test::differingPixels(none, first), 20u);
        EXPECT_GT(test::differingPixels(none, second), 20u);
        EXPECT_GT(test::differingPixels(first, both), 20u);
        EXPECT_GT(test::differingPixels(second, both), 20u);
    }
}

TEST(ContactShadows, RandomScenesHaveTheSameBitsOnBothApis) {
    ShadowStage vulkan(Backend::Vulkan), gles(Backend::Gles);
    for (uint32_t seed = 1; seed <= 12; ++seed) {
        std::array<Image, 2> images;
        for (size_t api = 0; api < 2; ++api) {
            ShadowStage& stage = api == 0 ? vulkan : gles;
            Random random(seed);
            Scene scene(stage.engine);
            addCrowd(stage, scene, random, 1);
            scene.add(SunLight{ .directionWorld = { 0.3f, 0.5f, -0.4f }, .contactShadows = true });
            scene.add(PointLight{
                    .positionWorld = { 0.5, -0.3, 1.5 }, .intensity = Candela{ 20'000 }, .contactShadows = true });
            View view = test::shadowedView({ 3, -4, 2 + 0.2 * seed }, { 0, 0, 0.3 },
                                           seed % 2 ? ShadowFilter::Pcf3 : ShadowFilter::Off, { 95, 71 });
            view.samples = seed % 3 == 0 ? 4 : 1;
            view.quality.depthRange = seed % 4 == 0 ? DepthRange::Ordinary : DepthRange::Reversed;
            view.effects.contactShadows = { .distanceMeters = 0.8f, .thicknessMeters = 0.3f };
            images[api] = test::renderLinear(stage.engine, scene, view);
            view.effects.contactShadows.distanceMeters = 1e-4f;
            EXPECT_GT(test::differingPixels(images[api], test::renderLinear(stage.engine, scene, view)), 10u) << seed;
        }
        EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u) << seed;
    }
}

} // namespace
} // namespace filament_core
