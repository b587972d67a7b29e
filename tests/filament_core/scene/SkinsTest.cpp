// SPDX-License-Identifier: Apache-2.0
// Skins and morph weights in a scene: positions of bones, mirroring, and bounds that contain everything.
#include "filament_core/scene/SceneSkins.h"

#include "filament_core/scene/SceneNodes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace filament_core::scene {
namespace {

double4x4 movedBy(double x, double y, double z) { return glm::translate(double4x4(1.0), double3(x, y, z)); }

struct SkinsTest : testing::Test {
    Material material;
    MaterialInstance instance{ .material = &material };
    SceneData scene;

    /// Updates one level after the other, like prepare.
    void update() {
        Transforms& transforms = scene.transforms;
        scene.deformations.beginMoving(transforms.slotLimit());
        transforms.beginUpdate();
        while (transforms.nextLevel()) {
            for (const uint32_t slot : transforms.recompute(0, transforms.levelSize())) placeAttached(scene, slot);
        }
        for (const uint32_t slot : transforms.takeUnplaced()) placeAttached(scene, slot);
        for (SkinRecord& skin : scene.deformations.skins()) {
            if (skin.isStale || hasMoved(scene, skin)) updateSkin(scene, skin), ++updates;
        }
        scene.deformations.endMoving();
    }

    Renderable addSkinned(Skin skin, Node node, std::vector<MinMax> boneBounds = {}) {
        const Renderable renderable = addDeformed(scene, { .geometry = { .indexCount = 3 }, .material = &instance },
                                                  { .skin = skin,
                                                    .jointSets = 1,
                                                    .restBounds = { float3(-1), float3(1) },
                                                    .boneBounds = std::move(boneBounds) });
        if (node) attach(scene, renderable, node);
        return renderable;
    }

    double3 centerOf(Renderable renderable) {
        return scene.renderables.bounds.centerAt(scene.renderables.index.at(renderable));
    }
    bool isMirrored(Renderable renderable) {
        return scene.renderables.flags[scene.renderables.index.at(renderable)] & kMirrored;
    }

