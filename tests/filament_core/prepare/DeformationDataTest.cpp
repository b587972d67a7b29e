// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DeformationData.h"

#include "filament_core/prepare/ObjectData.h"
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

    shader::DeformationUniforms uniformsAt(DeformationList const& list, uint32_t boneRoom, uint32_t block) {
        jobs::JobSystem jobs({ .workers = 1 });
        std::vector<std::byte> memory(list.bytes);
        writeDeformations(jobs, list, boneRoom, memory);
        shader::DeformationUniforms uniforms{};
        std::memcpy(&uniforms, memory.data() + block, std::min(sizeof uniforms, memory.size() - block));
        return uniforms;
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
    for (const uint32_t offset : { a.weights, b.weights, c.weights }) EXPECT_EQ(offset % 256, 0u);
    EXPECT_EQ(packet.deformations.bytes, 3 * 256u);
    EXPECT_EQ(packet.deformations.boneCount, 7u);

    jobs::JobSystem jobs({ .workers = 1 });
    std::vector<shader::BoneData> bones(7);
    writeBones(jobs, packet.deformations, bones);
    EXPECT_EQ(bones[a.bones + 6].row2, float4(0, 0, 1, -5));
    const shader::DeformationUniforms morphed = uniformsAt(packet.deformations, 7, c.weights);
    EXPECT_EQ(morphed.shape, float4(2, 2, 8, 0)) << "two active targets, two texels, eight vertices, no skin";
    EXPECT_EQ(morphed.targets[0], float4(0.5f, 1, 0, 0));
    EXPECT_EQ(morphed.targets[1], float4(-2, 3, 0, 0));
    const shader::DeformationUniforms skinned = uniformsAt(packet.deformations, 7, a.weights);
    EXPECT_EQ(skinned.shape, float4(0, 0, 0, 2));
    EXPECT_EQ(skinned.bones, glm::uvec4(0, 6, 0, 0)) << "a device with room for 7 has room for skins that begin at 0";
}

/// The slot of each visible object with its first bone, in the order of drawing.
std::vector<std::pair<uint32_t, float>> firstBones(ViewPacket const& view) {
    std::vector<shader::ObjectData> objects(view.objects.size());
    jobs::JobSystem jobs({ .workers = 1 });
    writeObjects(jobs, view.objects, objects);
    std::vector<std::pair<uint32_t, float>> found;
    for (size_t i = 0; i < objects.size(); ++i) {
        found.emplace_back(view.objects.deformations[view.objects.order[i].renderable], objects[i].flags.w);
    }
    return found;
}

// Poses are data of objects: copies of one mesh with skins of one kind are instances, as rigid ones are.
TEST_F(DeformationDataTest, CopiesOfASkinnedMeshShareADrawAndABlockAndHaveBonesOfTheirOwn) {
    const auto addCopy = [&](double z, size_t bones, uint8_t jointSets) {
        const Skin skin = scene::addSkin(scene, { .bones = std::vector<shader::BoneData>(bones) });
        scene::setBones(scene, skin, std::vector<float4x4>(bones, float4x4(moved(0, 0, z))));
        return addDeformed(box(double4x4(1.0), solid, 1), { .skin = skin, .jointSets = jointSets });
    };
    for (int i = 0; i < 3; ++i) addCopy(-5, 6, 1);
    const FramePacket alike = prepare();
    ASSERT_EQ(alike.mainView().opaque.size(), 1u);
    EXPECT_EQ(alike.mainView().opaque[0].instanceCount, 3u);
    EXPECT_EQ(alike.deformations.bytes, 256u);
    EXPECT_EQ(alike.deformations.boneCount, 18u);
    for (auto const& [slot, first] : firstBones(alike.mainView()))
        EXPECT_EQ(first, static_cast<float>(alike.deformations.places[slot].bones)) << slot;

    const Renderable other = addCopy(-5, 7, 1);
    addCopy(-5, 6, 2);
    add(double3(0, 0, -5), solid);
    EXPECT_EQ(prepare().mainView().opaque.size(), 4u) << "other kinds of skins, and what has none";
    scene::removeRenderable(scene, other);
    const FramePacket fewer = prepare();
    EXPECT_EQ(fewer.mainView().opaque.size(), 3u) << "the last renderable took the place of the removed one";
    for (auto const& [slot, first] : firstBones(fewer.mainView()))
        EXPECT_EQ(first,
                  slot == scene::kNotDeformed ? 0.0f : static_cast<float>(fewer.deformations.places[slot].bones));
}

