// SPDX-License-Identifier: Apache-2.0
// Skins and morph targets on both devices: against rigid transforms and moved meshes, whose pictures are known.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/scenes/Sphere.h"

#include "shaders/package/EngineMaterials.h"

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace filament {
namespace {

/// A sphere whose vertices hang on two bones, by halves, and on two more with a quarter each.
struct Vertex {
    scenes::SphereVertex base;
    std::array<uint8_t, 4> joints{ 0, 1, 2, 3 }, joints1{ 3, 2, 1, 0 };
    float4 weights{ 0.5f, 0.25f, 0.125f, 0.125f }, weights1{ 0.0f };
};

enum class Joints : uint8_t { None, Four, Eight };

class Stage {
public:
    explicit Stage(Engine& engine) : mEngine(engine), scene(engine) {
        mMaterial = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_opaque") }));
        instance = engine.own(engine.createInstance(mMaterial));
        EXPECT_TRUE(engine.set(instance, "baseColorFactor", float4(0.8f, 0.3f, 0.1f, 1)).ok());
        EXPECT_TRUE(engine.set(instance, "roughnessFactor", 0.4f).ok());
        scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f }, .illuminance = Lux{ 60'000 } });
        view = { .camera = Camera::lookAt({ 0, 0, 5 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 }), .size = { 96, 72 } };
    }

    /// `place` moves the vertices before they are uploaded.
    RenderableDesc sphere(Joints joints, std::function<float3(float3)> const& place = {}) {
        const scenes::SphereMesh mesh = scenes::makeSphere(12, 24);
        std::vector<Vertex> vertices;
        for (scenes::SphereVertex const& vertex : mesh.vertices) {
            vertices.push_back({ vertex });
            if (place) vertices.back().base.position = place(vertex.position);
            if (joints != Joints::Eight) continue;
            vertices.back().weights *= 0.5f;
            vertices.back().weights1 = float4(0.125f);
        }
        std::vector<AttributeDesc> attributes{
            { Attribute::Position, VertexFormat::Float3, offsetof(Vertex, base.position) },
            { Attribute::Tangents, VertexFormat::Float4, offsetof(Vertex, base.tangents) }
        };
        if (joints != Joints::None) {
            attributes.push_back({ Attribute::Joints, VertexFormat::UByte4, offsetof(Vertex, joints) });
            attributes.push_back({ Attribute::Weights, VertexFormat::Float4, offsetof(Vertex, weights) });
        }
        if (joints == Joints::Eight) {
            attributes.push_back({ Attribute::Joints1, VertexFormat::UByte4, offsetof(Vertex, joints1) });
            attributes.push_back({ Attribute::Weights1, VertexFormat::Float4, offsetof(Vertex, weights1) });
        }
        mVertices.push_back(
                mEngine.own(mEngine.create(VertexBufferDesc{ .vertexCount = static_cast<uint32_t>(vertices.size()),
                                                             .stride = sizeof(Vertex),
                                                             .attributes = attributes,
                                                             .data = std::as_bytes(std::span(vertices)) })));
        mIndices.push_back(
                mEngine.own(mEngine.create(IndexBufferDesc{ .indexCount = static_cast<uint32_t>(mesh.indices.size()),
                                                            .data = std::as_bytes(std::span(mesh.indices)) })));
        return { .vertices = mVertices.back(),
                 .indices = mIndices.back(),
                 .material = instance,
                 .boundsMin = float3(-1),
                 .boundsMax = float3(1) };
    }

    Image draw() {
        Renderer renderer(mEngine);
        auto image = renderer.renderToImage(scene, view);
        EXPECT_TRUE(image.ok()) << image.error().message;
        return image ? std::move(*image) : Image{};
    }

    Engine& engine() { return mEngine; }

private:
    Engine& mEngine;
    Owned<Material> mMaterial;
    std::vector<Owned<VertexBuffer>> mVertices;
    std::vector<Owned<IndexBuffer>> mIndices;

public:
    Owned<MaterialInstance> instance;
    Scene scene;
    View view;
};

struct Difference {
    size_t pixels = 0;
    int largest = 0;
};

Difference differenceOf(Image const& a, Image const& b) {
    Difference difference;
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    for (size_t i = 0; i + 3 < std::min(a.pixels.size(), b.pixels.size()); i += 4) {
        int largest = 0;
        for (size_t c = 0; c < 4; ++c)
            largest =
                    std::max(largest, std::abs(static_cast<int>(a.pixels[i + c]) - static_cast<int>(b.pixels[i + c])));
        difference.pixels += largest > 0;
        difference.largest = std::max(difference.largest, largest);
    }
    return difference;
}

using Build = std::function<void(Stage&)>;

/// The picture, which both devices draw alike, without a message.
Image drawOnBoth(Build const& build) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        if (!engine) return {};
        {
            Stage stage(*engine);
            build(stage);
            images.push_back(stage.draw());
        }
        test::expectNoErrors(*engine);
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels) << "Vulkan and OpenGL ES";
    return images[0];
}

