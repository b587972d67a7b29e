// SPDX-License-Identifier: Apache-2.0
// From scenes to draw calls: what merges, in which order, and that workers make no difference.
#include "filament_core/prepare/DrawList.h"

#include "filament_core/prepare/ObjectData.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <vector>

namespace filament_core::prepare {
namespace {

constexpr uint32_t kWindow = shader::kObjectsPerWindow;

struct DrawListTest : testing::Test, BoxScene {
    Arena arena;
    ViewInput view{ .camera = Camera::lookAt({ 0, 0, 10 }, { 0, 0, 0 }), .size = { 640, 480 } };

    FramePacket frame(int workers = 1) {
        jobs::JobSystem jobs({ .workers = workers });
        return prepareFrame(jobs, arena, scene, view);
    }
    ViewPacket prepare(int workers = 1) { return frame(workers).mainView(); }

    /// Expects that every visible object is drawn once, by a draw of its drawable and side, within one window.
    void expectCoversItsObjects(ViewPacket const& packet) {
        uint32_t next = 0;
        uint64_t triangles = 0;
        for (std::span<const DrawCall> list : { packet.opaque, packet.blended }) {
            for (DrawCall const& draw : list) {
                if (draw.pass == DrawPass::Second) next -= draw.instanceCount; // the same objects once more
                ASSERT_EQ(draw.firstObject, next);
                ASSERT_GT(draw.instanceCount, 0u);
                ASSERT_EQ(draw.firstObject / kWindow, (draw.firstObject + draw.instanceCount - 1) / kWindow);
                ASSERT_EQ(draw.material->material->isBlended(), list.data() == packet.blended.data());
                for (uint32_t i = 0; i < draw.instanceCount; ++i, ++next) {
                    const uint32_t at = packet.objects.order[next].renderable;
                    scene::Drawable const& drawable = scene.renderables.drawables[scene.renderables.drawable[at]];
                    ASSERT_EQ(draw.geometry, &drawable.geometry);
                    ASSERT_EQ(draw.material, drawable.material);
                    ASSERT_EQ(draw.mirrored, (scene.renderables.flags[at] & scene::kMirrored) != 0);
                }
                triangles += draw.instanceCount * uint64_t{ draw.geometry->indexCount / 3 };
            }
        }
        EXPECT_EQ(next, packet.objects.size());
        EXPECT_EQ(next, packet.counts.visible);
        EXPECT_EQ(triangles, packet.counts.triangles);
    }

    scene::MaterialInstance* twoPasses() {
        scene::MaterialInstance* look = material(shader::Blending::Transparent);
        look->material->package.transparency = shader::TransparencyMode::TwoPassesTwoSides;
        return look;
    }