// One copy in view does not upload the others.
TEST_F(DeformationDataTest, OnlyCopiesInViewHaveTheirBonesUploaded) {
    for (const double z : { -5.0, 5.0, -6.0, 7.0 }) {
        const Skin skin = scene::addSkin(scene, { .bones = std::vector<shader::BoneData>(3) });
        scene::setBones(scene, skin, std::vector<float4x4>(3, float4x4(moved(0, 0, z))));
        addDeformed(box(double4x4(1.0), solid, 1), { .skin = skin, .jointSets = 1 });
    }
    const FramePacket packet = prepare();
    EXPECT_EQ(packet.deformations.boneCount, 6u);
    EXPECT_EQ(packet.deformations.bones[0], 0u);
    EXPECT_EQ(packet.deformations.bones[1], kNowhere);
    EXPECT_EQ(packet.deformations.bones[2], 3u);
    EXPECT_EQ(packet.mainView().opaque[0].instanceCount, 2u);
}

// Without room on the device nothing is written or read behind the end.
TEST_F(DeformationDataTest, SkinsThatTheDeviceHasNoRoomForAreDrawnAtRest) {
    std::vector<uint32_t> slots;
    for (const size_t bones : { 5u, 4u, 3u }) {
        const Skin skin = scene::addSkin(scene, { .bones = std::vector<shader::BoneData>(bones) });
        scene::setBones(scene, skin, std::vector<float4x4>(bones, float4x4(moved(0, 0, -5))));
        addDeformed(box(double4x4(1.0), solid, 1), { .skin = skin, .jointSets = 1 });
    }
    const FramePacket packet = prepare();
    ASSERT_EQ(packet.deformations.boneCount, 12u);
    std::vector<shader::BoneData> bones(10);
    jobs::JobSystem jobs({ .workers = 1 });
    writeBones(jobs, packet.deformations, bones);
    const auto shapeOf = [&](size_t i) {
        return uniformsAt(packet.deformations, 10, packet.deformations.places[i].weights);
    };
    // A skin is drawn if it begins where its kind still ends inside of the room.
    const auto begins = [&](size_t i) { return packet.deformations.places[i].bones; };
    EXPECT_EQ(shapeOf(0).bones, glm::uvec4(5, 4, 0, 0));
    EXPECT_EQ(shapeOf(1).bones, glm::uvec4(6, 3, 0, 0));
    EXPECT_EQ(shapeOf(2).bones, glm::uvec4(7, 2, 0, 0));
    EXPECT_EQ(begins(0), 0u);
    EXPECT_EQ(begins(1), 5u);
    EXPECT_EQ(begins(2), 9u) << "behind 7: at rest";
    const uint32_t third = packet.deformations.places[2].weights;
    EXPECT_EQ(uniformsAt(packet.deformations, 2, third).shape.w, 0.0f) << "no skin of this kind fits";
}

// Ties are resolved in the order of the targets.
TEST_F(DeformationDataTest, OfTooManyActiveTargetsThoseOfTheLargestWeightsStay) {
    constexpr size_t kCount = 3000, kMost = shader::kMaxActiveTargets;
    scene::MorphTargets many = morph;
    many.targetCount = kCount;
    many.reach.assign(kCount, { float3(0), float3(0) });
    for (const bool isTied : { false, true }) {
        std::vector<float> weights(kCount);
        std::vector<std::pair<float, uint32_t>> order;
        for (uint32_t i = 0; i < kCount; ++i) {
            const float size =
                    isTied ? 0.25f * static_cast<float>(1 + i % 3) : 1e-3f * static_cast<float>(i * 7 % 3001);
            weights[i] = i % 5 == 0 ? 0.0f : i % 2 ? size : -size;
            order.emplace_back(-std::abs(weights[i]), i);
        }
        std::ranges::sort(order);
        order.resize(kMost);
        std::ranges::sort(order, {}, &std::pair<float, uint32_t>::second);
        const Renderable box =
                addDeformed(this->box(moved(0, 0, -6), solid, 3), { .morph = &many, .weights = weights });
        const FramePacket packet = prepare();
        const shader::DeformationUniforms block =
                uniformsAt(packet.deformations, 0, packet.deformations.places[0].weights);
        ASSERT_EQ(block.shape.x, float{ kMost });
        for (size_t i = 0; i < kMost; ++i) {
            const uint32_t target = order[i].second;
            ASSERT_EQ(block.targets[i], float4(weights[target], target, 0, 0)) << i << (isTied ? " tied" : "");
        }
        scene::removeRenderable(scene, box);
    }
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
