// SPDX-License-Identifier: Apache-2.0
// Streamed textures on both APIs: the images of whole ones, in less memory, and the same bits in each frame.
#include "backend/layers/Faulty.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/filament_core/engine/gltf/QuadFile.h"
#include "toolkit/showcase/SceneBuilder.h"

#include <filament_core/TextureStreaming.h>

#include <array>
#include <random>

namespace filament_core {
namespace {

using assets::MaterialData;

constexpr uint32_t kTexelsOfSide = 1024;
constexpr uint64_t kWholeBytes = 5592404; ///< 4 * (1024^2 + 512^2 + ... + 1)
constexpr uint64_t kCoarseBytes = 21844;  ///< 4 * (64^2 + 32^2 + ... + 1)

/// Smooth blotches, which differ from level to level, and noise.
assets::GlbImage noise(uint32_t seed, uint32_t size) {
    std::mt19937 random(seed);
    std::vector<std::byte> texels(size_t{ size } * size * 4, std::byte{ 255 });
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            for (size_t c = 0; c < 3; ++c) {
                const uint32_t stripes = ((x >> (4 + c)) ^ (y >> 5)) & 1 ? 160 : 40;
                texels[(size_t{ y } * size + x) * 4 + c] = static_cast<std::byte>(stripes + random() % 80);
            }
        }
    }
    Result<assets::GlbImage> image = assets::glbImageFromPixels("noise", size, size, texels);
    EXPECT_TRUE(image);
    return std::move(*image);
}

/// A quad of 2 m that shows two textures once.
std::vector<std::byte> const& modelOfNoise() {
    static const std::vector<std::byte> file = [] {
        MaterialData material{ .name = "noise" };
        material.baseColor = showcase::textured(0);
        material.metallicRoughness = showcase::textured(1);
        return test::quadFile({ noise(1, kTexelsOfSide), noise(2, kTexelsOfSide) }, material,
                              { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 1, 0 } });
    }();
    return file;
}

/// An engine that shows one model.
struct StreamingStage {
    explicit StreamingStage(Backend backend, uint32_t budget, int workers = 1)
            : engine(test::makeEngine(backend, workers)), scene(*engine), renderer(*engine) {
        view.size = { 192, 128 };
        view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 };
        scene.add(SunLight{ .directionWorld = { -0.2f, -0.4f, -1.0f }, .illuminance = Lux{ 3 } });
        options.textureBudgetMegabytes = budget;
    }

    void show(Result<Model> loaded) {
        ASSERT_TRUE(loaded) << loaded.error().message;
        model = std::make_unique<Model>(std::move(*loaded));
        root = scene.add(*model);
    }
    void showNoise() { show(loadGltf(*engine, GltfMemory{ .file = modelOfNoise(), .name = "noise" }, options)); }
    /// Towards the quad from so many metres.
    void lookFrom(double meters) {
        view.camera.worldFromView = Camera::lookAt({ 0.1, 0.15, meters }, { 0, 0, 0 }).worldFromView;
    }
    Image draw() { return test::renderLinear(*engine, renderer, scene, view); }
    Image settled() {
        Image image;
        do {
            image = draw();
        } while (waitForTextures(*engine));
        return image;
    }

    std::optional<Engine> engine;
    Scene scene;
    Renderer renderer;
    View view;
    GltfLoadOptions options;
    std::unique_ptr<Model> model, behind;
    Node root;
};

/// Channels that differ, and by which share of the larger one at most.
struct Difference {
    size_t count = 0;
    float largestShare = 0;
};
Difference differenceOf(Image const& a, Image const& b) {
    Difference difference;
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    for (uint32_t y = 0; y < a.height; ++y) {
        for (uint32_t x = 0; x < a.width; ++x) {
            const float4 one = test::halfPixel(a, x, y), other = test::halfPixel(b, x, y);
            for (int c = 0; c < 4; ++c) {
                if (one[c] == other[c]) continue;
                ++difference.count;
                const float share = std::abs(one[c] - other[c]) / std::max(std::abs(one[c]), std::abs(other[c]));
                difference.largestShare = std::max(difference.largestShare, share);
            }
        }
    }
    return difference;
}

/// The weights of two levels are rounded differently where a texture begins with another level: at most one half float
/// of 5000 is another one, its neighbour.
void expectAlmostEqual(Image const& whole, Image const& streamed) {
    const Difference apart = differenceOf(whole, streamed);
    EXPECT_LE(apart.count, whole.pixels.size() / 2 / 5000) << "half floats that differ";
    EXPECT_LE(apart.largestShare, 1.0f / 1024) << "of a half float: one step";
}

