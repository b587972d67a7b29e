// SPDX-License-Identifier: Apache-2.0
// The sun of an environment as a light of a scene: it lights what it lit as part of the environment, turns with it, and
// leaves with it.
#include "filament_core/assets/environment/Environment.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/LoadTicket.h>

namespace filament_core {
namespace {

using test::MaterialStage;

constexpr uint32_t kSunnyRows = 64;

/// A soft sky; the pixel that sees `sun` has the light of a sun of 3 lx per unit of radiance.
std::filesystem::path writeSunnySky(float3 sun) {
    assets::HdrImage picture{ .width = 2 * kSunnyRows, .height = kSunnyRows, .pixels = {}, .repairs = {} };
    for (uint32_t i = 0; i < 2 * kSunnyRows * kSunnyRows; ++i) {
        const float3 d = assets::directionFromEquirect((float2(i % (2 * kSunnyRows), i / (2 * kSunnyRows)) + 0.5f) /
                                                       float2(2 * kSunnyRows, kSunnyRows));
        picture.pixels.push_back(float3(0.4f + 0.2f * d.y));
    }
    const float2 uv = assets::equirectFromDirection(glm::normalize(sun));
    const auto x = static_cast<uint32_t>(uv.x * 2 * kSunnyRows), y = static_cast<uint32_t>(uv.y * kSunnyRows);
    const double pixel = std::numbers::pi / kSunnyRows;
    const double solidAngle = pixel * pixel * std::sin((y + 0.5) * pixel);
    picture.at(x, y) += float3(3, 2.5f, 2) / static_cast<float>(solidAngle);
    const std::filesystem::path file = test::folderOfThisTest() / "sky.exr";
    EXPECT_TRUE(assets::writeExr(file, picture.width, picture.height, picture.pixels));
    return file;
}

EnvironmentLoadOptions smallBake(EnvironmentSun sun) {
    EnvironmentLoadOptions options{ .faceSize = 32, .samples = 32 };
    options.sun = sun;
    return options;
}

/// A white diffuse ball, nearly without highlights.
Image ballUnderSun(std::filesystem::path const& file, EnvironmentSun sun, float rotation) {
    return test::onBothApis([&](MaterialStage& stage) {
        Result<Environment> sky = loadEnvironment(stage.engine, file, smallBake(sun));
        ASSERT_TRUE(sky.ok()) << sky.error().message;
        const auto kept = std::make_shared<Environment>(std::move(*sky));
        stage.keep(kept);
        stage.scene.setEnvironment(
                *kept, { .illuminance = Lux{ 1 / stage.view.camera.exposure.factor() }, .rotationRadians = rotation });
        stage.view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 36 });
        stage.view.size = { 32, 32 };
        stage.view.quality.shadows = ShadowFilter::Off;
        test::addSphere(stage, stage.material(test::text("shadingModel : lit",
                                                         "material.baseColor = vec4(1.0); material.roughness = 1.0; "
                                                         "material.reflectance = 0.0;"),
                                              test::kNoShadows));
    });
}

/// Mean of the absolute differences over the mean, and over the middle of the image only, where the ball is.
double differenceInTheMiddle(Image const& a, Image const& b) {
    double difference = 0, sum = 0;
    for (uint32_t y = 8; y < 24; ++y) {
        for (uint32_t x = 8; x < 24; ++x) {
            const float4 p = test::halfPixel(a, x, y), q = test::halfPixel(b, x, y);
            for (int c = 0; c < 3; ++c) difference += std::abs(double(p[c] - q[c])), sum += std::abs(double(q[c]));
        }
    }
    return difference / sum;
}

TEST(EnvironmentLights, ASunLightsABallAsTheEnvironmentDidThatHadIt) {
    const std::filesystem::path file = writeSunnySky({ 0.5f, 0.6f, 0.7f });
    for (const float rotation : { 0.0f, 0.8f, -1.1f }) {
        const Image kept = ballUnderSun(file, EnvironmentSun::Keep, rotation);
        const Image extracted = ballUnderSun(file, EnvironmentSun::Extract, rotation);
        EXPECT_LT(differenceInTheMiddle(extracted, kept), 0.02) << rotation;
        EXPECT_LT(differenceInTheMiddle(ballUnderSun(file, EnvironmentSun::Fit, rotation), kept), 0.02) << rotation;
        // A sun that does not turn, or counts twice, is seen.
        if (rotation != 0) {
            EXPECT_GT(differenceInTheMiddle(ballUnderSun(file, EnvironmentSun::Extract, -rotation), kept), 0.1);
        }
    }
}

