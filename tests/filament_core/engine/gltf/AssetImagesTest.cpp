// SPDX-License-Identifier: Apache-2.0
// Real files, both APIs, every environment: the same bits.
#include "tests/filament_core/engine/RenderFixture.h"

#include <array>
#include <fstream>

namespace filament_core {
namespace {

constexpr std::array kModels{ "FlightHelmet/FlightHelmet.gltf",
                              "SheenChair/SheenChair.gltf",
                              "NormalTangentTest/NormalTangentTest.glb",
                              "AlphaBlendModeTest/AlphaBlendModeTest.glb",
                              "TextureSettingsTest/TextureSettingsTest.gltf",
                              "TextureCoordinateTest/TextureCoordinateTest.glb",
                              "TextureLinearInterpolationTest/TextureLinearInterpolationTest.glb",
                              "VertexColorTest/VertexColorTest.glb",
                              "OrientationTest/OrientationTest.glb",
                              "MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb",
                              "UnlitTest/UnlitTest.glb",
                              "EmissiveStrengthTest/EmissiveStrengthTest.glb",
                              "TextureTransformTest/TextureTransformTest.gltf",
                              "BoxInterleaved/BoxInterleaved.gltf",
                              "AnimatedMorphCube-Quantized/AnimatedMorphCube.gltf",
                              "SimpleInstancing/SimpleInstancing.glb",
                              "Box-Draco/Box.gltf",
                              "BoxMeshopt/BoxMeshopt.glb",
                              "LightsPunctualLamp/LightsPunctualLamp.gltf",
                              "LittlestTokyo/LittlestTokyo.glb",
                              "ClearCoatTest/ClearCoatTest.glb",
                              "SpecularTest/SpecularTest.glb",
                              "AnisotropyStrengthTest/AnisotropyStrengthTest.glb",
                              "AnisotropyRotationTest/AnisotropyRotationTest.glb",
                              "SpecularGlossiness13/Material_SpecularGlossiness_13.gltf",
                              "TransmissionTest/TransmissionTest.glb",
                              "AttenuationTest/AttenuationTest.glb",
                              "DispersionTest/DispersionTest.glb" };
constexpr std::array kEnvironments{ "studio_small_03_1k.hdr", "st_fagans_interior_1k.hdr",
                                    "spiaggia_di_mondello_1k.hdr" };

/// One engine with all environments, kept for all models: these tests do not measure loading.
struct LitEngine {
    Engine engine;
    std::vector<Environment> environments;

    static std::unique_ptr<LitEngine> make(Backend backend) {
        auto engine = test::makeEngine(backend);
        if (!engine) return nullptr;
        auto stage = std::unique_ptr<LitEngine>(new LitEngine{ std::move(*engine), {} });
        for (const char* name : kEnvironments) {
            auto environment = loadEnvironment(stage->engine, tools::assetDir() / "environments" / name);
            if (!environment) {
                ADD_FAILURE() << environment.error().message;
                return nullptr;
            }
            stage->environments.push_back(std::move(*environment));
        }
        return stage;
    }
};

class AssetImagesTest : public test::AssetTest, public testing::WithParamInterface<const char*> {
protected:
    static void SetUpTestSuite() {
        if (tools::assetDir().empty()) return;
        sVulkan = LitEngine::make(Backend::Vulkan);
        sGles = LitEngine::make(Backend::Gles);
    }
    static void TearDownTestSuite() {
        sVulkan.reset();
        sGles.reset();
    }

    static Result<std::vector<Image>> render(LitEngine& stage, std::string const& file) {
        auto model = loadGltf(stage.engine, tools::assetDir() / "models" / file);
        if (!model) return model.error();
        Scene scene(stage.engine);
        scene.add(*model, fitToUnitCube(model->bounds()));
        View view{ .camera = Camera::lookAt({ 0.9, 0.6, 1.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 }),
                   .size = { 320, 240 } };
        std::vector<Image> images;
        Renderer renderer(stage.engine);
        for (Environment const& environment : stage.environments) {
            scene.setEnvironment(environment);
            auto image = renderer.renderToImage(scene, view);
            if (!image) return image.error();
            images.push_back(std::move(*image));
        }
        return images;
    }

    inline static std::unique_ptr<LitEngine> sVulkan, sGles;
};

bool isFlat(Image const& image) {
    for (size_t i = 4; i < image.pixels.size(); i += 4) {
        if (std::memcmp(&image.pixels[i], &image.pixels[0], 4) != 0) return false;
    }
    return true;
}

TEST_P(AssetImagesTest, HasTheSameBitsOnBothApis) {
    ASSERT_TRUE(sVulkan && sGles);
    auto vulkan = render(*sVulkan, GetParam());
    auto gles = render(*sGles, GetParam());
    ASSERT_TRUE(vulkan.ok()) << vulkan.error().message;
    ASSERT_TRUE(gles.ok()) << gles.error().message;
    for (size_t i = 0; i < kEnvironments.size(); ++i) {
        EXPECT_EQ(test::differenceOf((*vulkan)[i], (*gles)[i]).pixels, 0u) << kEnvironments[i];
        EXPECT_FALSE(isFlat((*vulkan)[i])) << kEnvironments[i];
    }
    test::expectNoErrors(sVulkan->engine);
    test::expectNoErrors(sGles->engine);
}

INSTANTIATE_TEST_SUITE_P(Models, AssetImagesTest, testing::ValuesIn(kModels), [](auto const& test) {
    std::string name = std::filesystem::path(test.param).parent_path().string();
    std::erase(name, '-');
    return name;
});

} // namespace
} // namespace filament_core
