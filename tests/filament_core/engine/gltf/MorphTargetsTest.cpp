// SPDX-License-Identifier: Apache-2.0
// Morph targets on both devices, compared with meshes that were moved before they were uploaded.
#include "tests/filament_core/engine/gltf/DeformationStage.h"

#include <array>

namespace filament_core {
namespace {

using test::DeformationStage;
using test::drawOnBoth;
using test::expectNearlyEqual;
using test::Joints;

// One target of each kind, at weights beyond 1, gives the mesh that was moved before it was uploaded.
TEST(Deformation, MorphTargetsMoveVerticesByTheirWeights) {
    const auto shift = [](float3 p) { return float3(0.5f * p.y, 0.3f, 0.2f * p.x); };
    const auto build = [&](DeformationStage& stage, float weight, Joints joints) {
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
        const Image expected = drawOnBoth([&](DeformationStage& stage) {
            stage.scene.add(stage.sphere(Joints::None, [&](float3 p) { return p + weight * shift(p); }));
        });
        for (const Joints joints : { Joints::None, Joints::Four }) {
            std::vector<Image> images;
            for (const Backend backend : test::kBothApis) {
                auto engine = test::makeEngine(backend);
                ASSERT_TRUE(engine);
                Owned<MorphTargets> targets;
                {
                    DeformationStage stage(*engine);
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

} // namespace
} // namespace filament_core