TEST(EnvironmentLights, LeaveWithTheirEnvironment) {
    std::optional<Engine> engine = test::makeEngine(Backend::Null, 0);
    const std::filesystem::path file = writeSunnySky({ 0.5f, 0.6f, 0.7f });
    const Result<Environment> sunny = loadEnvironment(*engine, file, smallBake(EnvironmentSun::Extract));
    const Result<Environment> plain = loadEnvironment(*engine, file, smallBake(EnvironmentSun::Keep));
    ASSERT_TRUE(sunny && plain);
    ASSERT_EQ(sunny->lights().count, 1u);
    EXPECT_EQ(plain->lights().search, SunSearch::Off);
    Scene scene(*engine);
    const Light own = scene.add(PointLight{});
    scene.setEnvironment(*sunny);
    EXPECT_EQ(scene.lightCount(), 2u);
    scene.setEnvironment(*sunny, { .rotationRadians = 1 });
    EXPECT_EQ(scene.lightCount(), 2u);
    scene.setEnvironment(*plain);
    EXPECT_EQ(scene.lightCount(), 1u);
    scene.setEnvironment(*sunny);
    scene.setIndirectLight({}, Lux{ 0 });
    EXPECT_EQ(scene.lightCount(), 1u);
    scene.remove(own);
    scene.setEnvironment(*sunny);
    scene.setSkybox({}, Lux{ 0 });
    EXPECT_EQ(scene.lightCount(), 1u);
}

TEST(EnvironmentLights, TurnAndScaleWithTheSettings) {
    const ExtractedLight light{ .direction = { 0, 0, 1 }, .illuminance = { 3, 2, 1 }, .angularRadiusDegrees = 0.5f };
    const SunLight sun = sunLightOf(
            light, { .illuminance = Lux{ 100 }, .rotationRadians = static_cast<float>(std::numbers::pi / 2) });
    EXPECT_NEAR(sun.directionWorld.x, -1, 1e-6); // a quarter turn about +y takes +z to +x
    EXPECT_NEAR(sun.directionWorld.z, 0, 1e-6);
    const float luminous = 0.2126f * 3 + 0.7152f * 2 + 0.0722f;
    EXPECT_NEAR(sun.illuminance.value, 100 * luminous, 1e-3);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sun.color[c] * sun.illuminance.value, 100 * light.illuminance[c], 1e-3);
    EXPECT_EQ(sun.angularRadiusDegrees, 0.5f);
    EXPECT_EQ(sun.lightChannels, 0xFF);
    EXPECT_EQ(sunLightOf(light, { .illuminance = Lux{ 1e12f } }).illuminance.value, 1e12f);
    EXPECT_NE(explain({ .search = SunSearch::Found, .lights = { light }, .count = 1 }, {}).find("azimuth 0.00"),
              std::string::npos);
}

TEST(EnvironmentLights, ComeFromTheCacheAndFromPackagesAsFromTheBaker) {
    const std::filesystem::path file = writeSunnySky({ -0.5f, 0.6f, 0.1f });
    jobs::JobSystem jobs({ .workers = 0 });
    const assets::EnvironmentOptions options{ .cacheDirectory = test::folderOfThisTest() / "cache",
                                              .faceSize = 32,
                                              .samples = 8,
                                              .sun = EnvironmentSun::Extract };
    const auto baked = assets::loadEnvironment(file, jobs, options),
               cached = assets::loadEnvironment(file, jobs, options);
    ASSERT_TRUE(baked && cached);
    EXPECT_TRUE(cached->statistics.fromCache);
    const std::filesystem::path package = test::folderOfThisTest() / "sky.ktx2",
                                fenv = test::folderOfThisTest() / "sky.fenv";
    ASSERT_TRUE(assets::writeEnvironmentPackage(*baked, package));
    ASSERT_TRUE(assets::writeBakedEnvironment(*baked, fenv));
    const auto fromPackage = assets::loadEnvironment(package, jobs, options),
               fromFenv = assets::loadEnvironment(fenv, jobs, {});
    ASSERT_TRUE(fromPackage && fromFenv) << fromPackage.error().message;
    ASSERT_EQ(baked->lights.count, 1u);
    for (assets::EnvironmentData const* data : { &*cached, &*fromPackage, &*fromFenv }) {
        EXPECT_EQ(data->lights.search, SunSearch::Found);
        EXPECT_EQ(data->lights.count, 1u);
        EXPECT_EQ(data->lights.lights[0].direction, baked->lights.lights[0].direction);
        EXPECT_EQ(data->lights.lights[0].illuminance, baked->lights.lights[0].illuminance);
        EXPECT_EQ(data->lights.lights[0].share, baked->lights.lights[0].share);
        EXPECT_EQ(data->specular.data, baked->specular.data);
    }
    const auto kept = assets::loadEnvironment(file, jobs, { .useCache = false, .faceSize = 32, .samples = 8 });
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->sky.data, baked->sky.data) << "the background keeps the sun";
    EXPECT_NE(kept->irradiance.data, baked->irradiance.data);
    ASSERT_TRUE(assets::writeEnvironmentPackage(*kept, package));
    const auto without = assets::loadEnvironment(package, jobs, options);
    ASSERT_TRUE(without);
    EXPECT_EQ(without->lights.search, SunSearch::Baked);
}

} // namespace
} // namespace filament_core
