// SPDX-License-Identifier: Apache-2.0
// Rectangles, discs and tubes that are drawn (RectLight::isVisible).
#include "tests/filament_core/engine/ShadowStage.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <vector>

namespace filament_core {
namespace {

using test::shadowedView;
using test::ShadowStage;

constexpr uint2 kLightViewSize{ 128, 128 };

/// From 2 m above, 1 m to each side at the origin.
View viewFrom(double height = 2) {
    View view = shadowedView({ 0, 0, height }, {}, ShadowFilter::Hard, kLightViewSize);
    view.camera.lens.verticalFovDegrees = static_cast<float>(glm::degrees(2 * std::atan(0.5)));
    return view;
}

struct Seen {
    double pixels = 0; ///< as a part of the image
    float least = 1e9f, most = 0;
};

Seen seenOf(Image const& image) {
    Seen seen;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const float value = test::halfPixel(image, x, y).x;
            if (value == 0) continue;
            seen.pixels += 1.0 / (kLightViewSize.x * kLightViewSize.y);
            seen.least = std::min(seen.least, value), seen.most = std::max(seen.most, value);
        }
    }
    return seen;
}

template <class AreaLight>
AreaLight drawnLight(AreaLight light, View const& view) {
    light.luminance = Nits{ 0.5f / view.camera.exposure.factor() };
    light.isVisible = true;
    return light;
}

TEST(VisibleLights, HaveTheirShapeAndTheirLuminance) {
    const View view = viewFrom();
    const RectLight rect =
            drawnLight(RectLight{ .directionWorld = { 0, 0, 1 }, .widthMeters = 1, .heightMeters = 0.5f }, view);
    const DiscLight disc = drawnLight(DiscLight{ .directionWorld = { 0, 0, 1 }, .radiusMeters = 0.6f }, view);
    const TubeLight tube =
            drawnLight(TubeLight{ .axisWorld = { 1, 0, 0 }, .lengthMeters = 1, .radiusMeters = 0.1f }, view);
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const auto expectSeen = [&](LightDesc const& light, double area, const char* name) {
            Scene scene(stage.engine);
            std::visit([&](auto const& desc) { scene.add(desc); }, light);
            const Seen seen = seenOf(test::renderLinear(stage.engine, scene, view));
            EXPECT_NEAR(seen.pixels, area / 4, 0.01) << name << ' ' << toString(backend);
            if (area == 0) return;
            EXPECT_NEAR(seen.least, 0.5f, 1e-3f) << name;
            EXPECT_NEAR(seen.most, 0.5f, 1e-3f) << name;
        };
        expectSeen(rect, 0.5, "rectangle");
        expectSeen(disc, 0.36 * std::numbers::pi, "disc");
        expectSeen(tube, 0.2, "tube"); // whose rims are nearer and farther by a twentieth
        RectLight away = rect;
        away.directionWorld = { 0, 0, -1 };
        expectSeen(away, 0, "the back of one that shines to one side");
        away.isTwoSided = true;
        expectSeen(away, 0.5, "the back of one that shines to both");
        RectLight off = rect;
        off.isVisible = false;
        expectSeen(off, 0, "by default");
        off.isVisible = true;
        off.lightChannels = 0;
        expectSeen(off, 0, "without a channel");
        test::expectNoErrors(stage.engine);
    }
}

