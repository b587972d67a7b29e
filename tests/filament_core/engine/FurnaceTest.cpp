// SPDX-License-Identifier: Apache-2.0
// White furnace: in a constant environment a surface that absorbs nothing is invisible. The environment itself is not
// drawn: the background is a grey that nothing in the furnace reflects, which shows where the sphere is.
#include "filament_core/engine/gltf/GltfMaterials.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/filament_core/engine/WhiteEnvironment.h"
#include "tests/scenes/Sphere.h"

#include "shaders/package/EngineMaterials.h"

#include <numbers>

namespace filament_core {
namespace {

constexpr float kBackground = 0.25f; // exact in half floats

/// A sphere in a white environment.
class Furnace {
public:
    explicit Furnace(Engine& engine, const char* package = "gltf_lit_opaque")
            : mEngine(engine), mEnvironment(engine), mSphere(engine, scenes::makeSphere()), mScene(engine) {
        mEnvironment.light(mScene, mView.camera);
        mMaterial = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial(package) }));
        mInstance = engine.own(engine.createInstance(mMaterial, "white"));
        EXPECT_TRUE(engine.setDoubleSided(mInstance, false)); // else the far half shows through the near one
        mScene.add(mSphere.renderable(mInstance));
        mView.camera = Camera::lookAt({ 0, 0, kDistance }, { 0, 0, 0 }, { .verticalFovDegrees = kFovDegrees });
        mView.size = { kPixels, kPixels };
        mView.clearColor = float4(kBackground);
    }

    /// The sphere's radius is 1: the half angle of the cone that touches it is asin(1 / distance).
    static double coveredPixels() {
        const double silhouette = 1 / std::sqrt(kDistance * kDistance - 1);
        const double halfPicture = std::tan(kFovDegrees / 2 * std::numbers::pi / 180);
        const double radius = silhouette / halfPicture * kPixels / 2;
        return std::numbers::pi * radius * radius;
    }

    Image render(float4 baseColor, float metallic, float roughness) {
        EXPECT_TRUE(mEngine.set(mInstance, "baseColorFactor", baseColor));
        EXPECT_TRUE(mEngine.set(mInstance, "metallicFactor", metallic));
        EXPECT_TRUE(mEngine.set(mInstance, "roughnessFactor", roughness));
        return test::renderLinear(mEngine, mScene, mView);
    }

private:
    static constexpr uint32_t kPixels = 96;
    static constexpr double kDistance = 3, kFovDegrees = 45;

    Engine& mEngine;
    View mView;
    WhiteEnvironment mEnvironment;
    scenes::Sphere mSphere;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
    Scene mScene;
};

/// Statistics of the sphere's pixels; there must be as many as its silhouette covers.
test::Extremes extremesOfSphere(Image const& image) {
    test::Extremes found;
    size_t covered = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const float4 pixel = test::halfPixel(image, x, y);
            if (float3(pixel) == float3(kBackground)) continue;
            ++covered;
            for (int c = 0; c < 3; ++c) {
                EXPECT_TRUE(std::isfinite(pixel[c]));
                found.least = std::min(found.least, pixel[c]);
                found.most = std::max(found.most, pixel[c]);
            }
        }
    }
    // The mesh is a polyhedron inside the sphere.
    EXPECT_NEAR(static_cast<double>(covered) / Furnace::coveredPixels(), 1, 0.02);
    return found;
}

class FurnaceTest : public testing::TestWithParam<Backend> {};

TEST_P(FurnaceTest, AWhiteMetalSphereIsInvisibleAtEveryRoughness) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Furnace furnace(*engine);
    for (int step = 0; step <= 10; ++step) {
        const float roughness = static_cast<float>(step) / 10;
        const test::Extremes pixels = extremesOfSphere(furnace.render(float4(1), 1, roughness));
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
        const test::Extremes white = extremesOfSphere(furnace.render(float4(1), 0, roughness));
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

// glTF 2.0, 3.9.4: alpha is the covered fraction of the surface. What is not there does not reflect.
TEST_P(FurnaceTest, ABlendedSphereHidesAsMuchAsItsAlpha) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    for (const char* package : { "gltf_lit_blended", "gltf_layered_blended", "gltf_transmissive_thin_blended",
                                 "gltf_transmissive_solid_blended", "gltf_scattering_blended" }) {
        Furnace furnace(*engine, package);
        for (const float metallic : { 0.0f, 1.0f }) {
            const Image absent = furnace.render(float4(1, 1, 1, 0), metallic, 0.5f);
            EXPECT_EQ(test::halfPixel(absent, 48, 48).x, kBackground) << package << ", metallic " << metallic;
            const Image half = furnace.render(float4(1, 1, 1, 0.5f), metallic, 0.5f);
            EXPECT_NEAR(test::halfPixel(half, 48, 48).x, 0.5f + 0.5f * kBackground, 0.003f) << package;
        }
    }
    test::expectNoErrors(*engine);
}

INSTANTIATE_TEST_SUITE_P(BothApis, FurnaceTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