TEST(TextureStreaming, SettlesOnTheImageOfWholeTextures) {
    for (const Backend backend : test::kBothApis) {
        StreamingStage whole(backend, 0), streamed(backend, 64);
        whole.showNoise();
        streamed.showNoise();
        for (const double meters : { 20.0, 6.0, 3.0, 1.2, 9.0 }) {
            SCOPED_TRACE(testing::Message() << toString(backend) << ", " << meters << " m");
            whole.lookFrom(meters);
            streamed.lookFrom(meters);
            expectAlmostEqual(whole.draw(), streamed.settled());
            EXPECT_EQ(textureResidency(*streamed.engine).largestErrorPixels, 0);
        }
        test::expectNoErrors(*streamed.engine);
    }
}

TEST(TextureStreaming, HasAllBitsOfWholeTexturesWhereNoLevelsAreMixed) {
    for (const Backend backend : test::kBothApis) {
        StreamingStage whole(backend, 0), streamed(backend, 64);
        for (StreamingStage* const stage : { &whole, &streamed }) {
            stage->view.quality.textureFilter = TextureFilter::Bilinear;
            stage->showNoise();
        }
        for (const double meters : { 20.0, 6.0, 3.0 }) {
            whole.lookFrom(meters);
            streamed.lookFrom(meters);
            EXPECT_EQ(whole.draw().pixels, streamed.settled().pixels) << toString(backend) << ", " << meters << " m";
        }
    }
}

TEST(TextureStreaming, SettlesOnTheImagesOfModels) {
    const std::filesystem::path models = tools::assetDir() / "models";
    for (const char* const file :
         { "FlightHelmet/FlightHelmet.gltf", "SheenChair/SheenChair.gltf",
           "TextureTransformTest/TextureTransformTest.gltf", "AlphaBlendModeTest/AlphaBlendModeTest.glb" }) {
        if (tools::assetDir().empty() || !std::filesystem::exists(models / file)) {
            std::printf("skipped: %s is not below FILAMENT_ASSET_DIR\n", file);
            continue;
        }
        std::array<std::vector<Image>, 2> images;
        for (size_t api = 0; api < 2; ++api) {
            StreamingStage whole(test::kBothApis[api], 0), streamed(test::kBothApis[api], 512);
            whole.show(loadGltf(*whole.engine, models / file, whole.options));
            streamed.show(loadGltf(*streamed.engine, models / file, streamed.options));
            if (!whole.model || !streamed.model) continue;
            const Box box = whole.model->bounds();
            const double radius = glm::length(box.max - box.min) / 2;
            for (const double distance : { 12.0, 1.6 }) {
                SCOPED_TRACE(testing::Message()
                             << file << ", " << distance << " radii, " << toString(test::kBothApis[api]));
                const double3 middle = (box.min + box.max) / 2.0;
                const Camera camera = Camera::lookAt(middle + double3(0.3, 0.2, 1) * (distance * radius), middle);
                whole.view.camera.worldFromView = streamed.view.camera.worldFromView = camera.worldFromView;
                images[api].push_back(streamed.settled());
                expectAlmostEqual(whole.draw(), images[api].back());
                const TextureResidency now = textureResidency(*streamed.engine);
                EXPECT_EQ(now.largestErrorPixels, 0);
                EXPECT_LT(now.residentBytes, now.wholeBytes);
            }
            test::expectNoErrors(*streamed.engine);
        }
        ASSERT_EQ(images[0].size(), images[1].size());
        for (size_t i = 0; i < images[0].size(); ++i) EXPECT_EQ(images[0][i].pixels, images[1][i].pixels) << file;
    }
}

/// From the middle of its box a model needs the largest levels: nothing is rounded differently.
TEST(TextureStreaming, HasAllBitsOfWholeTexturesWhereTheLargestLevelsAreThere) {
    const std::filesystem::path file = tools::assetDir() / "models/SheenChair/SheenChair.gltf";
    if (tools::assetDir().empty() || !std::filesystem::exists(file)) GTEST_SKIP() << "needs FILAMENT_ASSET_DIR";
    StreamingStage whole(Backend::Vulkan, 0), streamed(Backend::Vulkan, 512);
    for (StreamingStage* const stage : { &whole, &streamed }) {
        stage->options.normalMapRoughness = true; // levels that are derived from the largest one
        stage->show(loadGltf(*stage->engine, file, stage->options));
        ASSERT_TRUE(stage->model);
        const Box box = stage->model->bounds();
        const double3 middle = (box.min + box.max) / 2.0;
        stage->view.camera.worldFromView = Camera::lookAt(middle, middle + double3(0.2, -1, 0.4)).worldFromView;
    }
    EXPECT_EQ(whole.draw().pixels, streamed.settled().pixels);
    const TextureResidency now = textureResidency(*streamed.engine);
    EXPECT_GT(now.textures, 4u);
    EXPECT_GT(now.residentBytes, now.wholeBytes / 2);
}

