// SPDX-License-Identifier: Apache-2.0
// pixelDepthOffset beside geometry: a floor whose points lie half a metre deeper looks like a floor that lies there.
#include "tests/filament_core/engine/ShadowStage.h"

namespace filament_core {
namespace {

using test::ShadowStage;

std::string sunkFloor(std::string const& head) {
    return "material { name : sunk, shadingModel : " + head + R"( }
fragment { void material(inout MaterialInputs material) {
#if !defined(SHADING_MODEL_UNLIT)
    prepareMaterial(material);
    material.roughness = 1.0;
#endif
    material.baseColor.rgb = vec3(0.4, 0.5, 0.6);
    material.pixelDepthOffset = materialParams.depth / max(getWorldViewVector().z, 0.05);
} })";
}

const std::string kLitFloor = sunkFloor("lit, parameters : [ { type : float, name : depth } ]");
const std::string kUnlitFloor = sunkFloor("unlit, parameters : [ { type : float, name : depth } ]");

struct PixelDepthOffsetTest : testing::TestWithParam<Backend> {
    ShadowStage stage{ GetParam() };
    Owned<Material> lit = test::loadMaterial(stage.engine, kLitFloor);
    Owned<Material> unlit = test::loadMaterial(stage.engine, kUnlitFloor);

    /// A floor at z of points `depth` metres below it, a tilted square through it, and one above that throws a shadow.
    Image image(Material const& material, double z, float depth, View const& view) {
        Scene scene(stage.engine);
        const Owned<MaterialInstance> floor = stage.engine.own(stage.engine.createInstance(material));
        EXPECT_TRUE(stage.engine.set(floor, "depth", depth));
        stage.square.add(scene, floor, { 0, 0, z }, 60);
        const double4x4 tilted = glm::rotate(double4x4(1.0), 1.0, double3(1, 0, 0));
        stage.square.add(scene, stage.white, tilted);
        stage.square.add(scene, stage.white, { 1.5, 1, 1 }, 0.5);
        scene.add(SunLight{ .directionWorld = { -0.5f, 0.3f, -1 } });
        return test::renderLinear(stage.engine, scene, view);
    }

    void expectLikeGeometry(Material const& material, View const& view, size_t most) {
        const Image moved = image(material, 0, 0.5f, view);
        EXPECT_LE(test::differingPixels(moved, image(material, -0.5, 0, view)), most);
        EXPECT_GT(test::differingPixels(moved, image(material, 0, 0, view)), 300u);
        EXPECT_EQ(test::differingPixels(image(material, 0, -0.5f, view), image(material, 0, 0, view)), 0u)
                << "no point is nearer than the surface";
    }
};
INSTANTIATE_TEST_SUITE_P(BothApis, PixelDepthOffsetTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

View viewOfFloor(ShadowFilter filter) { return test::shadowedView({ 1, -4, 4 }, { 0, 0, 0 }, filter, { 128, 96 }); }

TEST_P(PixelDepthOffsetTest, ALitFloorHidesAndHasShadowsWhereItsPointsAre) {
    for (const ShadowFilter filter : { ShadowFilter::Off, ShadowFilter::Hard, ShadowFilter::Pcf3 })
        expectLikeGeometry(lit, viewOfFloor(filter), 60);
}

TEST_P(PixelDepthOffsetTest, AnUnlitFloorHidesWhereItsPointsAre) {
    expectLikeGeometry(unlit, viewOfFloor(ShadowFilter::Off), 20);
}

TEST_P(PixelDepthOffsetTest, WhatReadsDepthReadsThatOfThePoints) {
    View view = viewOfFloor(ShadowFilter::Off);
    view.effects.ambientOcclusion.enabled = true;
    expectLikeGeometry(lit, view, 60);
    view.samples = 4;
    expectLikeGeometry(lit, view, 200);
}

TEST_P(PixelDepthOffsetTest, APickFindsThePoint) {
    Scene scene(stage.engine);
    const Owned<MaterialInstance> floor = stage.engine.own(stage.engine.createInstance(lit));
    ASSERT_TRUE(stage.engine.set(floor, "depth", 0.5f));
    stage.square.add(scene, floor, { 0, 0, 0 }, 60);
    Renderer renderer(stage.engine);
    const View view{ .camera = Camera::lookAt({ 0, -2, 3 }, { 0, 0, 0 }), .size = { 96, 96 } };
    EXPECT_NEAR(renderer.waitPick(renderer.pick(scene, view, { 48, 48 })).value().positionWorld.z, -0.5, 1e-3);
}

} // namespace
} // namespace filament_core