// The drawn shape is in no shadow map, and the surfaces are lit as without it.
TEST(VisibleLights, ShineAsIfTheyWereNotDrawn) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const auto imageOf = [&](bool isVisible, AreaShadows shadows) {
            Scene scene(stage.engine);
            stage.square.add(scene, stage.white, {}, 3);
            stage.addBox(scene, { 0.3, 0, 0.4 }, { 0.1, 0.2, 0.1 });
            scene.add(RectLight{ .positionWorld = { 0, 0, 3 },
                                 .directionWorld = { 0, 0, -1 },
                                 .luminance = Nits{ 20'000 },
                                 .isVisible = isVisible });
            scene.add(TubeLight{ .positionWorld = { 0, 4, 1 }, .luminance = Nits{ 20'000 }, .isVisible = isVisible });
            View view = viewFrom();
            view.quality.areaShadows = shadows;
            return test::renderLinear(stage.engine, scene, view);
        };
        for (const AreaShadows shadows : { AreaShadows::Center, AreaShadows::Shape })
            EXPECT_EQ(test::differingPixels(imageOf(false, shadows), imageOf(true, shadows)), 0u) << toString(backend);
    }
}

/// Quarters: red, green, blue, white, row by row.
LightImage quarters(Engine& engine) {
    constexpr uint32_t kSide = 64;
    std::vector<uint32_t> pixels;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        const uint32_t quarter = (i / kSide >= kSide / 2 ? 2u : 0u) + (i % kSide >= kSide / 2 ? 1u : 0u);
        pixels.push_back(std::array{ 0xff0000ffu, 0xff00ff00u, 0xffff0000u, 0xffffffffu }[quarter]);
    }
    const Result<LightImage> image = engine.create(LightImageDesc{ .width = kSide,
                                                                   .height = kSide,
                                                                   .pixels = std::as_bytes(std::span(pixels)),
                                                                   .shape = LightImageShape::Emitted });
    EXPECT_TRUE(image) << (image ? "" : image.error().message);
    return image ? *image : LightImage{};
}

TEST(VisibleLights, ShowTheirImageUprightFromTheFront) {
    const View view = viewFrom();
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        Scene scene(stage.engine);
        RectLight rect =
                drawnLight(RectLight{ .directionWorld = { 0, 0, 1 }, .widthMeters = 1.6f, .heightMeters = 1.6f }, view);
        const Owned<LightImage> image = stage.engine.own(quarters(stage.engine));
        rect.image = image;
        const Light light = scene.add(rect);
        const auto expectColors = [&](float3 left, float3 right, const char* when) {
            const Image drawn = test::renderLinear(stage.engine, scene, view);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(test::halfPixel(drawn, 38, 38)[c], 0.5f * left[c], 5e-3f) << when << toString(backend);
                EXPECT_NEAR(test::halfPixel(drawn, 90, 38)[c], 0.5f * right[c], 5e-3f) << when << toString(backend);
            }
        };
        expectColors({ 1, 0, 0 }, { 0, 1, 0 }, "image ");
        rect.image = {};
        scene.set(light, rect);
        expectColors(float3(1), float3(1), "none ");
        rect.image = image;
        scene.set(light, rect);
        expectColors({ 1, 0, 0 }, { 0, 1, 0 }, "again ");
        scene.remove(light);
        expectColors(float3(0), float3(0), "removed ");
        test::expectNoErrors(stage.engine);
    }
}

TEST(VisibleLights, FollowTheirLight) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const View view = viewFrom();
        Scene scene(stage.engine);
        const uint32_t before = scene.renderableCount();
        const Node node = scene.add(NodeDesc{ .parentFromNode = glm::translate(double4x4(1), double3(5, 0, 0)) });
        RectLight rect =
                drawnLight(RectLight{ .directionWorld = { 0, 0, 1 }, .widthMeters = 1, .heightMeters = 0.5f }, view);
        const Light light = scene.add(rect, node);
        const auto share = [&] { return seenOf(test::renderLinear(stage.engine, scene, view)).pixels; };
        EXPECT_EQ(share(), 0) << "beside the view";
        scene.setTransform(node, glm::scale(double4x4(1), double3(3)));
        EXPECT_NEAR(share(), 0.125, 0.01) << "a scale does not change its size";
        rect.heightMeters = 1;
        scene.set(light, rect);
        EXPECT_NEAR(share(), 0.25, 0.01);
        scene.set(light, DiscLight{ .directionWorld = { 0, 0, 1 }, .luminance = rect.luminance, .isVisible = true });
        EXPECT_NEAR(share(), std::numbers::pi / 16, 0.01);
        scene.set(light, PointLight{});
        EXPECT_EQ(share(), 0);
        scene.set(light, rect);
        EXPECT_EQ(scene.renderableCount(), before) << "the app added none";
        scene.remove(node);
        EXPECT_EQ(scene.lightCount(), 0u);
        EXPECT_EQ(share(), 0);
        const Light last = scene.add(rect);
        EXPECT_NEAR(share(), 0.25, 0.01);
        scene.remove(last);
        EXPECT_EQ(share(), 0);
        test::expectNoErrors(stage.engine);
    }
}

TEST(VisibleLights, ArePickedAsLights) {
    for (const Backend backend : test::kBothApis) {
        ShadowStage stage(backend);
        const View view = viewFrom();
        Scene scene(stage.engine);
        stage.square.add(scene, stage.white, { 0, 0, -1 }, 3);
        const Light light = scene.add(
                drawnLight(RectLight{ .directionWorld = { 0, 0, 1 }, .widthMeters = 1, .heightMeters = 0.5f }, view));
        Renderer renderer(stage.engine);
        const Result<PickHit> onLight = renderer.waitPick(renderer.pick(scene, view, { 64, 64 }));
        ASSERT_TRUE(onLight.ok() && *onLight);
        EXPECT_EQ(onLight->light, light);
        EXPECT_FALSE(onLight->renderable);
        EXPECT_NEAR(onLight->distanceMeters, 2, 1e-3);
        const Result<PickHit> beside = renderer.waitPick(renderer.pick(scene, view, { 2, 2 }));
        ASSERT_TRUE(beside.ok() && *beside);
        EXPECT_FALSE(beside->light);
        EXPECT_TRUE(beside->renderable);
    }
}

} // namespace
} // namespace filament_core