    void addRandom(uint32_t count, uint32_t seed) {
        std::vector<scene::MaterialInstance*> looks;
        for (int i = 0; i < 9; ++i) {
            looks.push_back(material(i % 3 ? shader::Blending::Opaque : shader::Blending::Transparent));
        }
        looks.push_back(twoPasses());
        Random random(seed);
        for (uint32_t i = 0; i < count; ++i) {
            const double3 at(random.within(-20, 20), random.within(-20, 20), random.within(-60, 5));
            add(at, looks[random.next() % looks.size()], 1 + random.next() % 5, random.next() % 4 ? 1 : -1);
        }
    }
};

TEST_F(DrawListTest, NEqualBoxesTakeOneDrawAWindow) {
    const auto* look = material();
    uint32_t added = 0;
    for (uint32_t count : { 0u, 1u, 255u, 256u, 257u, 511u, 512u, 513u, 5000u }) {
        for (; added < count; ++added) add({ added % 9 * 0.1, 0.0, -0.01 * added }, look);
        const ViewPacket packet = prepare();
        EXPECT_EQ(packet.counts.visible, count);
        EXPECT_EQ(packet.opaque.size(), (count + kWindow - 1) / kWindow) << count;
        expectCoversItsObjects(packet);
    }
}

TEST_F(DrawListTest, AHundredThousandCopiesTakeThreeHundredAndNinetyOneDraws) {
    addCube(100'000, 1, 1);
    view = cubeView(100'000);
    const ViewPacket packet = prepare();
    EXPECT_EQ(packet.counts.visible, 100'000u);
    EXPECT_EQ(packet.opaque.size(), 391u);
    expectCoversItsObjects(packet);
}

TEST_F(DrawListTest, AFewCopiesAreOneDrawEvenWhenOthersLieBetweenThem) {
    const auto* look = material();
    for (uint32_t i = 0; i < 15; ++i) {
        add({ 0.0, 0.0, -10.0 * i }, look, 1);
        add({ 0.0, 0.0, -10.0 * i - 5 }, look, 100 + i);
    }
    const ViewPacket packet = prepare();
    EXPECT_EQ(packet.opaque.size(), 16u);
    EXPECT_EQ(packet.opaque[0].instanceCount, 15u);
}

TEST_F(DrawListTest, CopiesInOneDrawLieFrontToBack) {
    const auto* look = material();
    for (uint32_t i = 0; i < 15; ++i) add({ 0.0, 0.0, -10.0 * (i * 7 % 15) }, look);
    const ViewPacket packet = prepare();
    ASSERT_EQ(packet.opaque.size(), 1u);
    for (uint32_t i = 0; i < 15; ++i) EXPECT_EQ(packet.objects.order[i].renderable * 7 % 15, i);
}

TEST_F(DrawListTest, ManyCopiesOfTwoMeshesAreCutByDepthSoThatWhatIsInFrontComesFirst) {
    const auto* look = material();
    for (uint32_t i = 0; i < 2000; ++i) add({ 0.0, 0.0, -0.5 * i }, look, 1 + i % 2);
    const ViewPacket packet = prepare();
    EXPECT_LT(packet.opaque.size(), 2000 / kSliceMembers);
    expectCoversItsObjects(packet);
    double nearestSoFar = 0;
    for (DrawCall const& draw : packet.opaque) {
        const uint32_t first = packet.objects.order[draw.firstObject].renderable;
        const double depth = 10 + 0.5 * first;
        EXPECT_GT(depth, nearestSoFar * std::exp2(-0.25) * 0.999) << "a quarter of an octave at most behind the order";
        nearestSoFar = std::max(nearestSoFar, depth);
    }
}

TEST_F(DrawListTest, AllBlendedIsBackToFrontAndEqualDepthsKeepTheOrderOfTheScene) {
    const auto* a = material(shader::Blending::Transparent);
    const auto* b = material(shader::Blending::Fade);
    for (uint32_t i = 0; i < 300; ++i) add({ 0.0, 0.0, -static_cast<double>(i / 2) }, i % 2 ? a : b, 1 + i % 3);
    const ViewPacket packet = prepare();
    EXPECT_TRUE(packet.opaque.empty());
    expectCoversItsObjects(packet);
    for (uint32_t i = 0; i < 300; ++i) {
        EXPECT_EQ(packet.objects.order[i].renderable, (299 - i) / 2 * 2 + i % 2) << i;
    }
}

TEST_F(DrawListTest, PriorityThenBlendOrderThenDistanceThenTheOrderOfTheScene) {
    const auto* glass = material(shader::Blending::Transparent);
    scene::MaterialInstance* overlay = material();
    overlay->raster.depthCulling = false;
    Random random(5);
    struct Added {
        bool blends;
        filament_core::DrawOrder place;
        double distance;
    };
    std::vector<Added> added;
    for (uint32_t i = 0; i < 600; ++i) {
        const Added one{ random.next() % 2 == 0,
                         { static_cast<uint8_t>(random.next() % 8), static_cast<uint16_t>(random.next() % 3 * 30'000) },
                         static_cast<double>(random.next() % 5) };
        setDrawOrder(scene.renderables, add({ 0.0, 0.0, -one.distance }, one.blends ? glass : overlay), one.place);
        added.push_back(one);
    }
    std::vector<uint32_t> expected(added.size());
    std::iota(expected.begin(), expected.end(), 0u);
    std::ranges::stable_sort(expected, {}, [&](uint32_t i) {
        Added const& one = added[i];
        return std::tuple(one.blends, one.place.priority, one.place.blendOrder, -one.distance);
    });
    for (int workers : { 0, 1, 3, 16 }) {
        const ViewPacket packet = prepare(workers);
        ASSERT_EQ(packet.objects.size(), expected.size());
        for (size_t i = 0; i < expected.size(); ++i)
            ASSERT_EQ(packet.objects.order[i].renderable, expected[i]) << i << " with " << workers << " workers";
        EXPECT_TRUE(packet.anyOrder.empty()) << "sorted by default";
    }
}

/// What may be composed in any order: between `farthest` and `nearest`, and things that are not.
struct AnyOrderTest : DrawListTest {
    AnyOrderTest() { view.quality.transparency = TransparencyOrder::Weighted; }

    scene::MaterialInstance* pane(shader::Blending blending = shader::Blending::Transparent) {
        scene::MaterialInstance* look = material(blending);
        look->raster.depthWrite = false;
        return look;
    }
    /// Of the camera, at z = 10.
    Renderable at(double distance, scene::MaterialInstance const* look) { return add({ 0, 0, 10 - distance }, look); }
    std::vector<uint32_t> order(ViewPacket const& packet) {
        std::vector<uint32_t> renderables;
        for (SortItem const& item : packet.objects.order) renderables.push_back(item.renderable);
        return renderables;
    }
    std::vector<uint32_t> composed(ViewPacket const& packet) {
        std::vector<uint32_t> renderables;
        for (DrawCall const& draw : packet.anyOrderDraws())
            for (uint32_t i = 0; i < draw.instanceCount; ++i)
                renderables.push_back(packet.objects.order[draw.firstObject + i].renderable);
        return renderables;
    }
};

TEST_F(AnyOrderTest, OnlyWhatCoversTestsDepthLeavesNoneAndHasTheDefaultPlace) {
    const auto unlike = [&](auto change) {
        scene::MaterialInstance* look = pane();
        change(*look);
        return look;
    };
    const auto *transparent = pane(), *fade = pane(shader::Blending::Fade);
    at(5, transparent);
    at(9, fade);
    at(6,
       unlike([](auto& look) { look.material->package.transparency = shader::TransparencyMode::TwoPassesTwoSides; }));
    for (const shader::Blending other :
         { shader::Blending::Add, shader::Blending::Multiply, shader::Blending::Screen, shader::Blending::Custom })
        at(7, pane(other));
    at(7, unlike([](auto& look) { look.material->package.transparency = shader::TransparencyMode::TwoPassesOneSide; }));
    at(7, unlike([](auto& look) { look.material->package.refractionMode = shader::RefractionMode::ScreenSpace; }));
    for (const shader::VertexDomain domain : { shader::VertexDomain::View, shader::VertexDomain::Device })
        at(7, unlike([&](auto& look) { look.material->package.vertexDomain = domain; }));
    at(7, unlike([](auto& look) { look.raster.depthWrite = true; }));
    at(7, unlike([](auto& look) { look.raster.depthCulling = false; }));
    at(7, unlike([](auto& look) { look.raster.colorWrite = false; }));
    setDrawOrder(scene.renderables, at(7, transparent), { .priority = 3 });
    setDrawOrder(scene.renderables, at(7, transparent), { .blendOrder = 1 });
    const ViewPacket packet = prepare();
    EXPECT_EQ(composed(packet), (std::vector<uint32_t>{ 1, 2, 2, 0 })) << "one of them in two passes";
    EXPECT_EQ(packet.counts.anyOrderObjects, 3u);
    EXPECT_EQ(packet.anyOrder.nearestMeters, 5);
    EXPECT_EQ(packet.blended.size() - packet.anyOrder.end, 4 + 2 + 6 + 1u) << "and one of the others";
}

TEST_F(AnyOrderTest, OthersKeepTheirPlaceBehindAndComeAfterWhereTheyLieInBetween) {
    const auto *glass = pane(), *glow = pane(shader::Blending::Add);
    for (const double distance : { 4.0, 9.0, 6.0 }) at(distance, glass);            // 0, 1, 2
    for (const double distance : { 3.0, 12.0, 7.0, 11.0, 9.0 }) at(distance, glow); // 3 to 7
    EXPECT_EQ(order(prepare()), (std::vector<uint32_t>{ 4, 6, 1, 2, 0, 7, 5, 3 }));
    EXPECT_EQ(composed(prepare()), (std::vector<uint32_t>{ 1, 2, 0 }));
}

TEST_F(AnyOrderTest, FewerThanTwoObjectsAreDrawnAsIfNobodyAsked) {
    const auto *glass = pane(), *glow = pane(shader::Blending::Add);
    at(6, glass);
    for (const double distance : { 3.0, 12.0, 5.5 }) at(distance, glow);
    const auto quality = view.quality;
    view.quality.transparency = TransparencyOrder::Sorted;
    const uint64_t sorted = hashPacket(frame());
    for (const TransparencyOrder order : { TransparencyOrder::Weighted, TransparencyOrder::Peeled }) {
        view.quality.transparency = order;
        const FramePacket packet = frame();
        EXPECT_TRUE(packet.mainView().anyOrder.empty());
        EXPECT_FALSE(packet.demand.needs(Effect::Transparency));
        EXPECT_EQ(describe(Effect::Transparency, packet.demand.of(Effect::Transparency)),
                  "1 in view that may be composed in any order");
    }
    view.quality = quality;
    at(5, glass);
    EXPECT_TRUE(frame().demand.needs(Effect::Transparency));
    EXPECT_EQ(this->order(prepare()), (std::vector<uint32_t>{ 2, 0, 4, 3, 1 }));
    EXPECT_NE(hashPacket(frame()), sorted);
}

TEST_F(AnyOrderTest, AnyNumberOfWorkersFindsTheSame) {
    std::vector<scene::MaterialInstance*> looks{ pane(), pane(shader::Blending::Fade), pane(shader::Blending::Add),
                                                 material(), twoPasses() };
    looks.back()->raster.depthWrite = false;
    Random random(11);
    for (uint32_t i = 0; i < 20'000; ++i)
        add({ random.within(-20, 20), random.within(-20, 20), random.within(-60, 5) },
            looks[random.next() % looks.size()], 1 + random.next() % 5);
    const FramePacket reference = frame(0);
    expectCoversItsObjects(reference.mainView());
    EXPECT_GT(reference.mainView().anyOrder.end, reference.mainView().anyOrder.first + 100);
    for (int workers : { 1, 2, 3, 16 }) EXPECT_EQ(hashPacket(frame(workers)), hashPacket(reference)) << workers;
}

TEST_F(DrawListTest, NeighboursThatBlendMergeToo) {
    const auto* glass = material(shader::Blending::Transparent);
    for (int i = 0; i < 5; ++i) add({ 0.0, 0.0, -1.0 * i }, glass);
    const ViewPacket packet = prepare();
    ASSERT_EQ(packet.blended.size(), 1u);
    EXPECT_EQ(packet.blended[0].instanceCount, 5u);
}

TEST_F(DrawListTest, TheTwoPassesOfAnObjectFollowEachOtherAndNoOtherObjectComesBetween) {
    const auto* glass = twoPasses();
    const auto* smoke = material(shader::Blending::Transparent);
    for (int i = 0; i < 6; ++i) add({ 0.0, 0.0, -1.0 * i }, i < 4 ? glass : smoke);
    const ViewPacket packet = prepare();
    expectCoversItsObjects(packet);
    ASSERT_EQ(packet.blended.size(), 1 + 4 * 2u) << "the smoke merges, the glass does not";
    EXPECT_EQ(packet.blended[0].pass, DrawPass::Only);
    EXPECT_EQ(packet.blended[0].instanceCount, 2u);
    for (uint32_t i = 0; i < 4; ++i) {
        DrawCall const &first = packet.blended[1 + 2 * i], &second = packet.blended[2 + 2 * i];
        EXPECT_EQ(first.pass, DrawPass::First);
        EXPECT_EQ(second.pass, DrawPass::Second);
        EXPECT_EQ(first.firstObject, 2 + i);
        EXPECT_EQ(second.firstObject, 2 + i);
        EXPECT_EQ(first.instanceCount, 1u);
    }
    EXPECT_EQ(packet.counts.triangles, 12u * (2 + 4 * 2));
}

TEST_F(DrawListTest, TwoPassesOfWhatDoesNotBlendAreOne) {
    scene::MaterialInstance* solid = twoPasses();
    solid->material->package.blending = shader::Blending::Opaque;
    for (int i = 0; i < 3; ++i) add({ 0.0, 0.0, -1.0 * i }, solid);
    const ViewPacket packet = prepare();
    ASSERT_EQ(packet.opaque.size(), 1u);
    EXPECT_EQ(packet.opaque[0].pass, DrawPass::Only);
}

TEST_F(DrawListTest, EverythingOutOfViewIsAPacketWithoutObjects) {
    const auto* look = material();
    for (int i = 0; i < 300; ++i) add({ 0.0, 0.0, 100.0 + i }, look);
    const ViewPacket packet = prepare();
    EXPECT_TRUE(packet.objects.empty());
    EXPECT_TRUE(packet.opaque.empty());
    EXPECT_EQ(packet.counts.triangles, 0u);
}

TEST_F(DrawListTest, MirroredCopiesAreADrawOfTheirOwnAndNoneIsLost) {
    const auto* look = material();
    for (int i = 0; i < 40; ++i) add({ 0.0, 0.0, -1.0 * i }, look, 1, i % 2 ? -1 : 1);
    const ViewPacket packet = prepare();
    expectCoversItsObjects(packet);
    uint32_t mirrored = 0;
    for (DrawCall const& draw : packet.opaque) mirrored += draw.mirrored ? draw.instanceCount : 0;
    EXPECT_EQ(mirrored, 20u);
}

TEST_F(DrawListTest, TransformsThatAreNotNumbersLeaveTheOthersAlone) {
    const auto* look = material();
    for (int i = 0; i < 100; ++i) {
        double4x4 world(i % 10 ? 1.0 : std::numeric_limits<double>::quiet_NaN());
        world[3] = double4(0, 0, -i, 1);
        add(world, look);
    }
    const ViewPacket packet = prepare();
    EXPECT_EQ(packet.counts.visible, 90u);
    EXPECT_EQ(packet.counts.nothingToDraw, 10u);
    expectCoversItsObjects(packet);
}

struct DrawListCountTest : DrawListTest, testing::WithParamInterface<uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Renderables, DrawListCountTest, testing::Values(1, 255, 256, 257, 3000, 70'000));

TEST_P(DrawListCountTest, ARandomSceneIsCoveredAndHasTheSameBitsForAnyNumberOfWorkers) {
    addRandom(GetParam(), GetParam());
    for (uint32_t i = 0; i < 300; ++i) { // enough for a job of their own
        addLight(scene, { .type = scene::LightRecord::Type::Point, .intensity = 1.0f + static_cast<float>(i) });
    }
    const FramePacket reference = frame(0);
    expectCoversItsObjects(reference.mainView());
    for (int workers : { 1, 2, 3, 16 }) {
        EXPECT_EQ(hashPacket(frame(workers)), hashPacket(reference)) << workers << " workers";
    }
}

TEST_F(DrawListTest, TheHashIsOfContentsAndNotOfAddresses) {
    addCube(500, 3, 4);
    BoxScene other;
    other.addCube(500, 3, 4);
    jobs::JobSystem jobs({ .workers = 0 });
    view = cubeView(500);
    EXPECT_EQ(hashPacket(prepareFrame(jobs, arena, scene, view)),
              hashPacket(prepareFrame(jobs, arena, other.scene, view)));
}

TEST_F(DrawListTest, TheHashTellsEveryKindOfDifference) {
    const auto* look = material();
    const Renderable box = add({ 0, 0, 0 }, look);
    const uint64_t before = hashPacket(frame());
    double4x4 moved(1.0);
    moved[3].x = 1e-6;
    setTransform(scene, box, moved);
    EXPECT_NE(hashPacket(frame()), before) << "a position";
    setTransform(scene, box, double4x4(1.0));
    EXPECT_EQ(hashPacket(frame()), before);
    const Light sun = addLight(scene, { .type = scene::LightRecord::Type::Sun, .intensity = 1 });
    EXPECT_NE(hashPacket(frame()), before) << "a light";
    removeLight(scene, sun);
    scene.skybox.cube = backend::TextureHandle::make(3, 1);
    EXPECT_NE(hashPacket(frame()), before) << "a sky";
    scene.skybox = {};
    add({ 0, 0, 100 }, look);
    EXPECT_NE(hashPacket(frame()), before) << "something out of view, by the counts";
}

} // namespace
} // namespace filament_core::prepare