/// The mask is in the alpha of the texture: shadow maps sample it, and are drawn again when it arrives.
TEST(TextureStreaming, CutsOutShadowsAsWholeTexturesDo) {
    std::vector<std::byte> texels(size_t{ 512 } * 512 * 4, std::byte{ 200 });
    for (size_t i = 0; i < texels.size() / 4; ++i)
        texels[i * 4 + 3] = static_cast<std::byte>(((i % 512 / 6 ^ i / 512 / 6) & 1) * 255); // squares of 6 texels
    Result<assets::GlbImage> mask = assets::glbImageFromPixels("mask", 512, 512, texels);
    ASSERT_TRUE(mask);
    MaterialData material{ .name = "mask" };
    material.baseColor = showcase::textured(0);
    material.alphaMode = assets::AlphaMode::Mask;
    const std::vector<std::byte> file =
            test::quadFile({ std::move(*mask) }, material, { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 1, 0 } });
    const std::vector<std::byte> ground =
            test::quadFile({}, MaterialData{ .name = "ground" }, { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 1, 0 } });
    for (const Backend backend : test::kBothApis) {
        StreamingStage whole(backend, 0), streamed(backend, 64);
        for (StreamingStage* const stage : { &whole, &streamed }) {
            stage->show(loadGltf(*stage->engine, GltfMemory{ .file = file, .name = "mask" }, stage->options));
            Result<Model> behind = loadGltf(*stage->engine, GltfMemory{ .file = ground, .name = "ground" });
            ASSERT_TRUE(behind);
            stage->behind = std::make_unique<Model>(std::move(*behind));
            double4x4 back(1.0);
            back[3] = double4(0, 0, -0.5, 1);
            stage->scene.setTransform(stage->scene.add(*stage->behind), back);
            stage->view.quality.shadows = ShadowFilter::Pcf3;
            stage->lookFrom(1.5);
        }
        const Image first = streamed.draw(); // with the coarsest levels
        expectAlmostEqual(whole.draw(), streamed.settled());
        EXPECT_GT(differenceOf(first, whole.draw()).count, 100u);
    }
}

TEST(TextureStreaming, SurvivesTheLossOfItsDevice) {
    const auto faults = std::make_shared<backend::FaultInjector>();
    Result<Engine> engine = Engine::create({ .workers = 1, .debug = { .faults = faults } });
    ASSERT_TRUE(engine) << engine.error().message;
    Result<Model> model =
            loadGltf(*engine, GltfMemory{ .file = modelOfNoise(), .name = "noise" }, { .textureBudgetMegabytes = 64 });
    ASSERT_TRUE(model);
    Scene scene(*engine);
    Renderer renderer(*engine);
    scene.add(*model);
    View view{ .size = { 64, 64 } };
    view.camera = Camera::lookAt({ 0, 0, 0.3 }, { 0, 0, 0 });
    const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = view.size }));
    renderer.render(scene, view, target);
    engine->waitIdle();
    faults->arm({ .loseDeviceAt = 3 });
    for (int i = 0; i < 4; ++i) {
        waitForTextures(*engine);
        renderer.render(scene, view, target);
    }
    engine->waitIdle();
    EXPECT_TRUE(faults->hasStruck());
    EXPECT_FALSE(engine->takeErrors().empty());
    EXPECT_EQ(textureResidency(*engine).textures, 2u);
}

TEST(TextureStreaming, HasOnTheDeviceWhatAViewNeeds) {
    StreamingStage stage(Backend::Vulkan, 64);
    stage.showNoise();
    stage.lookFrom(60);
    stage.settled();
    TextureResidency now = textureResidency(*stage.engine);
    EXPECT_EQ(now.textures, 2u);
    EXPECT_EQ(now.wholeBytes, 2 * kWholeBytes);
    EXPECT_EQ(now.residentBytes, 2 * kCoarseBytes) << "the quad covers a few pixels";
    stage.lookFrom(0.3);
    stage.settled();
    now = textureResidency(*stage.engine);
    EXPECT_EQ(now.residentBytes, 2 * kWholeBytes);
    EXPECT_TRUE(now.isSettled);
}

TEST(TextureStreaming, DrawsTheSameBitsOnBothApisInEachFrame) {
    const auto frames = [](Backend backend, int workers) {
        StreamingStage stage(backend, 8, workers);
        stage.showNoise();
        setTextureStreaming(*stage.engine, { .budgetMegabytes = 8, .uploadMegabytes = 1 });
        std::vector<std::vector<std::byte>> all;
        for (const double meters : { 40.0, 2.0, 1.0, 0.5, 0.4, 12.0, 30.0, 1.0 }) {
            stage.lookFrom(meters);
            all.push_back(stage.draw().pixels);
            waitForTextures(*stage.engine);
        }
        test::expectNoErrors(*stage.engine);
        return all;
    };
    const auto vulkan = frames(Backend::Vulkan, 1);
    EXPECT_EQ(vulkan, frames(Backend::Gles, 1));
    EXPECT_EQ(vulkan, frames(Backend::Vulkan, 3));
    EXPECT_EQ(vulkan, frames(Backend::Vulkan, 0));
}

