// SPDX-License-Identifier: Apache-2.0
// Levels of detail: at which distances a view draws which, by closed forms; when it returns to a coarser one; what
// shadow maps, picks and deformed objects draw.
#include "filament_core/prepare/ChooseLevels.h"
#include "filament_core/prepare/ObjectData.h"
#include "filament_core/prepare/PreparePick.h"
#include "filament_core/prepare/UpdateTransforms.h"
#include "filament_core/scene/SceneNodes.h"
#include "filament_core/scene/SceneSkins.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace filament_core::prepare {
namespace {

constexpr double kFine = 0.01, kCoarse = 0.04; // errors of the levels 1 and 2, metres

/// A unit box with three levels in front of a camera at the origin that sees 90 degrees, 1000 pixels to each side.
struct ChooseLevelsTest : testing::Test, BoxScene {
    // An error of e m at z m takes 500 e sqrt(1 + 1 + 1) / z pixels at most.
    static constexpr double kPerMeter = 866.0254;

    jobs::JobSystem jobs{ { .workers = 1 } };
    Arena arena;
    LastFrame last;
    scene::MaterialInstance* solid = material();
    ViewInput view{ .camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }, { .verticalFovDegrees = 90 }),
                    .size = { 1000, 1000 },
                    .lodPixels = 1,
                    .quality = { .shadows = ShadowFilter::Off } };

    static constexpr std::array<uint32_t, 3> kIndices{ 36, 18, 9 };

    scene::RenderableInput detailed(double4x4 const& world) {
        static const std::vector<GeometryLevel> kLevels{ { 36, kIndices[1], static_cast<float>(kFine) },
                                                         { 54, kIndices[2], static_cast<float>(kCoarse) } };
        scene::RenderableInput input = box(world, solid, 1);
        input.levels = kLevels;
        return input;
    }

    static double4x4 at(double z, double scale = 1) {
        return glm::scale(glm::translate(double4x4(1.0), double3(0, 0, -z)), double3(scale, 1, 1));
    }

    /// Of the first draw.
    static uint32_t levelOfDraw(ViewPacket const& packet) {
        if (packet.opaque.empty()) return ~0u;
        const auto found = std::ranges::find(kIndices, packet.opaque[0].geometry->indexCount);
        return static_cast<uint32_t>(found - kIndices.begin());
    }

    /// As a renderer does it.
    FramePacket frame() {
        arena.reset();
        updateTransforms(jobs, scene);
        const FramePacket packet = prepareFrame(jobs, arena, scene, std::span(&view, 1), {}, last);
        last.keep(scene, view, packet);
        return packet;
    }

    /// Without a last frame.
    uint32_t levelAt(double z, double scale = 1) {
        const Renderable renderable = addRenderable(scene, detailed(at(z, scale)));
        last.forget();
        const uint32_t level = levelOfDraw(frame().mainView());
        removeRenderable(scene, renderable);
        return level;
    }
};

TEST_F(ChooseLevelsTest, ALevelBeginsWhereItsErrorIsAsManyPixels) {
    const double fine = 0.5 + kFine * kPerMeter, coarse = 0.5 + kCoarse * kPerMeter; // the box begins 0.5 m nearer
    EXPECT_EQ(levelAt(fine * 0.999), 0u);
    EXPECT_EQ(levelAt(fine * 1.001), 1u);
    EXPECT_EQ(levelAt(coarse * 0.999), 1u);
    EXPECT_EQ(levelAt(coarse * 1.001), 2u);
    view.lodPixels = 2;
    EXPECT_EQ(levelAt(0.5 + kFine * kPerMeter / 2 * 1.001), 1u);
    EXPECT_EQ(levelAt(0.5 + kFine * kPerMeter / 2 * 0.999), 0u);
    view.lodPixels = 0;
    EXPECT_EQ(levelAt(400), 0u);
}

TEST_F(ChooseLevelsTest, ATransformScalesTheError) {
    const double fine = 0.5 + 3 * kFine * kPerMeter;
    EXPECT_EQ(levelAt(fine * 0.999, 3), 0u);
    EXPECT_EQ(levelAt(fine * 1.001, 3), 1u);
    const double4x4 turned = glm::rotate(double4x4(1.0), 0.7, double3(1, 2, 3));
    const double4x4 map = turned * glm::scale(double4x4(1.0), double3(0.5, 4, 2));
    const auto row = [&](int i) { return float3(map[0][i], map[1][i], map[2][i]); };
    EXPECT_NEAR(largestStretch(row(0), row(1), row(2)), 4, 1e-5);
    EXPECT_GE(largestStretch({ 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), 1.618f); // of this shear the golden ratio
}

TEST_F(ChooseLevelsTest, ParallelViewsChooseByTheirScaleAlone) {
    Lens lens;
    lens.orthographicHeight = 10; // 100 pixels a metre
    view.camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }, lens);
    for (const double z : { 2.0, 90.0 }) {
        view.lodPixels = 0.99f;
        EXPECT_EQ(levelAt(z), 0u);
        view.lodPixels = 1.01f;
        EXPECT_EQ(levelAt(z), 1u);
        view.lodPixels = 4.01f;
        EXPECT_EQ(levelAt(z), 2u);
    }
}

