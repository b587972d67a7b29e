// SPDX-License-Identifier: Apache-2.0
// Backgrounds that lie on the ground under a dome (EnvironmentSettings::groundHeightMeters), on both APIs, against the
// closed form of what the panorama's camera saw; the shadow catcher on that ground.
#include "filament_core/assets/image/ImageWriter.h"
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/BuiltInMaterials.h>
#include <filament_core/Environment.h>

#include <array>
#include <filesystem>
#include <functional>

namespace filament_core {
namespace {

using namespace test;

constexpr uint32_t kSide = 16;

/// A panorama that shows the direction as a colour.
std::filesystem::path directionPanorama() {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "direction_panorama.hdr";
    constexpr uint32_t kWidth = 1024, kHeight = 512;
    assets::HdrImage image{ .width = kWidth, .height = kHeight, .pixels = {}, .repairs = {} };
    for (uint32_t y = 0; y < kHeight; ++y) {
        for (uint32_t x = 0; x < kWidth; ++x) {
            const double azimuth = (0.5 - (x + 0.5) / kWidth) * 2 * 3.14159265358979,
                         polar = (y + 0.5) / kHeight * 3.14159265358979;
            const float3 direction(
                    double3(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth)));
            image.pixels.push_back(kDirectionSky.radiance(direction));
        }
    }
    EXPECT_TRUE(assets::writeHdr(path, image));
    return path;
}

/// What a camera at `eye` that looks along -z sees of it.
Image skyFrom(double3 eye, EnvironmentSettings settings, double3 at = double3(0, 0, -1)) {
    return onBothApis([&](MaterialStage& stage) {
        stage.view.size = uint2(kSide);
        stage.view.camera = Camera::lookAt(eye, eye + at, { .verticalFovDegrees = 45 });
        settings.illuminance = Lux{ 1 / stage.view.camera.exposure.factor() };
        Result<Environment> loaded = loadEnvironment(stage.engine, directionPanorama());
        ASSERT_TRUE(loaded) << loaded.error().message;
        auto environment = std::make_shared<Environment>(std::move(*loaded));
        stage.scene.setEnvironment(*environment, settings);
        stage.keep(environment);
    });
}

double3 viewThrough(uint32_t x, uint32_t y) { return double3(directionThrough(x, y, kSide)); }

TEST(SkyGround, ACameraSeesWhatThePanoramasCameraSawThere) {
    constexpr float kHeight = 1.6f, kRadius = 20;
    const EnvironmentSettings settings{ .groundHeightMeters = kHeight,
                                        .groundLevelMeters = -0.5f,
                                        .groundRadiusMeters = kRadius };
    for (const double3 eye : { double3(0, 1.1, 0), double3(3, 0.7, -2), double3(-8, 6, 5) }) {
        const Image image = skyFrom(eye, settings);
        uint32_t onGround = 0;
        for (uint32_t y = 0; y < kSide; ++y) {
            for (uint32_t x = 0; x < kSide; ++x) {
                const double3 direction = viewThrough(x, y), from = eye + double3(0, 0.5 - kHeight, 0);
                const double along = glm::dot(from, direction);
                double meters = std::sqrt(along * along - glm::dot(from, from) + kRadius * kRadius) - along;
                const double toGround = direction.y < 0 ? (eye.y + 0.5) / -direction.y : 1e9;
                if (toGround < meters) meters = toGround, ++onGround;
                const float3 expected = kDirectionSky.radiance(float3(from + direction * meters));
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(halfPixel(image, x, y)[c], expected[c], 6e-3f) << x << ' ' << y;
            }
        }
        EXPECT_GT(onGround, 20u);
    }
}

TEST(SkyGround, FromThePanoramasCameraItIsAsInfinitelyFarAway) {
    const Image infinite = skyFrom({ 0, 1.6, 0 }, {});
    const Image grounded = skyFrom({ 0, 1.6, 0 }, { .groundHeightMeters = 1.6f });
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(halfPixel(grounded, x, y)[c], halfPixel(infinite, x, y)[c], 2e-3f) << x << ' ' << y;
}

TEST(SkyGround, ItIsTheSameFarFromTheOriginAndFiniteEverywhere) {
    for (const double3 eye : { double3(0, -3, 0), double3(1e3, 5, 0), double3(0, 0, 0), double3(0, 1e5, 0) }) {
        for (const double3 at : { double3(0, -1, -0.001), double3(0, 1, -0.001), double3(0, 0, -1) }) {
            const Image image = skyFrom(eye, { .groundHeightMeters = 2, .groundRadiusMeters = 1 }, at);
            for (uint32_t y = 0; y < kSide; ++y)
                for (uint32_t x = 0; x < kSide; ++x)
                    for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(halfPixel(image, x, y)[c]));
        }
    }
}

