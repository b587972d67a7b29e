// SPDX-License-Identifier: Apache-2.0
// Copies of one skinned mesh, each in its own pose, drawn as instances: the bits of draws of their own, which copies
// have whose material instances differ only by their handles.
#include "tests/filament_core/engine/gltf/DeformationStage.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace filament_core {
namespace {

using test::DeformationStage;
using test::Joints;

constexpr int kCopies = 20;

/// Of copy `i` in frame `frame`: somewhere in a grid, bent.
std::vector<float4x4> poseOf(int i, int frame = 0) {
    std::vector<float4x4> bones;
    for (int bone = 0; bone < 4; ++bone) {
        double4x4 at = glm::translate(double4x4(1.0), double3(i % 5 * 0.7 - 1.4, i / 5 * 0.7 - 1.0, -0.2 * (i % 3)));
        at = glm::rotate(at, 0.1 * (bone + 1) * i + 0.2 * frame, double3(0.3, 1, 0.2));
        at = glm::translate(at, double3(0.05 * bone * frame, 0, 0));
        bones.emplace_back(glm::scale(at, double3(0.25, bone == 1 ? 0.4 : 0.25, 0.25)));
    }
    return bones;
}

enum class Draws : uint8_t { Together, Alone };

/// Copies with one material instance, or with one each.
class CopiesStage : public DeformationStage {
public:
    CopiesStage(Engine& engine, Draws draws, const char* package = "gltf_lit_opaque")
            : DeformationStage(engine), renderer(engine) {
        mMaterial = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial(package) }));
        RenderableDesc desc = sphere(Joints::Four);
        for (int i = 0; i < kCopies; ++i) {
            if (i == 0 || draws == Draws::Alone) {
                mInstances.push_back(engine.own(engine.createInstance(mMaterial)));
                EXPECT_TRUE(engine.set(mInstances.back(), "baseColorFactor", float4(0.3f, 0.5f, 0.1f, 0.5f)).ok());
            }
            desc.material = mInstances.back();
            desc.skin = scene.add(SkinDesc{ .boneCount = 4 });
            skins.push_back(desc.skin);
            copies.push_back(scene.add(desc));
        }
        pose(0);
    }

    void pose(int frame) {
        for (int i = 0; i < kCopies; ++i) scene.setBones(skins[static_cast<size_t>(i)], poseOf(i, frame));
    }

    Image draw() { return test::renderLinear(engine(), renderer, scene, view); }

    std::vector<Skin> skins;
    std::vector<Renderable> copies;
    Renderer renderer;

private:
    Owned<Material> mMaterial;
    std::vector<Owned<MaterialInstance>> mInstances;
};

/// The images of `draw` with instances and without, on both APIs, which all have the same bits; and fewer draws.
void expectTheBitsOfSeparateDraws(const char* package, std::function<void(CopiesStage&)> const& setUp,
                                  std::function<Image(CopiesStage&)> const& draw, uint32_t passes = 1) {
    std::vector<Image> images;
    std::vector<uint32_t> draws;
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        for (const Draws how : { Draws::Together, Draws::Alone }) {
            CopiesStage stage(*engine, how, package);
            setUp(stage);
            images.push_back(draw(stage));
            draws.push_back(stage.renderer.statistics().draws);
        }
        test::expectNoErrors(*engine);
    }
    EXPECT_LE(draws[0] + passes * (kCopies - 5), draws[1]) << "a few slices by depth instead of " << kCopies;
    EXPECT_EQ(draws[0], draws[2]);
    EXPECT_GT(std::ranges::count_if(images[0].pixels, [](std::byte byte) { return byte != std::byte{}; }), 2000)
            << "copies are seen";
    EXPECT_EQ(images[0].pixels, images[1].pixels) << "instances on Vulkan";
    EXPECT_EQ(images[2].pixels, images[3].pixels) << "instances on OpenGL ES";
    EXPECT_EQ(images[0].pixels, images[2].pixels) << "Vulkan and OpenGL ES";
}