TEST_F(ChooseLevelsTest, TheFinestIsDrawnAroundTheCameraAndWithoutBounds) {
    view.lodPixels = 64;
    EXPECT_EQ(levelAt(0.4), 0u);
    scene::RenderableInput input = detailed(at(500));
    input.culled = false;
    addRenderable(scene, input);
    EXPECT_EQ(levelOfDraw(frame().mainView()), 0u);
}

TEST_F(ChooseLevelsTest, PixelsAreThoseOfTheImageThatIsShown) {
    view.size = { 500, 500 };
    view.shownSize = { 1000, 1000 };
    const double fine = 0.5 + kFine * kPerMeter;
    EXPECT_EQ(levelAt(fine * 0.999), 0u);
    EXPECT_EQ(levelAt(fine * 1.001), 1u);
}

TEST_F(ChooseLevelsTest, ACoarserLevelReturnsAtThreeQuartersOfTheLimit) {
    const Renderable renderable = addRenderable(scene, detailed(at(2)));
    const double switches = kFine * kPerMeter, returns = switches / 0.75;
    const auto levelNow = [&](double nearest) {
        setTransform(scene, renderable, at(0.5 + nearest));
        return levelOfDraw(frame().mainView());
    };
    EXPECT_EQ(levelNow(switches * 0.9), 0u);
    EXPECT_EQ(levelNow(switches * 1.1), 0u);
    EXPECT_EQ(levelNow(returns * 0.999), 0u);
    EXPECT_EQ(levelNow(returns * 1.001), 1u);
    EXPECT_EQ(levelNow(switches * 1.001), 1u);
    EXPECT_EQ(levelNow(switches * 0.999), 0u);
    last.forget();
    EXPECT_EQ(levelNow(switches * 1.001), 1u); // the first frame of a view has no history
    uint32_t changes = 0, before = levelNow(returns);
    for (int i = 0; i < 100; ++i) { // trembles by a tenth
        const uint32_t level = levelNow(returns * (i % 2 ? 0.95 : 1.05));
        changes += level != before;
        before = level;
    }
    EXPECT_LE(changes, 1u);
}

TEST_F(ChooseLevelsTest, ADifferentRenderableInItsPlaceHasNoHistory) {
    const double switches = kFine * kPerMeter;
    const Renderable first = addRenderable(scene, detailed(at(2)));
    (void)frame();
    removeRenderable(scene, first);
    addRenderable(scene, detailed(at(0.5 + switches * 1.1)));
    EXPECT_EQ(levelOfDraw(frame().mainView()), 1u);
}

TEST_F(ChooseLevelsTest, CopiesOfOneLevelShareTheirDrawAndCountWhatTheySave) {
    for (int i = 0; i < 6; ++i) addRenderable(scene, detailed(at(i < 4 ? 20 + i : 80)));
    const FramePacket packet = frame();
    ASSERT_EQ(packet.mainView().opaque.size(), 2u);
    EXPECT_EQ(packet.mainView().opaque[0].instanceCount, 4u);
    EXPECT_EQ(packet.mainView().opaque[1].instanceCount, 2u);
    EXPECT_EQ(packet.mainView().counts.triangles, 4u * 6 + 2 * 3);
    EXPECT_EQ(packet.mainView().counts.trianglesSaved, 4u * 6 + 2 * 9);
}

TEST_F(ChooseLevelsTest, WithoutALimitThePacketIsThatWithoutLevels) {
    view.lodPixels = 0;
    BoxScene plain;
    scene::MaterialInstance* const same = plain.material();
    for (int i = 0; i < 20; ++i) {
        addRenderable(scene, detailed(at(3 * i + 1)));
        plain.add(at(3 * i + 1), same);
    }
    const uint64_t with = hashPacket(frame());
    arena.reset();
    EXPECT_EQ(hashPacket(prepareFrame(jobs, arena, plain.scene, std::span(&view, 1))), with);
}