    int updates = 0;
};

TEST_F(SkinsTest, BonesTakeVerticesFromWhereTheyWereBoundIntoTheSpaceOfTheSkinsNode) {
    const Node root = scene.transforms.add({}, movedBy(1e7, 0, 0), "root");
    const Node skin = scene.transforms.add(root, double4x4(1.0), "skin");
    const Node joint = scene.transforms.add(root, movedBy(0, 2, 0), "joint");
    const Skin handle =
            addSkin(scene, { .node = skin, .joints = { joint }, .jointFromBind = { affineFrom(movedBy(0, 0, 3)) } });
    update();
    shader::BoneData const& bone = scene.deformations.skin(handle).bones[0];
    EXPECT_EQ(bone.row0, float4(1, 0, 0, 0)) << "ten thousand kilometres from the origin";
    EXPECT_EQ(bone.row1, float4(0, 1, 0, 2));
    EXPECT_EQ(bone.row2, float4(0, 0, 1, 3));
}

TEST_F(SkinsTest, OnlySkinsWhoseJointsMovedAreComputedAgain) {
    const Node a = scene.transforms.add({}, double4x4(1.0), "a"), b = scene.transforms.add({}, double4x4(1.0), "b");
    const Node other = scene.transforms.add({}, double4x4(1.0), "other");
    const Skin first = addSkin(scene, { .joints = { a }, .jointFromBind = { kIdentity } });
    addSkin(scene, { .joints = { b }, .jointFromBind = { kIdentity } });
    update();
    EXPECT_EQ(updates, 2) << "both are new";
    scene.transforms.setTransform(other, movedBy(1, 0, 0));
    update();
    EXPECT_EQ(updates, 2);
    scene.transforms.setTransform(a, movedBy(5, 0, 0));
    update();
    EXPECT_EQ(updates, 3);
    EXPECT_EQ(scene.deformations.skin(first).bones[0].row0.w, 5);
}

TEST_F(SkinsTest, BoundsFollowTheJointsAndNotTheNode) {
    const Node node = scene.transforms.add({}, double4x4(1.0), "skin");
    const Node joint = scene.transforms.add({}, double4x4(1.0), "joint");
    const Skin skin = addSkin(scene, { .node = node, .joints = { joint }, .jointFromBind = { kIdentity } });
    const Renderable renderable = addSkinned(skin, node);
    update();
    EXPECT_EQ(centerOf(renderable), double3(0));
    scene.transforms.setTransform(joint, movedBy(0, 0, -50));
    update();
    EXPECT_EQ(centerOf(renderable), double3(0, 0, -50));
    scene.transforms.setTransform(node, movedBy(9, 0, 0));
    update();
    EXPECT_EQ(centerOf(renderable), double3(0, 0, -50)) << "bones undo the transform of the skin's node";
}

TEST_F(SkinsTest, BonesThatMirrorTurnFacesAroundAndSoDoesAMirroringNode) {
    const Node node = scene.transforms.add({}, double4x4(1.0), "skin");
    const Node joint = scene.transforms.add({}, glm::scale(double4x4(1.0), double3(-1, 1, 1)), "joint");
    const Skin skin = addSkin(scene, { .node = node, .joints = { joint }, .jointFromBind = { kIdentity } });
    const Renderable renderable = addSkinned(skin, node);
    update();
    EXPECT_TRUE(isMirrored(renderable));
    scene.transforms.setTransform(joint, double4x4(1.0));
    update();
    EXPECT_FALSE(isMirrored(renderable));
    scene.transforms.setTransform(node, glm::scale(double4x4(1.0), double3(1, -1, 1)));
    update(); // the node mirrors, the bones mirror back
    EXPECT_FALSE(isMirrored(renderable));
}

TEST_F(SkinsTest, OnlyBonesThatMoveVerticesDecideWhatIsMirrored) {
    const Skin skin = addSkin(scene, { .bones = std::vector<shader::BoneData>(3) });
    const MinMax some{ float3(0), float3(1) }, none;
    const Renderable renderable = addSkinned(skin, {}, { some, none, none });
    const float4x4 mirror(glm::scale(double4x4(1.0), double3(1, 1, -1)));
    setBones(scene, skin, std::array{ mirror, float4x4(1.0f), float4x4(1.0f) });
    EXPECT_TRUE(isMirrored(renderable));
    setBones(scene, skin, std::array{ float4x4(1.0f), mirror, mirror });
    EXPECT_FALSE(isMirrored(renderable));
}

TEST_F(SkinsTest, ARemovedJointLeavesItsBoneWhereItWas) {
    const Node joint = scene.transforms.add({}, movedBy(1, 2, 3), "joint");
    const Node other = scene.transforms.add({}, double4x4(1.0), "other");
    const Skin skin = addSkin(scene, { .joints = { joint, other }, .jointFromBind = { kIdentity, kIdentity } });
    update();
    removeNode(scene, joint);
    const Node reused = scene.transforms.add({}, movedBy(7, 7, 7), "in the same slot");
    EXPECT_EQ(reused.index(), joint.index());
    scene.transforms.setTransform(other, movedBy(4, 0, 0));
    update();
    EXPECT_EQ(scene.deformations.skin(skin).bones[0].row1.w, 2);
    EXPECT_EQ(scene.deformations.skin(skin).bones[1].row0.w, 4);
}

TEST_F(SkinsTest, RemovingANodeRemovesItsSkinsAndWhatTheyMove) {
    const Node root = scene.transforms.add({}, double4x4(1.0), "root");
    const Node node = scene.transforms.add(root, double4x4(1.0), "skin");
    const Node joint = scene.transforms.add(root, double4x4(1.0), "joint");
    const Skin skin = addSkin(scene, { .node = node, .joints = { joint }, .jointFromBind = { kIdentity } });
    addSkinned(skin, node), addSkinned(skin, node);
    update();
    removeNode(scene, root);
    EXPECT_FALSE(scene.deformations.hasSkins());
    EXPECT_TRUE(scene.deformations.empty());
    EXPECT_EQ(scene.renderables.count(), 0u);
    update();
}

TEST_F(SkinsTest, BonesThatAreNotFiniteDrawNothingAndBreakNothing) {
    const Skin skin = addSkin(scene, { .bones = std::vector<shader::BoneData>(2) });
    const Renderable renderable = addSkinned(skin, {});
    const float huge = std::numeric_limits<float>::max();
    for (const float bad : { std::nanf(""), std::numeric_limits<float>::infinity(), huge }) {
        float4x4 broken(1.0f);
        broken[3].x = bad, broken[0].x = bad;
        setBones(scene, skin, std::array{ broken, float4x4(1.0f) });
        for (shader::BoneData const& bone : scene.deformations.skin(skin).bones) {
            EXPECT_EQ(bone.row0 - bone.row0, float4(0));
        }
    }
    const auto half = scene.renderables.bounds.halfExtentAt(scene.renderables.index.at(renderable));
    EXPECT_FALSE(std::isnan(half.x));
}

/// Numbers in [-1, 1], the same in every run.
struct Random {
    uint32_t state = 1;
    float real() {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) / 8388608.0f - 1;
    }
    float3 point() { return { real(), real(), real() }; }
};

