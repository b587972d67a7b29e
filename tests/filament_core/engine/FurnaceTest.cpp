// SPDX-License-Identifier: Apache-2.0
// White furnace: in a constant environment a surface that absorbs nothing is invisible.
#include "filament_core/engine/gltf/GltfMaterials.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/filament_core/engine/WhiteEnvironment.h"
#include "tests/scenes/Sphere.h"

#include "shaders/package/EngineMaterials.h"

namespace filament {
namespace {

/// A sphere in a white environment.
class Furnace {
public:
    explicit Furnace(Engine& engine)
            : mEngine(engine), mEnvironment(engine), mSphere(engine, scenes::makeSphere()), mScene(engine) {
        mEnvironment.light(mScene, mView.camera);
        mMaterial = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_opaque") }));
        mInstance = engine.own(engine.createInstance(mMaterial, "white"));
        mScene.add(mSphere.renderable(mInstance));
        mView.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 });
        mView.size = { 96, 96 };
        mView.clearColor = float4(1); // what the skybox of this environment would be
    }

    Image render(float4 baseColor, float metallic, float roughness) {
        EXPECT_TRUE(mEngine.set(mInstance, "baseColorFactor", baseColor));
        EXPECT_TRUE(mEngine.set(mInstance, "metallicFactor", metallic));
        EXPECT_TRUE(mEngine.set(mInstance, "roughnessFactor", roughness));
        return test::renderLinear(mEngine, mScene, mView);
    }

private:
    Engine& mEngine;
    View mView;
    WhiteEnvironment mEnvironment;
    scenes::Sphere mSphere;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
    Scene mScene;
};

class FurnaceTest : public testing::TestWithParam<Backend> {};

TEST_P(FurnaceTest, AWhiteMetalSphereIsInvisibleAtEveryRoughness) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Furnace furnace(*engine);
    for (int step = 0; step <= 10; ++step) {
        const float roughness = static_cast<float>(step) / 10;
        const test::Extremes pixels = test::extremesOf(furnace.render(float4(1), 1, roughness));
        EXPECT_GE(pixels.least, 0.99f) << "roughness " << roughness;
        EXPECT_LE(pixels.most, 1.01f) << "roughness " << roughness;
    }
    test::expectNoErrors(*engine);
}

TEST_P(FurnaceTest, ADielectricNeverReflectsMoreThanItReceives) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Furnace furnace(*engine);
    for (int step = 0; step <= 4; ++step) {
        const float roughness = static_cast<float>(step) / 4;
        const test::Extremes white = test::extremesOf(furnace.render(float4(1), 0, roughness));
        EXPECT_LE(white.most, 1.0f + 1.0f / 1024) << "roughness " << roughness; // one step of fp16 above 1
        EXPECT_GE(white.least, 0.8f) << "a white dielectric loses little, roughness " << roughness;
    }
    test::expectNoErrors(*engine);
}

TEST_P(FurnaceTest, ABlackDielectricShowsItsFresnelReflectanceOnly) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Furnace furnace(*engine);
    const Image image = furnace.render(float4(0, 0, 0, 1), 0, 0.0f);
    // Facing the camera: Schlick at normal incidence is F0 = 4 %.
    EXPECT_NEAR(test::halfPixel(image, 48, 48).x, 0.04f, 0.004f);
}

INSTANTIATE_TEST_SUITE_P(BothApis, FurnaceTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament
