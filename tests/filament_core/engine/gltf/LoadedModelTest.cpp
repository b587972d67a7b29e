// SPDX-License-Identifier: Apache-2.0
// Models from files: animated ones have the same bits on both devices at all times; instances and animations of a file.
#include "tests/filament_core/engine/RenderFixture.h"

namespace filament_core {
namespace {

struct Played {
    const char* file;
    std::vector<double> seconds;
};

std::vector<Played> playedModels() {
    return { { "Fox/Fox.glb", { 0, 0.4, 2.1 } },
             { "RiggedFigure/RiggedFigure.glb", { 0, 0.5, 1.1 } },
             { "MorphStressTest/MorphStressTest.glb", { 0.3, 1.7, 6.2 } },
             { "AnimatedMorphCube/AnimatedMorphCube.glb", { 0.2, 1.5, 3.0 } },
             { "AnimatedMorphCube-Quantized/AnimatedMorphCube.gltf", { 0.2, 1.5, 3.0 } },
             { "BoxAnimated/BoxAnimated.glb", { 0.2, 1.6, 3.5 } } };
}

class AnimatedModel : public test::AssetTest, public testing::WithParamInterface<Played> {
protected:
    /// At rest, then at each of the times.
    static std::vector<Image> play(Backend backend, Played const& played, bool deformable = true) {
        auto engine = test::makeEngine(backend);
        if (!engine) return {};
        std::vector<Image> images;
        {
            auto model = loadGltf(*engine, tools::assetDir() / "models" / played.file, { .deformable = deformable });
            if (!model) {
                ADD_FAILURE() << model.error().message;
                return {};
            }
            Scene scene(*engine);
            const Node root = scene.add(*model, fitToUnitCube(model->bounds()));
            scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 60'000 } });
            const View view{ .camera = Camera::lookAt({ 0.9, 0.6, 1.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 55 }),
                             .size = { 120, 90 } };
            Renderer renderer(*engine);
            const auto shoot = [&] {
                auto image = renderer.renderToImage(scene, view);
                EXPECT_TRUE(image.ok());
                if (image) images.push_back(std::move(*image));
            };
            shoot();
            if (deformable) {
                Animator animator(*model, scene, root);
                for (const double seconds : played.seconds) {
                    animator.apply(0, seconds);
                    shoot();
                }
                animator.rest();
                shoot();
            }
        }
        test::expectNoErrors(*engine);
        return images;
    }
};

TEST_P(AnimatedModel, HasTheSameBitsOnBothApisAtEveryTime) {
    const std::vector<Image> vulkan = play(Backend::Vulkan, GetParam()), gles = play(Backend::Gles, GetParam());
    ASSERT_EQ(vulkan.size(), GetParam().seconds.size() + 2);
    ASSERT_EQ(gles.size(), vulkan.size());
    for (size_t i = 0; i < vulkan.size(); ++i)
        EXPECT_EQ(test::differenceOf(vulkan[i], gles[i]).pixels, 0u) << "picture " << i;
    for (size_t i = 2; i + 1 < vulkan.size(); ++i)
        EXPECT_GT(test::differenceOf(vulkan[i], vulkan[i - 1]).pixels, 20u) << "the model moves";
    EXPECT_EQ(test::differenceOf(vulkan.front(), vulkan.back()).pixels, 0u) << "and comes back to rest";
}

// Compares deformation on the CPU by the loader with that on the device from bones and weights: the last bit may differ
// in less than one pixel in a hundred.
TEST_P(AnimatedModel, RestsWhereTheLoaderWouldPutIt) {
    const std::vector<Image> device = play(Backend::Vulkan, GetParam());
    const std::vector<Image> loader = play(Backend::Vulkan, GetParam(), false);
    ASSERT_FALSE(device.empty());
    ASSERT_FALSE(loader.empty());
    const test::Difference difference = test::differenceOf(device[0], loader[0]);
    EXPECT_LE(difference.pixels, 108u);
    EXPECT_LE(difference.largest, 2);
}

INSTANTIATE_TEST_SUITE_P(Files, AnimatedModel, testing::ValuesIn(playedModels()), [](auto const& test) {
    std::string name = std::filesystem::path(test.param.file).parent_path().string();
    std::erase(name, '-');
    return name;
});

/// Models whose images are not needed.
class OnNullDevice : public test::AssetTest {
protected:
    Result<Model> load(const char* file) { return loadGltf(*engine, tools::assetDir() / "models" / file); }

