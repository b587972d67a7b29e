// SPDX-License-Identifier: Apache-2.0
/// CopiesStage: copies of one deformed mesh, each in its own pose, drawn as instances or one by one: then each has a
/// material instance of its own, and these differ only by their handles.
#pragma once

#include "tests/filament_core/engine/gltf/DeformationStage.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace filament_core::test {

inline constexpr int kCopies = 20;

/// Of copy `i` in frame `frame`: somewhere in a grid, bent.
inline std::vector<float4x4> poseOf(int i, int frame = 0) {
    std::vector<float4x4> bones;
    for (int bone = 0; bone < 4; ++bone) {
        double4x4 at = glm::translate(double4x4(1.0), double3(i % 5 * 0.7 - 1.4, i / 5 * 0.7 - 1.0, -0.2 * (i % 3)));
        at = glm::rotate(at, 0.1 * (bone + 1) * i + 0.2 * frame, double3(0.3, 1, 0.2));
        at = glm::translate(at, double3(0.05 * bone * frame, 0, 0));
        bones.emplace_back(glm::scale(at, double3(0.25, bone == 1 ? 0.4 : 0.25, 0.25)));
    }
    return bones;
}

/// Of the three targets of copy `i`; of some copies fewer than of others are not 0.
inline std::vector<float> weightsOf(int i, int frame = 0) {
    return { 0.2f * static_cast<float>((i + frame) % 5), i % 3 ? 0.0f : 0.5f, -0.1f * static_cast<float>(i % 4) };
}

enum class Draws : uint8_t { Together, Alone };

struct Copied {
    const char* package = "gltf_lit_opaque";
    bool hasSkins = true, hasTargets = false;
    double3 originWorld{ 0 };
};

/// Copies with one material instance, or with one each.
class CopiesStage : public DeformationStage {
public:
    CopiesStage(Engine& engine, Draws draws, Copied const& copied = {})
            : DeformationStage(engine), renderer(engine), mCopied(copied) {
        mMaterial = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial(copied.package) }));
        RenderableDesc desc = sphere(copied.hasSkins ? Joints::Four : Joints::None);
        if (copied.hasTargets) desc.morphTargets = targets();
        for (int i = 0; i < kCopies; ++i) {
            if (i == 0 || draws == Draws::Alone) {
                mInstances.push_back(engine.own(engine.createInstance(mMaterial)));
                EXPECT_TRUE(engine.set(mInstances.back(), "baseColorFactor", float4(0.3f, 0.5f, 0.1f, 0.5f)).ok());
            }
            desc.material = mInstances.back();
            if (copied.hasSkins) skins.push_back(desc.skin = scene.add(SkinDesc{ .boneCount = 4 }));
            desc.worldFromObject = glm::translate(double4x4(1.0), copied.originWorld);
            if (!copied.hasSkins) desc.worldFromObject *= double4x4(poseOf(i).front());
            copies.push_back(scene.add(desc));
        }
        view.camera =
                Camera::lookAt(copied.originWorld + double3(0, 0, 5), copied.originWorld, { .verticalFovDegrees = 50 });
        pose(0);
    }

    void pose(int frame) {
        for (size_t i = 0; i < copies.size(); ++i) {
            const auto copy = static_cast<int>(i);
            if (mCopied.hasSkins) scene.setBones(skins[i], poseOf(copy, frame));
            if (mCopied.hasTargets) scene.setMorphWeights(copies[i], weightsOf(copy, frame));
        }
    }

    Image draw() { return test::renderLinear(engine(), renderer, scene, view); }

    std::vector<Skin> skins;
    std::vector<Renderable> copies;
    Renderer renderer;

private:
    /// Each moves another part of the sphere out, or in; the first one also turns normals.
    MorphTargets targets() {
        std::vector<scenes::SphereVertex> const sphere = scenes::makeSphere(12, 24).vertices;
        std::vector<std::vector<float3>> moved;
        for (const float3 towards : { float3(0, 1, 0), float3(0.8f, 0, 0.6f), float3(-0.6f, -0.8f, 0) }) {
            moved.emplace_back();
            for (scenes::SphereVertex const& vertex : sphere)
                moved.back().push_back(towards * std::max(glm::dot(towards, vertex.position), 0.0f));
        }
        mTargets = engine().own(
                engine().create(MorphTargetsDesc{ .vertexCount = static_cast<uint32_t>(sphere.size()),
                                                  .targets = { { .positions = moved[0], .normals = moved[1] },
                                                               { .positions = moved[1] },
                                                               { .positions = moved[2] } } }));
        return mTargets;
    }

    Copied mCopied;
    Owned<MorphTargets> mTargets;
    Owned<Material> mMaterial;
    std::vector<Owned<MaterialInstance>> mInstances;
};

/// The images of `draw` with instances and without, on both APIs, which all have the same bits; and fewer draws.
inline void expectTheBitsOfSeparateDraws(Copied const& copied, std::function<void(CopiesStage&)> const& setUp,
                                         std::function<Image(CopiesStage&)> const& draw, uint32_t passes = 1) {
    std::vector<Image> images;
    std::vector<uint32_t> draws;
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        for (const Draws how : { Draws::Together, Draws::Alone }) {
            CopiesStage stage(*engine, how, copied);
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

} // namespace filament_core::test