TEST(TextureStreaming, StaysInItsBudgetAndSaysWhatIsMissing) {
    StreamingStage stage(Backend::Vulkan, 3);
    stage.showNoise();
    setTextureStreaming(*stage.engine, { .budgetMegabytes = 3 });
    stage.lookFrom(0.3);
    stage.settled();
    const TextureResidency now = textureResidency(*stage.engine);
    EXPECT_LE(now.residentBytes, 3u << 20);
    EXPECT_GT(now.residentBytes, 1u << 20);
    EXPECT_GT(now.largestErrorPixels, 1);
    EXPECT_EQ(now.largestError.substr(0, 5), "noise");
    EXPECT_NE(stage.renderer.explain().find("pixels a texel: noise"), std::string::npos);
    test::expectNoErrors(*stage.engine);
}

TEST(TextureStreaming, MakesRoomWhenTheBudgetShrinks) {
    for (const Backend backend : test::kBothApis) {
        StreamingStage stage(backend, 8), other(backend, 8);
        for (StreamingStage* const each : { &stage, &other }) {
            each->showNoise();
            setTextureStreaming(*each->engine, { .budgetMegabytes = 8 });
        }
        stage.lookFrom(0.3);
        stage.settled();
        EXPECT_GT(textureResidency(*stage.engine).residentBytes, 6u << 20) << "one whole texture and half of the other";
        setTextureStreaming(*stage.engine, { .budgetMegabytes = 1 });
        stage.settled();
        EXPECT_LE(textureResidency(*stage.engine).residentBytes, 1u << 20);
        setTextureStreaming(*stage.engine, { .budgetMegabytes = 8 });
        stage.settled();
        setTextureStreaming(*stage.engine, { .budgetMegabytes = 1 });
        stage.lookFrom(60);
        for (uint32_t i = 0; i < 10; ++i) stage.settled(); // a need is held for eight frames
        EXPECT_LE(textureResidency(*stage.engine).residentBytes, 1u << 20);
        other.lookFrom(60);
        expectAlmostEqual(other.settled(), stage.draw());
        test::expectNoErrors(*stage.engine);
    }
}

TEST(TextureStreaming, EndsWithItsModelWhileTexturesAreOnTheirWay) {
    for (const Backend backend : test::kBothApis) {
        StreamingStage stage(backend, 64);
        for (int i = 0; i < 3; ++i) {
            stage.showNoise();
            stage.lookFrom(0.3);
            stage.draw();
            stage.draw(); // requests what the first one needed
            EXPECT_GT(textureResidency(*stage.engine).loading, 0u);
            stage.scene.remove(stage.root);
            stage.model.reset();
            EXPECT_EQ(textureResidency(*stage.engine).textures, 0u);
            stage.draw();
        }
        EXPECT_FALSE(waitForTextures(*stage.engine));
        test::expectNoErrors(*stage.engine);
    }
}

TEST(TextureStreaming, FollowsCopiesWithMaterialsOfTheirOwn) {
    StreamingStage stage(Backend::Vulkan, 64);
    stage.showNoise();
    Result<ModelCopy> copy = ModelCopy::of(stage.scene, stage.root);
    ASSERT_TRUE(copy);
    ASSERT_TRUE(copy->set("noise", "baseColorFactor", ParameterValue(float4(0.5f, 1, 1, 1))));
    stage.lookFrom(0.3);
    stage.settled();
    EXPECT_EQ(textureResidency(*stage.engine).residentBytes, 2 * kWholeBytes);
    test::expectNoErrors(*stage.engine);
}

TEST(TextureStreaming, LeavesOddSizesAndNearestFiltersWhole) {
    MaterialData material{ .name = "whole" };
    material.baseColor = showcase::textured(0);
    material.metallicRoughness = showcase::textured(1);
    material.metallicRoughness.sampler.magFilter = Filter::Nearest;
    material.emissive = showcase::textured(2);
    material.emissive.sampler.mipFilter = MipFilter::None;
    const std::vector<std::byte> file = test::quadFile({ noise(1, 255), noise(2, 256), noise(3, 256) }, material,
                                                       { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 1, 0 } });
    StreamingStage stage(Backend::Vulkan, 64);
    stage.show(loadGltf(*stage.engine, GltfMemory{ .file = file, .name = "whole" }, stage.options));
    stage.lookFrom(2);
    stage.draw();
    EXPECT_EQ(textureResidency(*stage.engine).textures, 0u);
}

} // namespace
} // namespace filament_core
