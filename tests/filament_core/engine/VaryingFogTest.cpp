// SPDX-License-Identifier: Apache-2.0
// Volumetric fog whose density varies, and that weakens light on its way, on both APIs: against sums along rays that
// ignore cells.
#include "tests/filament_core/engine/VolumetricFogStage.h"

#include "shaders/lib/LibCpp.h"

#include <gmock/gmock.h>

namespace filament_core {
namespace {

using namespace test;

const double3 kEye(0, 0, 4); // of MaterialStage

Fog varyingFog(float density) {
    Fog fog = volumetricFog(density, 0);
    fog.volumetricSlices = 128;
    fog.noiseAmplitude = 0.9f;
    fog.noiseMeters = 3;
    fog.noiseOctaves = 1;
    return fog;
}

/// By a fine sum of the density, of fog without start and end.
double varyingOpacity(Fog const& fog, double3 direction, double meters, double3 moved) {
    constexpr int kSteps = 2000;
    double depth = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double3 point = kEye - moved + direction * (meters * (i + 0.5) / kSteps);
        const float noise = shader::lib::fogNoise(float3(point / double(fog.noiseMeters)), fog.noiseOctaves, 0.0f);
        depth += double(fog.density) * std::exp(-double(fog.heightFalloff) * point.y) *
                 (1 + double(fog.noiseAmplitude * noise));
    }
    return -std::expm1(-depth * meters / kSteps);
}

TEST(VaryingFog, IsAsOpaqueAsTheSumOfItsDensity) {
    Fog falling = varyingFog(0.25f);
    falling.heightFalloff = 0.4f;
    falling.noiseOctaves = 2;
    Fog blown = varyingFog(0.2f);
    blown.noiseWind = { 0.5f, -0.25f, 1 };
    Fog beyond = varyingFog(0.2f);
    beyond.volumetricMeters = 5.9f; // the plane lies just behind the cells
    for (Fog const& fog : { varyingFog(0.3f), falling, blown, beyond }) {
        const Image image = litFog(fog, [](MaterialStage& stage) { stage.view.timeSeconds = 3; });
        double most = 0;
        forColumns(image, [&](float4 seen, double3 direction) {
            const double meters = 6 / -direction.z;
            const double opacity = varyingOpacity(fog, direction, meters, double3(fog.noiseWind) * 3.0);
            const float3 expected = foggedPaint(kPaintInFog, fog, opacity);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 8e-3f) << fog.volumetricMeters;
            most = std::max(most, std::abs(opacity - opacityAlong(fog, 0, direction.y, 0, meters)));
        });
        EXPECT_GT(most, 0.03) << "even fog would not differ";
    }
}

TEST(VaryingFog, LightOfTheSunGrowsWithItsOpacity) {
    const float3 towards = glm::normalize(float3(0.2f, 0.3f, -1));
    const Fog fog = varyingFog(0.3f);
    const Image image = litFog(fog, [&](MaterialStage& stage) { stage.scene.add(sunFor(stage, towards)); });
    forColumns(image, [&](float4 seen, double3 direction) {
        const double opacity = varyingOpacity(fog, direction, 6 / -direction.z, double3(0.0));
        const auto light = static_cast<float>(0.5 * phase(0, 0) * opacity);
        const float3 expected = foggedPaint(kPaintInFog, fog, opacity) + float3(1, 0.5f, 0.25f) * light;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 8e-3f);
    });
}

TEST(VaryingFog, SwirlsSmallerThanCellsLeaveEvenFog) {
    Fog fog = varyingFog(0.3f);
    fog.noiseMeters = 0.01f;
    fog.noiseOctaves = 4;
    fog.startMeters = 0.5f; // nearer cells are smaller
    const Image image = litFog(fog, [](MaterialStage&) {});
    forColumns(image, [&](float4 seen, double3 direction) {
        const float3 expected = withoutLight(fog, direction);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 3e-3f);
    });
}

TEST(VaryingFog, HasTheSameBitsFarFromTheOrigin) {
    Fog fog = varyingFog(0.3f);
    fog.noiseMeters = 4; // so that it repeats after 1024 m
    const auto from = [&](double3 origin) {
        return litFog(fog, [&](MaterialStage& stage) {
            stage.view.camera = Camera::lookAt(origin + kEye, origin, { .verticalFovDegrees = 45 });
        });
    };
    EXPECT_EQ(from(double3(0)).pixels, from({ 1024e4, 0, -2048e4 }).pixels);
    EXPECT_NE(from(double3(0)).pixels, from({ 2, 0, 0 }).pixels);
}

