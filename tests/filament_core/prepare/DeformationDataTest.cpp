// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DeformationData.h"

#include "filament_core/prepare/UpdateTransforms.h"
#include "filament_core/scene/SceneNodes.h"
#include "filament_core/scene/SceneSkins.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cstring>

namespace filament_core::prepare {
namespace {

double4x4 moved(double x, double y, double z) { return glm::translate(double4x4(1.0), double3(x, y, z)); }

struct DeformationDataTest : testing::Test, BoxScene {
    Arena arena;
    ViewInput view{ .camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }, { .verticalFovDegrees = 60 }),
                    .size = { 64, 64 } };
    scene::MaterialInstance* solid = material();
    scene::MorphTargets morph{ .deltas = backend::TextureHandle::make(9, 1),
                               .vertexCount = 8,
                               .targetCount = 4,
                               .texels = 2,
                               .reach = std::vector<scene::MinMax>(4, { float3(-1), float3(1) }) };

    FramePacket prepare(int workers = 0) {
        jobs::JobSystem jobs({ .workers = workers });
        updateTransforms(jobs, scene);
        return prepareFrame(jobs, arena, scene, view);
    }

    /// A box attached to one joint.
    Renderable addSkinned(Node joint, Node node) {
        const Skin skin =
                scene::addSkin(scene, { .node = node, .joints = { joint }, .jointFromBind = { scene::kIdentity } });
        return addDeformed(box(double4x4(1.0), solid, 1), { .skin = skin, .jointSets = 1 }, node);
    }

    Renderable addDeformed(scene::RenderableInput const& input, scene::Deformation deformation, Node node = {}) {
        deformation.restBounds = { input.boundsMin, input.boundsMax };
        const Renderable renderable = scene::addDeformed(scene, input, std::move(deformation));
        if (node) scene::attach(scene, renderable, node);
        return renderable;
    }
};

TEST_F(DeformationDataTest, ASceneWithoutDeformationsHasNoneInItsPacket) {
    add(double3(0, 0, -5), solid);
    const FramePacket packet = prepare();
    EXPECT_EQ(packet.deformations.bytes, 0u);
    EXPECT_TRUE(packet.deformations.places.empty());
    ASSERT_EQ(packet.mainView().opaque.size(), 1u);
    EXPECT_EQ(packet.mainView().opaque[0].deformation, scene::kNotDeformed);
}

// The joint determines whether a skinned mesh is in view, wherever it was bound.
TEST_F(DeformationDataTest, JointsBringSkinnedMeshesIntoTheViewAndOutOfIt) {
    const Node joint = scene.transforms.add({}, moved(0, 0, -5), "joint"),
               node = scene.transforms.add({}, moved(0, 0, 90), "");
    addSkinned(joint, node);
    EXPECT_EQ(prepare().mainView().counts.visible, 1u);
    scene.transforms.setTransform(joint, moved(0, 0, 5));
    const FramePacket behind = prepare();
    EXPECT_EQ(behind.mainView().counts.visible, 0u);
    EXPECT_EQ(behind.deformations.bytes, 0u) << "what is not seen is not uploaded";
    scene.transforms.setTransform(joint, moved(0, 0, -7));
    EXPECT_EQ(prepare().mainView().counts.visible, 1u);
}

TEST_F(DeformationDataTest, BlocksAreAlignedAndDoNotOverlapAndPrimitivesShareTheirSkin) {
    const Skin skin = scene::addSkin(scene, { .bones = std::vector<shader::BoneData>(7) });
    scene::setBones(scene, skin, std::vector<float4x4>(7, float4x4(moved(0, 0, -5))));
    addDeformed(box(double4x4(1.0), solid, 1), { .skin = skin, .jointSets = 2 });
    addDeformed(box(double4x4(1.0), solid, 2), { .skin = skin, .jointSets = 1 });
    addDeformed(box(moved(0, 0, -6), solid, 3), { .morph = &morph, .weights = { 0, 0.5f, 0, -2 } });
    const FramePacket packet = prepare();
    ASSERT_EQ(packet.deformations.places.size(), 3u);
    DeformationPlace const &a = packet.deformations.places[0], &b = packet.deformations.places[1],
                           &c = packet.deformations.places[2];
    EXPECT_EQ(a.bones, b.bones);
    EXPECT_NE(a.weights, b.weights);
    EXPECT_EQ(c.deltas, morph.deltas);
    for (const uint32_t offset : { a.bones, a.weights, b.weights, c.bones, c.weights }) EXPECT_EQ(offset % 256, 0u);
    EXPECT_EQ(packet.deformations.bytes, 512u + 3 * 256); // 7 bones of 48 bytes

    std::vector<std::byte> memory(packet.deformations.bytes);
    jobs::JobSystem jobs({ .workers = 1 });
    writeDeformations(jobs, packet.deformations, memory);
    shader::BoneData bone{};
    std::memcpy(&bone, memory.data() + a.bones + 6 * sizeof bone, sizeof bone);
    EXPECT_EQ(bone.row2, float4(0, 0, 1, -5));
    std::array<float4, 3> weights{};
    std::memcpy(weights.data(), memory.data() + c.weights, sizeof weights);
    EXPECT_EQ(weights[0], float4(2, 2, 8, 0)) << "two active targets, two texels, eight vertices, no skin";
    EXPECT_EQ(weights[1], float4(0.5f, 1, 0, 0));
    EXPECT_EQ(weights[2], float4(-2, 3, 0, 0));
    std::memcpy(weights.data(), memory.data() + a.weights, sizeof(float4));
    EXPECT_EQ(weights[0], float4(0, 0, 0, 2));
}

TEST_F(DeformationDataTest, TheSameBitsForAnyNumberOfWorkers) {
    std::vector<Node> joints;
    for (int i = 0; i < 120; ++i) {
        const Node root = scene.transforms.add({}, moved(i % 11 - 5, i % 7 - 3, -8 - i % 5), "");
        joints.push_back(scene.transforms.add(root, moved(0.1 * i, 0, 0), ""));
        addSkinned(joints.back(), root);
        addDeformed(box(moved(i % 5 - 2, 0, -9), solid, 2),
                    { .morph = &morph, .weights = { 0.1f * float(i), 0, 1, 0 } });
    }
    std::vector<uint64_t> hashes;
    for (const int workers : { 0, 1, 2, 8 }) {
        for (size_t i = 0; i < joints.size(); ++i)
            scene.transforms.setTransform(joints[i], moved(0.01 * double(i), 0, 0));
        hashes.push_back(hashPacket(prepare(workers)));
    }
    for (const uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
    scene.transforms.setTransform(joints[7], moved(0.5, 0, 0));
    EXPECT_NE(hashPacket(prepare()), hashes[0]) << "the hash sees bones";
}

} // namespace
} // namespace filament_core::prepare