// Random vertices, joints, weights, morph targets: no deformed vertex is outside the box, which is not much too large.
TEST_F(SkinsTest, NoDeformedVertexLeavesTheBounds) {
    Random random;
    constexpr size_t kVertices = 40, kBones = 5, kTargets = 3;
    for (int round = 0; round < 200; ++round) {
        MorphTargets morph{ .vertexCount = kVertices, .targetCount = kTargets };
        std::vector<float3> rest(kVertices);
        std::vector<std::array<float3, kVertices>> deltas(kTargets);
        Deformation deformation{ .morph = &morph };
        for (float3& p : rest) deformation.restBounds.add(p = random.point());
        for (auto& target : deltas) {
            MinMax reach{ float3(0), float3(0) };
            for (float3& delta : target) reach.add(delta = random.point());
            morph.reach.push_back(reach);
            deformation.weights.push_back(2 * random.real());
        }
        SkinRecord skin;
        for (size_t i = 0; i < kBones; ++i) {
            skin.bones.push_back({ float4(random.point(), random.real()), float4(random.point(), random.real()),
                                   float4(random.point(), random.real()) });
        }
        skin.mirrors.resize(kBones);
        deformation.boneBounds.resize(kBones);
        MinMax exact;
        std::vector<float3> finished;
        for (size_t v = 0; v < kVertices; ++v) {
            const size_t a = v % kBones, b = (v * 7 + 1) % kBones;
            const float weight = random.real() * 0.5f + 0.5f;
            deformation.boneBounds[a].add(rest[v]);
            deformation.boneBounds[b].add(rest[v]);
            float3 p = rest[v];
            for (size_t t = 0; t < kTargets; ++t) p += deformation.weights[t] * deltas[t][v];
            const auto by = [&](size_t bone) {
                const float4 q(p, 1);
                return float3(glm::dot(skin.bones[bone].row0, q), glm::dot(skin.bones[bone].row1, q),
                              glm::dot(skin.bones[bone].row2, q));
            };
            finished.push_back(by(a) * weight + by(b) * (1 - weight));
            exact.add(finished.back());
        }
        for (const bool hasSkin : { true, false }) {
            const CenteredBox box = deformedBounds(deformation, hasSkin ? &skin : nullptr);
            if (!hasSkin) continue;
            for (float3 const& p : finished) {
                const float3 outside = glm::abs(p - box.center) - box.halfExtent;
                ASSERT_LE(std::max({ outside.x, outside.y, outside.z }), 1e-5f) << round;
            }
            EXPECT_LT(box.halfExtent.x, 23.0f) << "three targets of weight 2 take 1 to 7, and bones that to 22";
        }
    }
}