TEST_F(ChooseLevelsTest, ShadowMapsChooseByTheirTexels) {
    addLight(scene, { .type = scene::LightRecord::Type::Sun, .intensity = 1000 });
    addRenderable(scene, detailed(at(5)));
    view.quality.shadows = ShadowFilter::Pcf3;
    view.quality.shadowCascades = 1;
    // The map encloses the box, about 2 m: at 64 texels an error of 4 cm is a texel, at 4096 one of 1 cm is many.
    view.quality.shadowMapSize = 4096;
    const FramePacket fine = frame();
    ASSERT_EQ(fine.views.size(), 2u);
    EXPECT_EQ(levelOfDraw(fine.views[1]), 0u);
    EXPECT_EQ(levelOfDraw(fine.mainView()), 0u);
    view.quality.shadowMapSize = 64;
    const FramePacket coarse = frame();
    ASSERT_EQ(coarse.views.size(), 2u);
    EXPECT_GT(levelOfDraw(coarse.views[1]), 0u);
    EXPECT_EQ(levelOfDraw(coarse.mainView()), 0u);
}

TEST_F(ChooseLevelsTest, ShadowMapsDrawNoFinerLevelThanTheView) {
    addLight(scene, { .type = scene::LightRecord::Type::Sun, .intensity = 1000 });
    addRenderable(scene, detailed(at(50)));
    view.quality.shadows = ShadowFilter::Pcf3;
    view.quality.shadowCascades = 1;
    view.quality.shadowMapSize = 4096;
    const FramePacket packet = frame();
    ASSERT_EQ(packet.views.size(), 2u);
    EXPECT_EQ(levelOfDraw(packet.mainView()), 2u);
    EXPECT_EQ(levelOfDraw(packet.views[1]), 2u);
}

TEST_F(ChooseLevelsTest, PicksDrawTheLevelOfTheView) {
    const double fine = 0.5 + kFine * kPerMeter;
    solid = material(shader::Blending::Transparent); // which needs no depth pass to be picked
    addRenderable(scene, detailed(at(fine * 1.001)));
    EXPECT_EQ(levelOfDraw(preparePick(jobs, arena, scene, view, { 500, 500 }).packet.views[0]), 1u);
    setTransform(scene, scene.renderables.index.handleAt(0), at(fine * 0.999));
    EXPECT_EQ(levelOfDraw(preparePick(jobs, arena, scene, view, { 500, 500 }).packet.views[0]), 0u);
}

struct FadingLevelsTest : ChooseLevelsTest {
    static constexpr double kSwitch = kFine * kPerMeter, kReturn = kSwitch / 0.75;
    Renderable fading{};

    FadingLevelsTest() { view.quality.antiAliasing = AntiAliasing::Taa; }
    /// Fades of the frame with the front of the box at that distance, by level; 0: a level is drawn alone, -100: not.
    std::array<int, 3> fadesAt(double nearest) {
        if (!fading) fading = addRenderable(scene, detailed(at(0.5 + nearest)));
        setTransform(scene, fading, at(0.5 + nearest));
        const FramePacket packet = frame();
        std::array<int, 3> fades{ -100, -100, -100 };
        for (DrawCall const& draw : packet.mainView().opaque)
            fades[static_cast<size_t>(std::ranges::find(kIndices, draw.geometry->indexCount) - kIndices.begin())] =
                    draw.fade;
        EXPECT_EQ(packet.mainView().counts.fadingLevels, packet.mainView().opaque.size() - 1);
        if (packet.mainView().opaque.size() > 1) {
            EXPECT_TRUE(packet.demand.needs(Effect::DepthPrepass));
        }
        return fades;
    }
    using Fades = std::array<int, 3>;
};

TEST_F(FadingLevelsTest, TwoLevelsAreDrawnForAsManyFramesAsAFadeLasts) {
    EXPECT_EQ(fadesAt(kSwitch * 0.9), (Fades{ 0, -100, -100 }));
    for (int i = 1; i < static_cast<int>(kFadeFrames); ++i) EXPECT_EQ(fadesAt(kReturn * 1.001), (Fades{ -i, i, -100 }));
    EXPECT_EQ(fadesAt(kReturn * 1.001), (Fades{ -100, 0, -100 }));
    EXPECT_EQ(fadesAt(kReturn * 1.001), (Fades{ -100, 0, -100 }));
}

TEST_F(FadingLevelsTest, TheChoiceStaysUntilTheOtherLevelIsGone) {
    (void)fadesAt(kSwitch * 0.9);
    EXPECT_EQ(fadesAt(kReturn * 1.001), (Fades{ -1, 1, -100 }));
    for (int i = 2; i < static_cast<int>(kFadeFrames); ++i) EXPECT_EQ(fadesAt(4), (Fades{ -i, i, -100 }));
    EXPECT_EQ(fadesAt(4), (Fades{ 1, -1, -100 }));
    EXPECT_EQ(fadesAt(kCoarse / kFine * kReturn * 1.001), (Fades{ 2, -2, -100 }));
}

