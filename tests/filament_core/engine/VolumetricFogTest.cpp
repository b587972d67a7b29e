// SPDX-License-Identifier: Apache-2.0
// Volumetric fog on both APIs: light of the sun and of lamps in it against closed forms and integrals, shadows in the
// air, and what it costs where nothing needs it.
#include "tests/filament_core/engine/VolumetricFogStage.h"

#include <gmock/gmock.h>

namespace filament_core {
namespace {

using namespace test;

TEST(VolumetricFog, TheUnshadowedSunHasTheClosedFormWithCellsAndWithout) {
    const float3 towards = glm::normalize(float3(0.2f, 0.3f, -1));
    Fog falling = volumetricFog(0.2f, 0.6f);
    falling.heightFalloff = 0.5f;
    falling.startMeters = 1;
    falling.maximumOpacity = 0.6f;
    falling.albedo = { 1, 0.5f, 0.25f };
    Fog beyond = volumetricFog(0.3f, -0.4f);
    beyond.volumetricMeters = 2; // the plane lies behind the cells
    for (Fog const& fog : { volumetricFog(0.3f, 0), falling, beyond }) {
        for (const bool hasCells : { false, true }) {
            const Image image = litFog(fog, [&](MaterialStage& stage) {
                stage.scene.add(sunFor(stage, towards));
                if (hasCells) addDarkLamp(stage);
            });
            forColumns(image, [&](float4 seen, double3 direction) {
                const double opacity = opacityAlong(fog, 0, direction.y, fog.startMeters, 6 / -direction.z);
                const double light = 0.5 * phase(glm::dot(direction, double3(towards)), fog.anisotropy) * opacity;
                const float3 expected =
                        withoutLight(fog, direction) + fog.albedo * float3(1, 0.5f, 0.25f) * static_cast<float>(light);
                // A pixel lies half a pixel beside the middle of its column.
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 4e-3f * expected[c] + 1e-5f) << hasCells;
            });
        }
    }
}

TEST(VolumetricFog, ALampHasTheLightOfTheIntegral) {
    Fog fog = volumetricFog(0.2f, 0);
    fog.volumetricSlices = 128;
    const double3 lamp(0.4, 0.3, 0.5); // the camera is at z = 4
    const Image image = litFog(fog, [&](MaterialStage& stage) {
        stage.scene.add(
                PointLight{ .positionWorld = lamp, .intensity = Candela{ 2 / stage.view.camera.exposure.factor() } });
    });
    const double3 fromCamera = lamp - double3(0, 0, 4);
    forColumns(image, [&](float4 seen, double3 direction) {
        const double light = 2 * lampAlong(fromCamera, direction, 0.2, 6 / -direction.z, 0);
        const double aside = glm::length(glm::cross(direction, fromCamera));
        const float3 expected = withoutLight(fog, direction) + float3(static_cast<float>(light));
        // Near the lamp its light changes within a cell.
        const double tolerance = aside > 0.6 ? 0.025 : 0.2;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], tolerance * light + 2e-3 * expected[c]) << aside;
    });
}

TEST(VolumetricFog, IsDarkWhereSomethingShadowsIt) {
    const Fog fog = volumetricFog(0.3f, 0);
    const auto underCover = [&](bool isLit, bool isCovered) {
        return litFog(fog, [&](MaterialStage& stage) {
            if (isLit) stage.scene.add(sunFor(stage, { 0, 0, 1 })); // from behind the camera
            stage.view.quality.shadows = ShadowFilter::Pcf3;
            if (isCovered) addPlane(stage, stage.material(paintText("")), -1); // between both
        });
    };
    const Image dark = underCover(false, false);
    EXPECT_NE(underCover(true, false).pixels, dark.pixels);
    EXPECT_EQ(underCover(true, true).pixels, dark.pixels);
}

TEST(VolumetricFog, CellsAreOnlyMadeWhereSomethingNeedsThem) {
    for (const Backend backend : kBothApis) {
        auto engine = makeEngine(backend);
        ASSERT_TRUE(engine);
        MaterialStage stage(*engine);
        Renderer renderer(*engine);
        stage.view.quality.shadows = ShadowFilter::Off;
        stage.view.effects.fog = volumetricFog(0.3f, 0);
        addPlane(stage, stage.material(paintText("")), 6);
        const auto draw = [&] {
            (void)renderer.renderToImage(stage.scene, stage.view);
            return renderer.explain();
        };
        using testing::HasSubstr;
        using testing::Not;
        EXPECT_THAT(draw(), Not(HasSubstr("fog light")));
        EXPECT_THAT(renderer.explain(), HasSubstr("no lamp reaches into the view, and nothing shadows the sun"));
        stage.scene.add(sunFor(stage, { 0, 0, 1 }));
        EXPECT_THAT(draw(), Not(HasSubstr("fog light")));
        addDarkLamp(stage);
        EXPECT_THAT(draw(), HasSubstr("lit by 1 lights of the list; 0 cascades of the sun"));
        EXPECT_THAT(renderer.explain(), HasSubstr("fog light"));
        stage.view.effects.fog.volumetric = false;
        EXPECT_THAT(draw(), Not(HasSubstr("fog light")));
        EXPECT_THAT(renderer.explain(), HasSubstr("switched off: fog.volumetric=off"));
    }
}

TEST(VolumetricFog, ExtremeNumbersGiveFiniteLight) {
    for (const float density : { 1e-4f, 1e4f }) {
        for (const float anisotropy : { -0.95f, 0.95f }) {
            for (const float meters : { 0.1f, 1e5f }) {
                Fog fog = volumetricFog(density, anisotropy);
                fog.volumetricMeters = meters;
                fog.volumetricSlices = 8;
                const Image image = litFog(fog, [&](MaterialStage& stage) {
                    stage.view.size = { 33, 17 };
                    stage.scene.add(sunFor(stage, { 0, 0, -1 }));
                    stage.scene.add(PointLight{ .positionWorld = { 0, 0, 4 }, .intensity = Candela{ 10 } });
                    stage.view.quality.shadows = ShadowFilter::Evsm;
                });
                for (uint32_t y = 0; y < 17; ++y)
                    for (uint32_t x = 0; x < 33; ++x)
                        for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(halfPixel(image, x, y)[c]));
            }
        }
    }
}

TEST(VolumetricFog, ParallelViewsAndOrdinaryDepthsSeeTheSameLight) {
    const Fog fog = volumetricFog(0.3f, 0.3f);
    const float3 towards = glm::normalize(float3(0.2f, 0.3f, -1));
    for (const DepthRange range : { DepthRange::Reversed, DepthRange::Ordinary }) {
        const Image image = litFog(fog, [&](MaterialStage& stage) {
            stage.view.camera.lens.orthographicHeight = 2;
            stage.view.quality.depthRange = range;
            stage.scene.add(sunFor(stage, towards));
            addDarkLamp(stage);
        });
        const double opacity = opacityAlong(fog, 0, 0, 0, 6);
        const double light = 0.5 * phase(-double(towards.z), fog.anisotropy) * opacity;
        const float3 expected =
                foggedPaint(kPaintInFog, fog, opacity) + float3(1, 0.5f, 0.25f) * static_cast<float>(light);
        for (const uint32_t x : { 4u, 31u, 60u }) expectHalf(halfPixel(image, x, 20), expected, "parallel", 2);
    }
}

} // namespace
} // namespace filament_core