TEST_F(SkinsTest, MorphWeightsGrowTheBoundsOnTheSideThatTheyReach) {
    MorphTargets morph{ .vertexCount = 1, .targetCount = 1, .reach = { { float3(0), float3(0, 10, 0) } } };
    const Renderable renderable =
            addDeformed(scene, { .geometry = { .indexCount = 3 }, .material = &instance },
                        { .morph = &morph, .weights = { 0 }, .restBounds = { float3(-1), float3(1) } });
    const auto top = [&] {
        const uint32_t at = scene.renderables.index.at(renderable);
        return scene.renderables.bounds.centerAt(at).y + double(scene.renderables.bounds.halfExtentAt(at).y);
    };
    EXPECT_NEAR(top(), 1, 1e-4);
    setMorphWeights(scene, renderable, std::array{ 0.5f });
    EXPECT_NEAR(top(), 6, 1e-4);
    setMorphWeights(scene, renderable, std::array{ -1.0f });
    EXPECT_NEAR(top(), 1, 1e-4);
    setMorphWeights(scene, renderable, std::array{ std::nanf("") });
    EXPECT_NEAR(top(), 1, 1e-4) << "a weight that is no number counts as 0";
}

TEST_F(SkinsTest, RenderablesOfOneMeshAreOneDrawIfTheirSkinsHaveAsManyBones) {
    const auto skinOf = [&](size_t bones) { return addSkin(scene, { .bones = std::vector<shader::BoneData>(bones) }); };
    const uint32_t a = scene.renderables.index.at(addSkinned(skinOf(3), {})),
                   b = scene.renderables.index.at(addSkinned(skinOf(3), {})),
                   c = scene.renderables.index.at(addSkinned(skinOf(2), {}));
    EXPECT_EQ(scene.renderables.drawable[a], scene.renderables.drawable[b]);
    EXPECT_NE(scene.renderables.drawable[a], scene.renderables.drawable[c]);
    EXPECT_NE(deformationAt(scene.renderables, a), deformationAt(scene.renderables, b)) << "each has bones of its own";
}

TEST_F(SkinsTest, RenderablesOfOneMeshAreOneDrawIfTheyHaveTheSameMorphTargets) {
    const auto targetsOf = [](uint32_t texture) {
        return MorphTargets{ .deltas = backend::TextureHandle::make(texture, 1),
                             .vertexCount = 1,
                             .targetCount = 1,
                             .reach = { { float3(0), float3(1) } } };
    };
    const MorphTargets one = targetsOf(1), other = targetsOf(2);
    const auto drawableOf = [&](MorphTargets const* morph, Skin skin) {
        return scene.renderables.drawable[scene.renderables.index.at(
                addDeformed(scene, { .geometry = { .indexCount = 3 }, .material = &instance },
                            { .skin = skin,
                              .jointSets = static_cast<uint8_t>(skin ? 1 : 0),
                              .morph = morph,
                              .weights = { 0.5f },
                              .restBounds = { float3(-1), float3(1) } }))];
    };
    const Skin skin = addSkin(scene, { .bones = std::vector<shader::BoneData>(3) });
    const uint32_t first = drawableOf(&one, {});
    EXPECT_EQ(drawableOf(&one, {}), first);
    EXPECT_NE(drawableOf(&other, {}), first);
    EXPECT_NE(drawableOf(&one, skin), first);
    EXPECT_EQ(drawableOf(&one, skin), drawableOf(&one, skin));
}

} // namespace
} // namespace filament_core::scene
