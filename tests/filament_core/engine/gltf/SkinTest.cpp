// SPDX-License-Identifier: Apache-2.0
// Skins on both devices, compared with rigid transforms, whose images are known.
#include "tests/filament_core/engine/gltf/DeformationStage.h"

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <limits>

namespace filament_core {
namespace {

using test::DeformationStage;
using test::drawOnBoth;
using test::expectNearlyEqual;
using test::Joints;

Image rigid(double4x4 const& world) {
    return drawOnBoth([&](DeformationStage& stage) {
        RenderableDesc desc = stage.sphere(Joints::None);
        desc.worldFromObject = world;
        stage.scene.add(desc);
    });
}

Image skinned(Joints joints, std::vector<float4x4> const& bones) {
    return drawOnBoth([&](DeformationStage& stage) {
        RenderableDesc desc = stage.sphere(joints);
        desc.skin = stage.scene.add(SkinDesc{ .boneCount = static_cast<uint32_t>(bones.size()) });
        stage.scene.add(desc);
        stage.scene.setBones(desc.skin, bones);
    });
}

// If all bones agree, the mesh moves like a rigid one: positions, normals, faces.
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
    EXPECT_GT(test::differenceOf(rigid(transforms[0]), rigid(transforms[1])).pixels, 500u)
            << "the test sees transforms";
}

// Weights average transforms: bones 0, 1, 2, 3 count 1/2, 1/4, 1/8, 1/8; with eight bones, half of that and 1/8 each.
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
                DeformationStage stage(*engine);
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

TEST(Deformation, ManySkinsInOneFrameDoNotMixUpTheirBones) {
    const auto build = [](DeformationStage& stage, bool isSkinned) {
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
    const Image expected = drawOnBoth([&](DeformationStage& stage) { build(stage, false); });
    const Image actual = drawOnBoth([&](DeformationStage& stage) { build(stage, true); });
    expectNearlyEqual(actual, expected, "24 skins");
}

TEST(Deformation, ScenesThatDeformNothingBindNothingOfIt) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
    ASSERT_TRUE(engine.ok());
    const auto commandsOf = [&](bool withUnusedSkin) {
        DeformationStage stage(*engine);
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

} // namespace
} // namespace filament_core