TEST(VaryingFog, OnlyAmplitudeMakesCells) {
    for (const Backend backend : kBothApis) {
        auto engine = makeEngine(backend);
        ASSERT_TRUE(engine);
        MaterialStage stage(*engine);
        Renderer renderer(*engine);
        stage.view.effects.fog = varyingFog(0.3f);
        addPlane(stage, stage.material(paintText("")), 6);
        const auto draw = [&] {
            const Image image = renderLinear(*engine, renderer, stage.scene, stage.view);
            return std::pair(renderer.explain(), image.pixels);
        };
        using testing::HasSubstr;
        using testing::Not;
        EXPECT_THAT(draw().first, testing::AllOf(HasSubstr("fog light"), HasSubstr("its density varies")));
        stage.view.effects.fog.noiseAmplitude = 0;
        const auto [even, pixels] = draw();
        EXPECT_THAT(even, Not(HasSubstr("fog light")));
        stage.view.effects.fog = volumetricFog(0.3f, 0);
        EXPECT_EQ(draw().second, pixels) << "the other numbers of the noise do nothing";
        stage.view.effects.fog.noiseAmplitude = 0.5f;
        stage.view.effects.fog.volumetric = false;
        EXPECT_THAT(draw().first, Not(HasSubstr("fog light")));
    }
}

TEST(WeakeningFog, ALampHasTheLightOfTheIntegral) {
    Fog fog = volumetricFog(0.3f, 0);
    fog.volumetricSlices = 128;
    fog.attenuatesLight = true;
    const double3 lamp(0.4, 0.3, 0.5);
    const Image image = litFog(fog, [&](MaterialStage& stage) {
        stage.scene.add(
                PointLight{ .positionWorld = lamp, .intensity = Candela{ 2 / stage.view.camera.exposure.factor() } });
    });
    forColumns(image, [&](float4 seen, double3 direction) {
        const double light = 2 * lampAlong(lamp - kEye, direction, 0.3, 6 / -direction.z, 0.3);
        const double aside = glm::length(glm::cross(direction, lamp - kEye));
        const float3 expected = withoutLight(fog, direction) + float3(static_cast<float>(light));
        const double tolerance = aside > 0.6 ? 0.025 : 0.2;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], tolerance * light + 2e-3 * expected[c]) << aside;
    });
}

/// What of the sun a camera sees in fog that falls off with height, by a fine sum.
double sunAlong(Fog const& fog, double3 direction, double towardsY, double meters) {
    constexpr int kSteps = 20'000;
    const auto falloff = double(fog.heightFalloff);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double t = meters * (i + 0.5) / kSteps;
        const double density = double(fog.density) * std::exp(-falloff * direction.y * t);
        const double before = -std::log1p(-opacityAlong(fog, 0, direction.y, 0, t));
        sum += density * std::exp(-before - density / (falloff * towardsY));
    }
    return sum * meters / kSteps;
}

TEST(WeakeningFog, TheSunReachesLessOfDeeperFog) {
    const float3 towards = glm::normalize(float3(0.2f, 0.8f, -0.4f));
    Fog fog = volumetricFog(0.2f, 0);
    fog.volumetricSlices = 128;
    fog.heightFalloff = 0.5f;
    fog.attenuatesLight = true;
    const Image image = litFog(fog, [&](MaterialStage& stage) { stage.scene.add(sunFor(stage, towards)); });
    forColumns(image, [&](float4 seen, double3 direction) {
        const auto light =
                static_cast<float>(0.5 * phase(0, 0) * sunAlong(fog, direction, double(towards.y), 6 / -direction.z));
        const float3 expected = withoutLight(fog, direction) + float3(1, 0.5f, 0.25f) * light;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 6e-3f * expected[c] + 1e-4f);
    });
}

TEST(WeakeningFog, NoSunReachesFogWithoutEnd) {
    Fog fog = volumetricFog(0.3f, 0);
    fog.attenuatesLight = true;
    fog.volumetricMeters = 3; // behind the cells, too
    const auto lit = [&](bool hasSun) {
        return litFog(fog, [&](MaterialStage& stage) {
            if (hasSun) stage.scene.add(sunFor(stage, { 0, 1, 0 }));
            addDarkLamp(stage);
        });
    };
    EXPECT_EQ(lit(true).pixels, lit(false).pixels);
}

} // namespace
} // namespace filament_core