/// Some edge pixels may fall on the other side: positions are rounded along another way.
void expectNearlyEqual(Image const& a, Image const& b, const char* what) {
    const Difference difference = differenceOf(a, b);
    EXPECT_LE(difference.pixels, a.pixels.size() / 4 / 50) << what << ", largest " << difference.largest;
}

Image rigid(double4x4 const& world) {
    return drawOnBoth([&](Stage& stage) {
        RenderableDesc desc = stage.sphere(Joints::None);
        desc.worldFromObject = world;
        stage.scene.add(desc);
    });
}

Image skinned(Joints joints, std::vector<float4x4> const& bones) {
    return drawOnBoth([&](Stage& stage) {
        RenderableDesc desc = stage.sphere(joints);
        desc.skin = stage.scene.add(SkinDesc{ .boneCount = static_cast<uint32_t>(bones.size()) });
        stage.scene.add(desc);
        stage.scene.setBones(desc.skin, bones);
    });
}

// Where all bones agree, the mesh moves like a rigid one: positions, normals, faces.
TEST(Deformation, BonesThatAgreeAreATransform) {
    const double4x4 turned =
            glm::rotate(glm::translate(double4x4(1.0), double3(0.4, -0.2, 0)), 0.8, double3(0.3, 1, 0));
    const std::array transforms{ double4x4(1.0), turned, glm::scale(turned, double3(1.4, 0.5, 0.9)),
                                 glm::scale(turned, double3(-1, 1, 1)) };
    for (size_t i = 0; i < transforms.size(); ++i) {
        const Image expected = rigid(transforms[i]);
        const std::vector<float4x4> bones(4, float4x4(transforms[i]));
        expectNearlyEqual(skinned(Joints::Four, bones), expected,
                          ("four joints, transform " + std::to_string(i)).c_str());
        expectNearlyEqual(skinned(Joints::Eight, bones), expected,
                          ("eight joints, transform " + std::to_string(i)).c_str());
    }
    EXPECT_GT(differenceOf(rigid(transforms[0]), rigid(transforms[1])).pixels, 500u) << "the test sees transforms";
}

// Weights are a mean of transforms: bones 0, 1, 2, 3 count 1/2, 1/4, 1/8, 1/8; of eight, half of it and 1/8 each.
TEST(Deformation, WeightsAreAMeanOfTheBones) {
    std::vector<float4x4> bones;
    for (const float x : { 0.8f, -0.4f, 0.4f, 1.2f })
        bones.push_back(float4x4(glm::translate(double4x4(1.0), double3(double(x), 0, 0))));
    const auto at = [](double x) { return rigid(glm::translate(double4x4(1.0), double3(x, 0, 0))); };
    expectNearlyEqual(skinned(Joints::Four, bones), at(0.8 / 2 - 0.4 / 4 + 0.4 / 8 + 1.2 / 8), "four");
    expectNearlyEqual(skinned(Joints::Eight, bones), at(0.5 * 0.5 + (0.8 - 0.4 + 0.4 + 1.2) / 8), "eight");
}