    Result<Engine> engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
};
class Instancing : public OnNullDevice {};
class Animations : public OnNullDevice {};

// EXT_mesh_gpu_instancing: 125 boxes.
TEST_F(Instancing, InstancesOfAFileAreOneDraw) {
    ASSERT_TRUE(engine.ok());
    const Result<Model> model = load("SimpleInstancing/SimpleInstancing.glb");
    ASSERT_TRUE(model.ok()) << model.error().message;
    Scene scene(*engine);
    scene.add(*model, fitToUnitCube(model->bounds()));
    Renderer renderer(*engine);
    const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = { 64, 64 } }));
    const View view{ .camera = Camera::lookAt({ 0.9, 0.6, 1.5 }, { 0, 0, 0 }), .size = { 64, 64 } };
    renderer.render(scene, view, target);
    EXPECT_EQ(scene.renderableCount(), 125u);
    EXPECT_EQ(renderer.statistics().visible, 125u);
    EXPECT_EQ(renderer.statistics().draws, 1u);
}

TEST_F(Animations, NamesThatAModelLacksAreAnsweredWithThoseThatItHas) {
    ASSERT_TRUE(engine.ok());
    const Result<Model> model = load("Fox/Fox.glb");
    ASSERT_TRUE(model.ok()) << model.error().message;
    ASSERT_EQ(model->animationCount(), 3u);
    EXPECT_EQ(model->animationName(1), "Walk");
    EXPECT_NEAR(model->animationSeconds(1), 0.7083, 1e-4);
    EXPECT_EQ(model->findAnimation("Run").value(), 2u);
    const Result<uint32_t> unknown = model->findAnimation("Wlk");
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.error().message,
              "Fox.glb has no animation 'Wlk' among 'Survey', 'Walk', 'Run'; did you mean 'Walk'?");
}

// Half-way between two animations, and at both ends.
TEST_F(Animations, CrossFadesBeginAtTheFirstAndEndAtTheSecond) {
    ASSERT_TRUE(engine.ok());
    const Result<Model> model = load("Fox/Fox.glb");
    ASSERT_TRUE(model.ok()) << model.error().message;
    Scene scene(*engine);
    const Node root = scene.add(*model);
    Animator animator(*model, scene, root);
    const Node joint = scene.findNode("b_Neck_04", root);
    ASSERT_TRUE(joint);
    const auto distance = [&](double4x4 const& a, double4x4 const& b) {
        double sum = 0;
        for (int column = 0; column < 4; ++column) sum += glm::length(a[column] - b[column]);
        return sum;
    };
    animator.apply(0, 0.5);
    const double4x4 survey = scene.parentFromNode(joint);
    animator.apply(2, 0.3);
    const double4x4 run = scene.parentFromNode(joint);
    ASSERT_GT(distance(survey, run), 0.01);
    animator.crossFade(0, 0.5, 2, 0.3, 0);
    EXPECT_LT(distance(scene.parentFromNode(joint), survey), 1e-12);
    animator.crossFade(0, 0.5, 2, 0.3, 1);
    EXPECT_LT(distance(scene.parentFromNode(joint), run), 1e-12);
    animator.crossFade(0, 0.5, 2, 0.3, 0.5);
    EXPECT_LT(distance(scene.parentFromNode(joint), survey), distance(survey, run));
    EXPECT_LT(distance(scene.parentFromNode(joint), run), distance(survey, run));
}

} // namespace
} // namespace filament_core