TEST_F(FadingLevelsTest, NothingFadesWherePixelsCannotTell) {
    const Fades replaced{ -100, 0, -100 };
    const auto replacedBy = [&] {
        if (fading) removeRenderable(scene, std::exchange(fading, {}));
        last.forget();
        (void)fadesAt(kSwitch * 0.9);
        return fadesAt(kReturn * 1.001);
    };
    EXPECT_NE(replacedBy(), replaced);
    view.quality.antiAliasing = AntiAliasing::Fxaa;
    EXPECT_EQ(replacedBy(), replaced);
    view.quality.antiAliasing = AntiAliasing::Taa;
    view.quality.depthPrepass = DepthPrepass::Off;
    EXPECT_EQ(replacedBy(), replaced);
    view.quality.depthPrepass = DepthPrepass::On;
    view.samples = 4;
    EXPECT_EQ(replacedBy(), replaced);
    view.samples = 1;
    EXPECT_NE(replacedBy(), replaced);
    solid = material(shader::Blending::Masked);
    EXPECT_EQ(replacedBy(), replaced);
}

TEST_F(FadingLevelsTest, ShadowMapsDrawTheCoarserOfBothLevels) {
    addLight(scene, { .type = scene::LightRecord::Type::Sun, .intensity = 1000 });
    view.quality.shadows = ShadowFilter::Pcf3;
    view.quality.shadowCascades = 1;
    view.quality.shadowMapSize = 4096;
    (void)fadesAt(kReturn * 1.001); // the coarser level at once: there is no last frame
    (void)fadesAt(4);
    setTransform(scene, fading, at(4.5));
    const FramePacket packet = frame();
    ASSERT_EQ(packet.views.size(), 2u);
    EXPECT_EQ(packet.mainView().counts.fadingLevels, 1u);
    EXPECT_EQ(levelOfDraw(packet.views[1]), 1u);
    EXPECT_EQ(packet.views[1].counts.fadingLevels, 0u);
}

TEST_F(FadingLevelsTest, ObjectsSayHowFarTheyHaveFaded) {
    (void)fadesAt(kSwitch * 0.9);
    for (int i = 1; i < 6; ++i) (void)fadesAt(kReturn * 1.001);
    const FramePacket packet = frame();
    std::vector<shader::ObjectData> objects(packet.mainView().objects.size());
    writeObjects(jobs, packet.mainView().objects, objects);
    ASSERT_EQ(objects.size(), 2u);
    for (DrawCall const& draw : packet.mainView().opaque) {
        EXPECT_EQ(objects[draw.firstObject].flags.z, draw.fade);
        EXPECT_EQ(std::abs(draw.fade), 6);
    }
}

TEST_F(ChooseLevelsTest, BonesScaleTheErrorAndEveryLevelIsDeformed) {
    const Node root = scene.transforms.add({}, double4x4(1.0), ""),
               joint = scene.transforms.add(root, double4x4(1.0), "");
    const Skin skin =
            scene::addSkin(scene, { .node = root, .joints = { joint }, .jointFromBind = { scene::kIdentity } });
    scene::Deformation deformation{ .skin = skin, .jointSets = 1 };
    deformation.restBounds = { float3(-0.5f), float3(0.5f) };
    attach(scene, scene::addDeformed(scene, detailed(double4x4(1.0)), deformation), root);
    const auto levelNow = [&](double nearest) {
        scene.transforms.setTransform(root, glm::translate(double4x4(1.0), double3(0, 0, -nearest - 1))); // half of 2 m
        scene.transforms.setTransform(joint, glm::scale(double4x4(1.0), double3(2.0)));
        last.forget();
        const FramePacket packet = frame();
        EXPECT_NE(packet.deformations.bytes, 0u);
        return levelOfDraw(packet.mainView());
    };
    EXPECT_EQ(levelNow(2 * kFine * kPerMeter * 0.999), 0u);
    EXPECT_EQ(levelNow(2 * kFine * kPerMeter * 1.001), 1u);
    EXPECT_EQ(levelNow(2 * kCoarse * kPerMeter * 1.001), 2u);
}

TEST_F(ChooseLevelsTest, LevelsFollowTheirRenderableThroughChanges) {
    const Renderable one = addRenderable(scene, detailed(at(100))), two = addRenderable(scene, detailed(at(101)));
    scene::Drawables& drawables = scene.renderables.drawables;
    EXPECT_EQ(drawables.count(), 3u);
    EXPECT_EQ(drawables.use(scene.renderables.drawable[0]).users, 2u);
    scene::setMaterial(scene.renderables, one, *material());
    EXPECT_EQ(drawables.count(), 6u);
    EXPECT_EQ(levelOfDraw(frame().mainView()), 2u);
    scene::setGeometry(scene.renderables, one, { .indexCount = 36 });
    EXPECT_EQ(drawables.count(), 4u);
    removeRenderable(scene, two);
    EXPECT_EQ(drawables.count(), 1u);
    removeRenderable(scene, one);
    EXPECT_EQ(drawables.count(), 0u);
}

} // namespace
} // namespace filament_core::prepare
