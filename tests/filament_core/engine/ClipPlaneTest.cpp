// SPDX-License-Identifier: Apache-2.0
// A material that cuts what it draws at a plane of its own, View::materialGlobals, without caps. Light, shadows, depths
// and picks are those of the part that is left.
#include "tests/filament_core/engine/ShadowStage.h"

namespace filament_core {
namespace {

using test::ShadowStage;

constexpr const char* kCutAtAPlane = R"(material { name : cut, shadingModel : lit, doubleSided : true }
fragment { void material(inout MaterialInputs material) {
    vec4 plane = getMaterialGlobal0(); // what is behind it is not there
    if (dot(plane, vec4(getUserWorldPosition(), 1.0)) < 0.0) discard;
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.8, 0.2, 0.1);
    material.roughness = 1.0;
} })";

struct ClipPlaneTest : testing::TestWithParam<Backend> {
    ShadowStage stage{ GetParam() };
    Owned<Material> cut = test::loadMaterial(stage.engine, kCutAtAPlane);
    Owned<MaterialInstance> section = stage.engine.own(stage.engine.createInstance(cut));

    /// A square above a floor, all of which is cut at x = 0.31; `left`: the part before it, of which nothing is.
    void fill(Scene& scene, bool left) {
        stage.square.add(scene, stage.white, { 0, 0, 0 }, 3);
        double4x4 world(1.0);
        if (left) world[0][0] = 1.31 / 2, world[3].x = (0.31 - 1) / 2;
        world[3].z = 1;
        stage.square.add(scene, section, world);
        scene.add(SunLight{ .directionWorld = { -0.7f, 0.4f, -1 } });
    }
};
INSTANTIATE_TEST_SUITE_P(BothApis, ClipPlaneTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(ClipPlaneTest, WhatIsLeftLooksAndCastsShadowsLikeAPartOfThatSize) {
    for (const ShadowFilter filter : { ShadowFilter::Off, ShadowFilter::Hard, ShadowFilter::Pcf3 }) {
        Scene whole(stage.engine), part(stage.engine);
        fill(whole, false);
        fill(part, true);
        View view = test::shadowedView({ 1, -4, 4 }, { 0, 0, 0 }, filter, { 128, 96 });
        view.materialGlobals[0] = float4(-1, 0, 0, 0.31f);
        const Image cutPicture = test::renderLinear(stage.engine, whole, view);
        const size_t different = test::differingPixels(cutPicture, test::renderLinear(stage.engine, part, view));
        EXPECT_LE(different, 60u) << "of 12288: along the edges";
        view.materialGlobals[0] = float4(0, 0, 0, 1); // cuts nothing
        EXPECT_GT(test::differingPixels(cutPicture, test::renderLinear(stage.engine, whole, view)), 200u);
    }
}

TEST_P(ClipPlaneTest, WhatIsCutOffCannotBePicked) {
    Scene scene(stage.engine);
    fill(scene, false);
    Renderer renderer(stage.engine);
    View view{ .camera = Camera::lookAt({ 0, 0, 6 }, { 0, 0, 0 }, {}, {}, { 0, 1, 0 }), .size = { 96, 96 } };
    view.materialGlobals[0] = float4(-1, 0, 0, 0.31f);
    EXPECT_NEAR(renderer.waitPick(renderer.pick(scene, view, { 40, 48 })).value().positionWorld.z, 1, 1e-4);
    EXPECT_NEAR(renderer.waitPick(renderer.pick(scene, view, { 60, 48 })).value().positionWorld.z, 0, 1e-4);
    view.materialGlobals[0] = float4(0, 0, 0, 1);
    EXPECT_NEAR(renderer.waitPick(renderer.pick(scene, view, { 60, 48 })).value().positionWorld.z, 1, 1e-4);
}

} // namespace
} // namespace filament_core
