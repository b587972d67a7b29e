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

    static shader::DeformationUniforms uniformsAt(DeformationList const& list, uint32_t boneRoom, uint32_t block) {
        std::vector<std::byte> memory(list.bytes, std::byte{ 0xCD });
        writeDeformations(list, boneRoom, memory);
        shader::DeformationUniforms uniforms{};
        std::memcpy(&uniforms, memory.data() + block, sizeof uniforms);
        return uniforms;
    }

    /// What lies in the texture; the memory held something else before.
    static std::vector<float4> texelsOf(DeformationList const& list, size_t bones) {
        jobs::JobSystem jobs({ .workers = 1 });
        std::vector<shader::BoneData> written(bones, { float4(-1), float4(-1), float4(-1) });
        writeBones(jobs, list, written);
        std::vector<float4> texels;
        for (shader::BoneData const& bone : written) texels.insert(texels.end(), { bone.row0, bone.row1, bone.row2 });
        return texels;
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
    EXPECT_EQ(a.now.begin, b.now.begin);
    EXPECT_EQ(a.now.bones, b.now.bones);
    EXPECT_NE(a.block, b.block);
    EXPECT_EQ(c.deltas, morph.deltas);
    for (const uint32_t offset : { a.block, b.block, c.block }) EXPECT_EQ(offset % 256, 0u);
    EXPECT_EQ(packet.deformations.bytes, 3 * 256u);
    EXPECT_EQ(packet.deformations.boneCount, 8u) << "the skin's, and one for the record of two weights";

    const std::vector<float4> texels = texelsOf(packet.deformations, 8);
    EXPECT_EQ(texels[3 * (a.now.bones + 6) + 2], float4(0, 0, 1, -5));
    const size_t record = 3 * size_t{ c.now.begin };
    EXPECT_EQ(texels[record], float4(2, 0, 0, 0)) << "two active targets";
    EXPECT_EQ(texels[record + 1], float4(0.5f, 1, 0, 0));
    EXPECT_EQ(texels[record + 2], float4(-2, 3, 0, 0));
    EXPECT_EQ(uniformsAt(packet.deformations, 8, c.block).shape, float4(0, 2, 8, 0)) << "two texels, eight vertices";
    EXPECT_EQ(uniformsAt(packet.deformations, 8, c.block).bones.z, 8u);
    const shader::DeformationUniforms skinned = uniformsAt(packet.deformations, 8, a.block);
    EXPECT_EQ(skinned.shape, float4(0, 0, 0, 2));
    EXPECT_EQ(skinned.bones, glm::uvec4(1, 6, 8, 0)) << "of 8 bones, a skin of 7 may begin with the second";
}

/// The slot of each visible object with where its pose begins, in the order of drawing.
std::vector<std::pair<uint32_t, float>> posesOf(ViewPacket const& view) {
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
    for (auto const& [slot, begin] : posesOf(alike.mainView()))
        EXPECT_EQ(begin, static_cast<float>(alike.deformations.places[slot].now.bones)) << slot;

    const Renderable other = addCopy(-5, 7, 1);
    addCopy(-5, 6, 2);
    add(double3(0, 0, -5), solid);
    EXPECT_EQ(prepare().mainView().opaque.size(), 4u) << "other kinds of skins, and what has none";
    scene::removeRenderable(scene, other);
    const FramePacket fewer = prepare();
    EXPECT_EQ(fewer.mainView().opaque.size(), 3u) << "the last renderable took the place of the removed one";
    for (auto const& [slot, begin] : posesOf(fewer.mainView()))
        EXPECT_EQ(begin,
                  slot == scene::kNotDeformed ? 0.0f : static_cast<float>(fewer.deformations.places[slot].now.begin));
}