TEST(SkinnedInstances, HaveTheBitsOfSeparateDraws) {
    expectTheBitsOfSeparateDraws(
            "gltf_lit_opaque", [](CopiesStage&) {}, [](CopiesStage& stage) { return stage.draw(); });
}

// Copies cross each other, and blend in the order of their depths; neighbours in this order are instances.
TEST(SkinnedInstances, OfTransparentMaterialsBlendInTheirOrder) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        for (const Draws how : { Draws::Together, Draws::Alone }) {
            CopiesStage stage(*engine, how, "gltf_lit_blended");
            images.push_back(stage.draw());
        }
        test::expectNoErrors(*engine);
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    EXPECT_EQ(images[2].pixels, images[3].pixels);
    EXPECT_EQ(images[0].pixels, images[2].pixels);
}

TEST(SkinnedInstances, CastShadowsOfTheirOwnPoses) {
    expectTheBitsOfSeparateDraws(
            "gltf_lit_opaque", [](CopiesStage& stage) { stage.view.quality.shadows = ShadowFilter::Pcf3; },
            [](CopiesStage& stage) {
                stage.draw(); // the map is drawn again for other poses
                stage.pose(1);
                return stage.draw();
            });
}

TEST(SkinnedInstances, HaveTheMotionOfTheirOwnBones) {
    expectTheBitsOfSeparateDraws(
            "gltf_lit_opaque", [](CopiesStage& stage) { stage.view.effects.motionBlur.enabled = true; },
            [](CopiesStage& stage) {
                stage.draw();
                stage.pose(1);
                return stage.draw();
            },
            2); // the image, and motion
}

TEST(SkinnedInstances, ArePickedWhereTheyAreSeen) {
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        CopiesStage together(*engine, Draws::Together), alone(*engine, Draws::Alone);
        const auto hitAt = [](CopiesStage& stage, uint2 pixel) {
            const auto hit = stage.renderer.waitPick(stage.renderer.pick(stage.scene, stage.view, pixel));
            EXPECT_TRUE(hit.ok());
            const auto found = std::ranges::find(stage.copies, hit->renderable);
            return std::pair(found - stage.copies.begin(), hit->distanceMeters);
        };
        int hits = 0;
        for (uint32_t y = 6; y < 72; y += 5) {
            for (uint32_t x = 5; x < 96; x += 6) {
                const auto expected = hitAt(alone, { x, y });
                EXPECT_EQ(hitAt(together, { x, y }), expected) << x << ' ' << y;
                hits += expected.first < kCopies;
            }
        }
        EXPECT_GT(hits, 5);
        test::expectNoErrors(*engine);
    }
}

// Morph weights belong to a draw; copies with targets stay apart.
TEST(SkinnedInstances, CopiesWithMorphTargetsAreDrawnAlone) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
    ASSERT_TRUE(engine.ok());
    const auto drawsOf = [&](bool morphs) {
        DeformationStage stage(*engine);
        RenderableDesc desc = stage.sphere(Joints::Four);
        const std::vector<float3> moved(scenes::makeSphere(12, 24).vertices.size(), float3(0.1f));
        const auto targets = engine->own(engine->create(MorphTargetsDesc{
                .vertexCount = static_cast<uint32_t>(moved.size()), .targets = { { .positions = moved } } }));
        if (morphs) desc.morphTargets = targets;
        for (int i = 0; i < 3; ++i) {
            desc.skin = stage.scene.add(SkinDesc{ .boneCount = 4 });
            stage.scene.add(desc);
        }
        stage.view.quality.shadows = ShadowFilter::Off;
        Renderer renderer(*engine);
        const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = stage.view.size }));
        renderer.render(stage.scene, stage.view, target);
        return renderer.statistics().draws;
    };
    EXPECT_EQ(drawsOf(true), drawsOf(false) + 2);
}

} // namespace
} // namespace filament_core