TEST(SkyGround, TheCatcherShowsShadowsAlone) {
    const auto drawn = [](bool hasCatcher, bool hasCaster) {
        return onBothApis([&](MaterialStage& stage) {
            stage.view.clearColor = { 0.5f, 0.25f, 0.125f, 1 };
            stage.scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 10'000 } });
            if (hasCatcher) {
                Result<Material> catcher = createBuiltInMaterial(stage.engine, "shadowCatcher");
                ASSERT_TRUE(catcher) << catcher.error().message;
                stage.add(stage.keep(*catcher), { {} });
            }
            if (!hasCaster) return;
            Result<Material> solid = createBuiltInMaterial(stage.engine, "unlit");
            ASSERT_TRUE(solid) << solid.error().message;
            stage.add(stage.keep(*solid), { { .z = 6 } }); // behind the camera, towards the sun
        });
    };
    const Image background = drawn(false, false);
    EXPECT_EQ(drawn(true, false).pixels, background.pixels);
    const float4 shadowed = halfPixel(drawn(true, true), 4, 4);
    EXPECT_NEAR(shadowed.x, 0.5f * 0.4f, 1e-3f);
    EXPECT_NEAR(shadowed.z, 0.125f * 0.4f, 1e-3f);
}

/// The center of a ground that faces the camera, under a sun from there, which a caster may hide, and another light.
float4 caught(bool hasCaster, std::function<void(MaterialStage&, Lux sun)> const& addLight) {
    const Image image = onBothApis([&](MaterialStage& stage) {
        stage.view.clearColor = { 0.5f, 0.25f, 0.125f, 1 };
        const Lux sun{ 3.14159265f / stage.view.camera.exposure.factor() }; // as much as kWhiteSky
        stage.scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = sun });
        addLight(stage, sun);
        Result<Material> catcher = createBuiltInMaterial(stage.engine, "litShadowCatcher");
        ASSERT_TRUE(catcher) << catcher.error().message;
        const MaterialInstance ground = stage.keep(*catcher);
        stage.engine.set(ground, "reflectance", 0.0f);
        stage.add(ground, { {} });
        if (!hasCaster) return;
        Result<Material> solid = createBuiltInMaterial(stage.engine, "unlit");
        ASSERT_TRUE(solid) << solid.error().message;
        stage.add(stage.keep(*solid), { { .z = 6 } }); // behind the camera, towards the sun
    });
    return halfPixel(image, 4, 4);
}

TEST(SkyGround, TheLitCatcherKeepsTheShareOfAllLightThatShadowsLeave) {
    const auto none = [](MaterialStage&, Lux) {};
    const auto lamp = [](MaterialStage& stage, Lux sun) {
        stage.scene.add(SunLight{
                .directionWorld = { 0.6f, 0, -0.8f }, .illuminance = Lux{ 0.5f * sun.value }, .castsShadows = false });
    };
    const auto sky = [](MaterialStage& stage, Lux) { stage.keep(std::make_shared<SkyObjects>(stage, kWhiteSky)); };
    const std::array<std::function<void(MaterialStage&, Lux)>, 3> others{ none, lamp, sky };
    const std::array left{ 0.0f, 0.5f * 0.8f / 1.4f, 0.5f }; // illuminance over that with the sun
    for (size_t i = 0; i < others.size(); ++i) {
        const float4 open = caught(false, others[i]), shadowed = caught(true, others[i]);
        EXPECT_NEAR(open.x, 0.5f, 1e-3f) << i;
        EXPECT_NEAR(shadowed.x, 0.5f * left[i], 2e-3f) << i;
        EXPECT_NEAR(shadowed.z, 0.125f * left[i], 1e-3f) << i;
    }
}

} // namespace
} // namespace filament_core