TEST(Deformation, BonesThatCollapseLeaveFinitePictures) {
    const float infinite = std::numeric_limits<float>::infinity();
    float4x4 flat(1.0f), broken(infinite);
    flat[2] = float4(0);
    for (float4x4 const& bone : { flat, float4x4(0.0f), float4x4(1e-30f), broken }) {
        for (const Backend backend : test::kBothApis) {
            auto engine = test::makeEngine(backend);
            ASSERT_TRUE(engine);
            {
                Stage stage(*engine);
                RenderableDesc desc = stage.sphere(Joints::Four);
                desc.skin = stage.scene.add(SkinDesc{ .boneCount = 4 });
                stage.scene.add(desc);
                stage.scene.setBones(desc.skin, std::vector<float4x4>{ bone, bone, float4x4(1.0f), bone });
                const Image image = test::renderLinear(*engine, stage.scene, stage.view);
                for (uint32_t y = 0; y < image.height; ++y) {
                    for (uint32_t x = 0; x < image.width; ++x) {
                        const float4 pixel = test::halfPixel(image, x, y);
                        ASSERT_EQ(pixel - pixel, float4(0)) << toString(backend) << x << ' ' << y;
                    }
                }
            }
            test::expectNoErrors(*engine);
        }
    }
}

// A target of each kind, at weights that overshoot, is the mesh that was moved before it was uploaded.
TEST(Deformation, MorphTargetsMoveVerticesByTheirWeights) {
    const auto shift = [](float3 p) { return float3(0.5f * p.y, 0.3f, 0.2f * p.x); };
    const auto build = [&](Stage& stage, float weight, Joints joints) {
        RenderableDesc desc = stage.sphere(joints);
        std::vector<float3> deltas, other;
        for (scenes::SphereVertex const& vertex : scenes::makeSphere(12, 24).vertices) {
            deltas.push_back(shift(vertex.position));
            other.emplace_back(9, 9, 9);
        }
        MorphTargetsDesc targets{ .vertexCount = static_cast<uint32_t>(deltas.size()) };
        targets.targets = { { .positions = other }, { .positions = deltas }, { .normals = other } };
        stage.engine().waitIdle();
        const MorphTargets morph = stage.engine().create(targets);
        desc.morphTargets = morph;
        desc.morphWeights = { 0, weight };
        if (joints != Joints::None) {
            desc.skin = stage.scene.add(SkinDesc{ .boneCount = 4 });
        }
        const Renderable renderable = stage.scene.add(desc);
        stage.scene.setMorphWeights(renderable, std::array{ 0.0f, weight });
        return morph;
    };
    for (const float weight : { 0.0f, 0.6f, -1.5f }) {
        const Image expected = drawOnBoth([&](Stage& stage) {
            stage.scene.add(stage.sphere(Joints::None, [&](float3 p) { return p + weight * shift(p); }));
        });
        for (const Joints joints : { Joints::None, Joints::Four }) {
            std::vector<Image> images;
            for (const Backend backend : test::kBothApis) {
                auto engine = test::makeEngine(backend);
                ASSERT_TRUE(engine);
                Owned<MorphTargets> targets;
                {
                    Stage stage(*engine);
                    targets = engine->own(build(stage, weight, joints));
                    images.push_back(stage.draw());
                }
                targets.reset();
                test::expectNoErrors(*engine);
            }
            EXPECT_EQ(images[0].pixels, images[1].pixels);
            expectNearlyEqual(images[0], expected,
                              joints == Joints::None ? "morphed" : "morphed, then skinned at rest");
        }
    }
}

TEST(Deformation, ManySkinsInOneFrameDoNotMixUpTheirBones) {
    const auto build = [](Stage& stage, bool isSkinned) {
        for (int i = 0; i < 24; ++i) {
            const double4x4 world = glm::scale(
                    glm::translate(double4x4(1.0), double3(i % 6 * 0.6 - 1.5, i / 6 * 0.6 - 0.9, 0)), double3(0.25));
            RenderableDesc desc = stage.sphere(isSkinned ? Joints::Four : Joints::None);
            if (isSkinned)
                desc.skin = stage.scene.add(SkinDesc{ .boneCount = 4 });
            else
                desc.worldFromObject = world;
            stage.scene.add(desc);
            if (isSkinned) stage.scene.setBones(desc.skin, std::vector<float4x4>(4, float4x4(world)));
        }
    };
    const Image expected = drawOnBoth([&](Stage& stage) { build(stage, false); });
    const Image actual = drawOnBoth([&](Stage& stage) { build(stage, true); });
    expectNearlyEqual(actual, expected, "24 skins");
}

