// SPDX-License-Identifier: Apache-2.0
// A computed sky in a scene: its light on a white floor against the integral of its panorama and its sun, the disc, and
// what is refused.
#include "filament_core/assets/environment/Panorama.h"
#include "filament_core/assets/environment/PhysicalSky.h"
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/Sky.h>
#include <glm/ext/matrix_transform.hpp>

#include <numbers>

namespace filament_core {
namespace {

using test::MaterialStage;

const EnvironmentLoadOptions kSmallBake{ .faceSize = 64, .samples = 64 };

/// Of a level surface, lux.
double3 levelIlluminance(SkyDesc const& desc) {
    jobs::JobSystem jobs({ .workers = 1 });
    const Result<assets::PhysicalSky> sky = assets::makePhysicalSky(desc, jobs);
    if (!sky) return double3(0);
    assets::HdrImage const& panorama = sky->panorama;
    double3 sum(0);
    const double pixel = std::numbers::pi / panorama.height;
    for (uint32_t y = 0; y < panorama.height / 2; ++y) {
        const double theta = (y + 0.5) * pixel;
        for (uint32_t x = 0; x < panorama.width; ++x)
            sum += double3(panorama.pixels[size_t(y) * panorama.width + x]) *
                   (std::cos(theta) * std::sin(theta) * pixel * pixel);
    }
    for (uint32_t i = 0; i < sky->lights.count; ++i)
        sum += double3(sky->lights.lights[i].illuminance) * std::max(0.0, double(sky->lights.lights[i].direction.y));
    return 1000.0 * sum;
}

Image underComputedSky(SkyDesc const& desc, std::function<void(MaterialStage&)> const& build) {
    return test::onBothApis([&](MaterialStage& stage) {
        Result<Environment> sky = loadSky(stage.engine, desc, kSmallBake);
        ASSERT_TRUE(sky.ok()) << sky.error().message;
        const auto kept = std::make_shared<Environment>(std::move(*sky));
        stage.keep(kept);
        stage.scene.setEnvironment(*kept, kSkySettings);
        stage.view.size = { 9, 9 };
        build(stage);
    });
}

TEST(LoadSky, AWhiteFloorHasTheLightOfThePanoramaAndTheSun) {
    const std::array skies{ SkyDesc{ .directionToSun = { 0.3f, 0.9f, 0.2f }, .height = 64 },
                            SkyDesc{ .directionToSun = { 0.8f, 0.2f, 0.1f }, .turbidity = 5, .height = 64 },
                            SkyDesc{ .directionToSun = { 0.8f, -0.1f, 0.1f }, .height = 64 } };
    for (SkyDesc const& desc : skies) {
        float exposure = 1;
        const Image image = underComputedSky(desc, [&](MaterialStage& stage) {
            stage.view.camera = Camera::lookAt({ 0, 3, 0.01 }, { 0, 0, 0 }, { .verticalFovDegrees = 5 });
            if (desc.directionToSun.y < 0) stage.view.camera.exposure = { 2, 0.1f, 400 };
            exposure = stage.view.camera.exposure.factor();
            const auto white = stage.material(test::text("shadingModel : lit",
                                                         "material.baseColor = vec4(1.0); material.roughness = 1.0; "
                                                         "material.reflectance = 0.0;"),
                                              test::kNoShadows);
            stage.add(white, { {} }, glm::rotate(double4x4(1.0), -std::numbers::pi / 2, double3(1, 0, 0)));
        });
        const double3 expected = levelIlluminance(desc) / std::numbers::pi * double(exposure);
        const float4 seen = test::halfPixel(image, 4, 4);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(seen[c], 1e-3f) << c;
            EXPECT_NEAR(seen[c] / expected[c], 1, 0.03) << c << ' ' << desc.directionToSun.y;
        }
    }
}

TEST(LoadSky, TheDiscIsWhereTheSunIs) {
    const auto seen = [](bool showsDisc) {
        SkyDesc desc{ .directionToSun = { 0.2f, 0.4f, -0.9f }, .height = 64 };
        desc.showsDisc = showsDisc;
        const Image image = underComputedSky(desc, [&](MaterialStage& stage) {
            stage.view.camera = Camera::lookAt({ 0, 0, 0 }, double3(desc.directionToSun), { .verticalFovDegrees = 2 });
            stage.view.camera.exposure = { 22, 1e-5f, 50 };
        });
        return test::halfPixel(image, 4, 4).x / test::halfPixel(image, 0, 0).x;
    };
    EXPECT_GT(seen(true), 1000) << "about 1.5e9 candela / m2 in a sky of some thousand";
    EXPECT_NEAR(seen(false), 1, 0.05);
}

TEST(LoadSky, InvalidSkiesAreRefusedByName) {
    std::optional<Engine> engine = test::makeEngine(Backend::Null, 0);
    const auto message = [&](SkyDesc const& desc) {
        const Result<Environment> sky = loadSky(*engine, desc, kSmallBake);
        return sky ? std::string() : sky.error().message;
    };
    EXPECT_NE(message({ .turbidity = 0.5f }).find("turbidity"), std::string::npos);
    EXPECT_NE(message({ .directionToSun = { 0, 0, 0 } }).find("directionToSun"), std::string::npos);
    EXPECT_NE(message({ .groundAlbedo = { 2, 0, 0 } }).find("groundAlbedo"), std::string::npos);
    EXPECT_NE(message({ .altitudeMeters = -1 }).find("altitudeMeters"), std::string::npos);
    EXPECT_NE(message({ .height = 15 }).find("height"), std::string::npos);
    EXPECT_EQ(skyFog(*engine, { .turbidity = 99 }).error().code, ErrorCode::InvalidArgument);
}

} // namespace
} // namespace filament_core
