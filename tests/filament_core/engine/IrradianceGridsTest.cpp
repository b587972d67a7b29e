// SPDX-License-Identifier: Apache-2.0
// Irradiance grids on both APIs: white surfaces against the light of the probes, and what a view says of them.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/scenes/GridOf.h"

#include <glm/ext/matrix_transform.hpp>

namespace filament_core {
namespace {

using namespace test;
using scenes::ambientOf;
using scenes::gridOf;

const std::string& whiteLambert() {
    static const std::string kText =
            text("shadingModel : lit", "material.baseColor = vec4(1.0); material.roughness = 1.0; "
                                       "material.reflectance = 0.0;");
    return kText;
}

const std::string& mirror() {
    static const std::string kText =
            text("shadingModel : lit", "material.baseColor = vec4(1.0); material.metallic = 1.0; "
                                       "material.roughness = 0.0;");
    return kText;
}

float nitsOfWhite(MaterialStage const& stage) { return 1 / stage.view.camera.exposure.factor(); }

/// Brighter to the right: 1 at x = 0, half a unit a metre.
IrradianceGridDesc rightwards(MaterialStage const& stage, double3 center = double3(0)) {
    IrradianceGridDesc grid = gridOf({ 2, 2, 2 }, { 5, 2, 2 }, [](float3 p) { return ambientOf(float3(1 + p.x / 2)); });
    grid.centerWorld = center;
    grid.intensity = nitsOfWhite(stage);
    return grid;
}

/// A square of half a metre in front of the camera at this place.
Renderable addTile(MaterialStage& stage, MaterialInstance instance, double3 at) {
    RenderableDesc tile = stage.describe(instance, { { .halfSide = 0.25f } }, glm::translate(double4x4(1.0), at));
    tile.bounds = Box{ double3(-0.25, -0.25, 0), double3(0.25, 0.25, 0) };
    return stage.scene.add(tile);
}

constexpr uint32_t kImageSide = 33;

/// The column of a place at z = 0, seen by the stage's camera from 4 m.
uint32_t columnOf(float x) {
    return static_cast<uint32_t>((x / (4 * std::tan(glm::radians(22.5f))) * 0.5f + 0.5f) *
                                 static_cast<float>(kImageSide));
}

template <class Build>
Image inGrid(double3 origin, Build&& build) {
    return onBothApis([&](MaterialStage& stage) {
        stage.view.size = uint2(kImageSide);
        stage.view.camera = Camera::lookAt(origin + double3(0, 0, 4), origin, { .verticalFovDegrees = 45 });
        build(stage);
    });
}

TEST(IrradianceGrids, SurfacesHaveTheLightOfTheirPlaceInASceneWithoutAnEnvironment) {
    const Image image = inGrid(double3(0), [](MaterialStage& stage) {
        const MaterialInstance white = stage.material(whiteLambert(), kNoLights);
        for (const double x : { -1.0, 0.0, 1.0 }) addTile(stage, white, { x, 0, 0 });
        stage.scene.add(rightwards(stage));
    });
    for (const float x : { -1.2f, -1.0f, -0.8f, 0.0f, 0.2f, 1.1f })
        EXPECT_NEAR(halfPixel(image, columnOf(x), kImageSide / 2).x, 1 + x / 2, 0.04f) << x;
}

TEST(IrradianceGrids, ItIsTheSameFarFromTheOrigin) {
    const double3 far(3e6, -1e6, 2e6);
    const Image image = inGrid(far, [&](MaterialStage& stage) {
        addTile(stage, stage.material(whiteLambert(), kNoLights), far);
        stage.scene.add(rightwards(stage, far));
    });
    EXPECT_NEAR(halfPixel(image, columnOf(0.2f), kImageSide / 2).x, 1.1f, 0.04f);
    EXPECT_NEAR(halfPixel(image, columnOf(-0.2f), kImageSide / 2).x, 0.9f, 0.04f);
}

TEST(IrradianceGrids, TheyReplaceTheDiffuseLightOfTheEnvironmentAlone) {
    const auto middle = [](std::string const& material) {
        return centerPixel(inGrid(double3(0),
                                  [&](MaterialStage& stage) {
                                      stage.keep(std::make_shared<SkyObjects>(stage, Sky{ float3(0.25f) }));
                                      addTile(stage, stage.material(material, kNoLights), double3(0));
                                      stage.scene.add(rightwards(stage));
                                  }))
                .x;
    };
    EXPECT_NEAR(middle(whiteLambert()), 1, 0.01f);
    EXPECT_NEAR(middle(mirror()), 0.25f, 0.01f);
}

// An environment of 0 lux does not show beside the light of a grid, in half floats, either: neither its reflections nor
// its diffuse light on what no grid reaches.
TEST(IrradianceGrids, TheyLightAloneWhereTheEnvironmentIsDark) {
    const Image image = inGrid(double3(0), [](MaterialStage& stage) {
        stage.view.quality.shadingPrecision = ShadingPrecision::Half;
        const auto sky = std::make_shared<SkyObjects>(stage, Sky{ float3(4) });
        stage.keep(sky);
        stage.scene.setIndirectLight(sky->light, Lux{ 0 });
        const MaterialInstance white = stage.material(whiteLambert(), kNoLights);
        for (const double x : { -1.0, 0.0 }) addTile(stage, white, { x, 0, 0 });
        addTile(stage, stage.material(mirror(), kNoLights), { 0, 0.6, 0 });
        IrradianceGridDesc grid = rightwards(stage);
        grid.halfExtentMeters = { 0.5f, 2, 2 };
        grid.blendMeters = 0.1f;
        stage.scene.add(grid);
    });
    EXPECT_NEAR(halfPixel(image, columnOf(0), kImageSide / 2).x, 1, 0.3f);
    EXPECT_EQ(halfPixel(image, columnOf(-1), kImageSide / 2).x, 0);
    EXPECT_EQ(halfPixel(image, columnOf(0), kImageSide - 1 - columnOf(0.6f)).x, 0);
}

TEST(IrradianceGrids, LightFromOneSideIsThatOfTheNormal) {
    // From +z, which the square faces, and as much from above, which it does not see more of.
    const Image image = inGrid(double3(0), [](MaterialStage& stage) {
        addTile(stage, stage.material(whiteLambert(), kNoLights), double3(0));
        IrradianceGridDesc grid = gridOf(float3(2), uint3(2), [](float3) {
            std::array<float3, 9> light = ambientOf(float3(0.5f));
            light[2] = float3(0.25f, 0, 0); // z
            light[1] = float3(0, 0.25f, 0); // y
            light[6] = float3(0, 0, 0.1f);  // 3 z^2 - 1
            return light;
        });
        grid.intensity = nitsOfWhite(stage);
        stage.scene.add(grid);
    });
    expectNear(centerPixel(image), { 0.75f, 0.5f, 0.7f }, 0.01f);
}

TEST(IrradianceGrids, OutOfViewTheyChangeNothing) {
    const auto drawn = [](bool hasGrid) {
        return inGrid(double3(0), [&](MaterialStage& stage) {
            stage.keep(std::make_shared<SkyObjects>(stage, kDirectionSky));
            addTile(stage, stage.material(whiteLambert(), kNoLights), double3(0));
            if (!hasGrid) return;
            stage.scene.add(rightwards(stage, { 0, 0, 30 })); // behind the camera
            Renderer renderer(stage.engine);
            EXPECT_TRUE(renderer.renderToImage(stage.scene, stage.view));
            for (EffectDecision const& one : renderer.decisions()) {
                if (one.name != "irradiance grids") continue;
                EXPECT_EQ(one.state, EffectDecision::State::NotNeeded);
                EXPECT_EQ(one.reason, "none of 1 reaches a lit surface in view");
            }
        });
    };
    EXPECT_EQ(drawn(true).pixels, drawn(false).pixels);
}

TEST(IrradianceGrids, InstancesEachHaveTheirOwnLight) {
    const auto drawn = [](bool isInstanced) {
        return inGrid(double3(0), [&](MaterialStage& stage) {
            const MaterialInstance white = stage.material(whiteLambert(), kNoLights);
            RenderableDesc tile = stage.describe(white, { { .halfSide = 0.25f } });
            tile.bounds = Box{ double3(-0.25, -0.25, 0), double3(0.25, 0.25, 0) };
            for (const double x : { -1.0, 0.0, 1.0 }) {
                if (!isInstanced) {
                    addTile(stage, white, { x, 0, 0 });
                    continue;
                }
                tile.worldFromObject = glm::translate(double4x4(1.0), double3(x, 0, 0));
                stage.scene.add(tile);
            }
            stage.scene.add(rightwards(stage));
        });
    };
    EXPECT_EQ(drawn(true).pixels, drawn(false).pixels);
}

TEST(IrradianceGrids, WhatMovesIsEvaluatedAgainAndNothingElse) {
    inGrid(double3(0), [](MaterialStage& stage) {
        const MaterialInstance white = stage.material(whiteLambert(), kNoLights);
        const Renderable moving = addTile(stage, white, double3(0));
        addTile(stage, white, { 1, 0, 0 });
        IrradianceGridDesc named = rightwards(stage);
        named.name = "hall";
        const IrradianceGrid grid = stage.scene.add(named);
        Renderer renderer(stage.engine);
        const auto explained = [&] {
            EXPECT_TRUE(renderer.renderToImage(stage.scene, stage.view));
            return renderer.explain();
        };
        EXPECT_NE(explained().find("2 objects, 2 of them evaluated in this frame"), std::string::npos);
        EXPECT_NE(explained().find("2 objects, 0 of them evaluated in this frame"), std::string::npos);
        stage.scene.setTransform(moving, glm::translate(double4x4(1.0), double3(-1, 0, 0)));
        EXPECT_NE(explained().find("2 objects, 1 of them evaluated in this frame"), std::string::npos);
        const std::string last = explained();
        EXPECT_NE(last.find("irradiance grid 'hall': used; 5 x 2 x 2 probes, 0 of them inside of geometry"),
                  std::string::npos)
                << last;
        stage.scene.remove(grid);
        EXPECT_EQ(stage.scene.irradianceGridCount(), 0u);
        EXPECT_EQ(explained().find("irradiance grid"), explained().find("irradiance grids")); // the effect's line alone
    });
}

} // namespace
} // namespace filament_core