TEST_F(DeformationDataTest, CopiesOfAMorphedMeshShareADrawAndABlockAndHaveWeightsOfTheirOwn) {
    const Skin shared = scene::addSkin(scene, { .bones = std::vector<shader::BoneData>(5) });
    scene::setBones(scene, shared, std::vector<float4x4>(5, float4x4(moved(0, 0, -5))));
    const auto addCopy = [&](std::vector<float> weights, Skin skin) {
        addDeformed(box(moved(0, 0, skin ? 0 : -5), solid, 1), { .skin = skin,
                                                                 .jointSets = static_cast<uint8_t>(skin ? 1 : 0),
                                                                 .morph = &morph,
                                                                 .weights = std::move(weights) });
    };
    const std::vector<std::vector<float>> weights{ { 1, 0, 0, 0 }, { 0, 2, 3, 4 }, { 0, 0, 0, 0 } };
    for (auto const& each : weights) addCopy(each, {});
    for (auto const& each : weights) addCopy(each, shared);
    const FramePacket packet = prepare();
    ASSERT_EQ(packet.mainView().opaque.size(), 2u) << "with and without the skin";
    EXPECT_EQ(packet.deformations.bytes, 2 * 256u);
    EXPECT_EQ(packet.deformations.boneCount, 2 * 4 + 5u);
    const std::vector<float4> texels = texelsOf(packet.deformations, packet.deformations.boneCount);
    for (auto const& [slot, begin] : posesOf(packet.mainView())) {
        auto at = 3 * static_cast<size_t>(begin);
        const float first = slot < 3 ? 0 : static_cast<float>(packet.deformations.places[3].now.bones);
        EXPECT_EQ(texels[at], float4(slot % 3 == 0 ? 1 : slot % 3 == 1 ? 3 : 0, first, 0, 0));
        for (size_t target = 0; target < 4; ++target) {
            const float weight = weights[slot % 3][target];
            if (weight == 0) continue;
            EXPECT_EQ(texels[++at], float4(weight, target, 0, 0)) << slot << ' ' << target;
        }
    }
    scene::MorphTargets other = morph;
    other.deltas = backend::TextureHandle::make(10, 1);
    addDeformed(box(moved(0, 0, -5), solid, 1), { .morph = &other, .weights = { 1, 0, 0, 0 } });
    EXPECT_EQ(prepare().mainView().opaque.size(), 3u) << "other targets of the same mesh";
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
        return uniformsAt(packet.deformations, 10, packet.deformations.places[i].block);
    };
    // A skin is drawn if it begins where its kind still ends inside of the room.
    const auto begins = [&](size_t i) { return packet.deformations.places[i].now.begin; };
    EXPECT_EQ(shapeOf(0).bones, glm::uvec4(5, 4, 10, 0));
    EXPECT_EQ(shapeOf(1).bones, glm::uvec4(6, 3, 10, 0));
    EXPECT_EQ(shapeOf(2).bones, glm::uvec4(7, 2, 10, 0));
    EXPECT_EQ(begins(0), 0u);
    EXPECT_EQ(begins(1), 5u);
    EXPECT_EQ(begins(2), 9u) << "behind 7: at rest";
    const uint32_t third = packet.deformations.places[2].block;
    EXPECT_EQ(uniformsAt(packet.deformations, 2, third).shape.w, 0.0f) << "no skin of this kind fits";
}

TEST_F(DeformationDataTest, RecordsOfWeightsThatTheDeviceHasNoRoomForAreEmpty) {
    for (int i = 0; i < 3; ++i)
        addDeformed(box(moved(0, 0, -6), solid, 1), { .morph = &morph, .weights = { 1, 2, 3, 4 } });
    const FramePacket packet = prepare();
    ASSERT_EQ(packet.deformations.boneCount, 6u);
    const std::vector<float4> texels = texelsOf(packet.deformations, 3);
    EXPECT_EQ(texels[0], float4(4, 0, 0, 0));
    EXPECT_EQ(texels[4], float4(4, 3, 0, 0));
    EXPECT_EQ(texels[6], float4(0)) << "it begins there, and ends behind the room";
    EXPECT_EQ(packet.deformations.places[2].now.begin, 4u);
    EXPECT_EQ(uniformsAt(packet.deformations, 3, packet.deformations.places[2].block).bones.z, 3u) << "not there";
}

TEST_F(DeformationDataTest, AnyNumberOfWeightsHasAnEffect) {
    scene::MorphTargets many = morph;
    many.targetCount = 3000;
    many.reach.assign(3000, { float3(0), float3(0) });
    std::vector<float> weights(3000);
    for (uint32_t i = 0; i < 3000; ++i) weights[i] = i % 5 == 0 ? 0.0f : 1e-3f * static_cast<float>(i);
    addDeformed(box(moved(0, 0, -6), solid, 3), { .morph = &many, .weights = weights });
    const FramePacket packet = prepare();
    EXPECT_EQ(packet.deformations.boneCount, 801u);
    const std::vector<float4> texels = texelsOf(packet.deformations, 801);
    ASSERT_EQ(texels[0], float4(2400, 0, 0, 0));
    size_t at = 0;
    for (uint32_t i = 0; i < 3000; ++i) {
        if (weights[i] == 0) continue;
        ASSERT_EQ(texels[++at], float4(weights[i], i, 0, 0));
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