TEST(Deformation, ScenesThatDeformNothingBindNothingOfIt) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
    ASSERT_TRUE(engine.ok());
    const auto commandsOf = [&](bool withUnusedSkin) {
        Stage stage(*engine);
        stage.scene.add(stage.sphere(Joints::None));
        if (withUnusedSkin) stage.scene.add(SkinDesc{ .boneCount = 4 });
        Renderer renderer(*engine);
        const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = stage.view.size }));
        for (int i = 0; i < 4; ++i) renderer.render(stage.scene, stage.view, target);
        engine->waitIdle();
        const uint64_t before = engine->statistics().commands;
        renderer.render(stage.scene, stage.view, target);
        engine->waitIdle();
        return engine->statistics().commands - before;
    };
    EXPECT_EQ(commandsOf(false), commandsOf(true));
}

// ---------------------------------------------------------------------------------------------- files

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

class AnimatedModel : public testing::TestWithParam<Played> {
protected:
    void SetUp() override {
        if (tools::assetDir().empty())
            GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set: the models are not beside the checkout";
    }

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
        EXPECT_EQ(differenceOf(vulkan[i], gles[i]).pixels, 0u) << "picture " << i;
    for (size_t i = 2; i + 1 < vulkan.size(); ++i)
        EXPECT_GT(differenceOf(vulkan[i], vulkan[i - 1]).pixels, 20u) << "the model moves";
    EXPECT_EQ(differenceOf(vulkan.front(), vulkan.back()).pixels, 0u) << "and comes back to rest";
}

// What the loader computes on the CPU and what the device computes from bones and weights: in fewer than one pixel of a
// hundred a different last bit.
TEST_P(AnimatedModel, RestsWhereTheLoaderWouldPutIt) {
    const std::vector<Image> device = play(Backend::Vulkan, GetParam());
    const std::vector<Image> loader = play(Backend::Vulkan, GetParam(), false);
    ASSERT_FALSE(device.empty());
    ASSERT_FALSE(loader.empty());
    const Difference difference = differenceOf(device[0], loader[0]);
    EXPECT_LE(difference.pixels, 108u);
    EXPECT_LE(difference.largest, 2);
}

// EXT_mesh_gpu_instancing: 125 boxes.
TEST(Instancing, InstancesOfAFileAreOneDraw) {
    if (tools::assetDir().empty())
        GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set: the models are not beside the checkout";
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
    ASSERT_TRUE(engine.ok());
    auto model = loadGltf(*engine, tools::assetDir() / "models/SimpleInstancing/SimpleInstancing.glb");
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

TEST(Animations, NamesThatAModelLacksAreAnsweredWithThoseThatItHas) {
    if (tools::assetDir().empty())
        GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set: the models are not beside the checkout";
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
    ASSERT_TRUE(engine.ok());
    auto model = loadGltf(*engine, tools::assetDir() / "models/Fox/Fox.glb");
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

// Half way between two animations, and both ends.
TEST(Animations, CrossFadesBeginAtTheFirstAndEndAtTheSecond) {
    if (tools::assetDir().empty())
        GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set: the models are not beside the checkout";
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
    ASSERT_TRUE(engine.ok());
    auto model = loadGltf(*engine, tools::assetDir() / "models/Fox/Fox.glb");
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

INSTANTIATE_TEST_SUITE_P(Files, AnimatedModel, testing::ValuesIn(playedModels()), [](auto const& test) {
    std::string name = std::filesystem::path(test.param.file).parent_path().string();
    std::erase(name, '-');
    return name;
});

} // namespace
} // namespace filament
