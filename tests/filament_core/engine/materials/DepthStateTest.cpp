// SPDX-License-Identifier: Apache-2.0
// Opaque materials without depth test or depth writes (materials guide, 4.2.24 and 4.2.25): their place in the drawing
// order, as images on both APIs.
#include "tests/filament_core/engine/SkyStage.h"

namespace filament_core {
namespace {

using test::centerPixel;
using test::MaterialStage;
using test::onBothApis;

constexpr float4 kRedSurface{ 1, 0, 0, 1 }, kGreenSurface{ 0, 1, 0, 1 }, kBlueSurface{ 0, 0, 1, 1 };

std::string coloured(std::string_view properties) {
    return fmt::format(R"(material {{ name : depth, shadingModel : unlit, requires : [ color ], {} }}
fragment {{ void material(inout MaterialInputs material) {{
    prepareMaterial(material);
    material.baseColor = getColor();
}} }})",
                       properties);
}

/// What a surface of `properties` at z = 0 shows in the middle, between an ordinary red surface in front of it and
/// a blue one behind it.
float4 seen(std::string_view properties, bool hasFront, bool hasBack) {
    return centerPixel(onBothApis([&](MaterialStage& stage) {
        const MaterialInstance plain = stage.material(coloured(""));
        if (hasFront) stage.add(plain, { { 1, kRedSurface } });
        stage.add(stage.material(coloured(properties)), { { 0, kGreenSurface } });
        if (hasBack) stage.add(plain, { { -1, kBlueSurface } });
    }));
}

TEST(DepthState, AnOrdinarySurfaceLosesToWhatIsInFrontOfIt) {
    EXPECT_EQ(seen("", true, true), kRedSurface);
    EXPECT_EQ(seen("", false, true), kGreenSurface);
}

TEST(DepthState, WithoutDepthTestASurfaceCoversWhatIsInFrontOfIt) {
    EXPECT_EQ(seen("depthCulling : false", true, true), kGreenSurface);
    EXPECT_EQ(seen("depthCulling : false, depthWrite : false", true, true), kGreenSurface);
}

TEST(DepthState, WithoutDepthWritesASurfaceStaysInFrontOfWhatIsBehindIt) {
    EXPECT_EQ(seen("depthWrite : false", false, true), kGreenSurface);
    EXPECT_EQ(seen("depthWrite : false", true, true), kRedSurface);
}

TEST(DepthState, AmongSurfacesWithoutDepthTestTheNearestIsOnTop) {
    for (const bool nearFirst : { true, false }) {
        const float4 color = centerPixel(onBothApis([&](MaterialStage& stage) {
            const MaterialInstance onTop = stage.material(coloured("depthCulling : false"));
            const auto at = [](double z) {
                double4x4 world(1);
                world[3].z = z;
                return world;
            };
            stage.add(onTop, { { 0, nearFirst ? kGreenSurface : kBlueSurface } }, at(nearFirst ? 1 : -1));
            stage.add(onTop, { { 0, nearFirst ? kBlueSurface : kGreenSurface } }, at(nearFirst ? -1 : 1));
        }));
        EXPECT_EQ(color, kGreenSurface) << nearFirst;
    }
}

TEST(DepthState, SurfacesWithoutDepthTestCoverThoseWithoutDepthWrites) {
    const float4 color = centerPixel(onBothApis([](MaterialStage& stage) {
        stage.add(stage.material(coloured("depthCulling : false")), { { 0, kGreenSurface } });
        stage.add(stage.material(coloured("depthWrite : false")), { { 1, kRedSurface } });
    }));
    EXPECT_EQ(color, kGreenSurface);
}

TEST(DepthState, TransparentObjectsAreDrawnAboveThem) {
    const float4 color = centerPixel(onBothApis([](MaterialStage& stage) {
        stage.add(stage.material(coloured("blending : transparent")), { { 1, { 0.5f, 0, 0, 0.5f } } });
        stage.add(stage.material(coloured("depthWrite : false")), { { 0, kGreenSurface } });
    }));
    EXPECT_EQ(color, float4(0.5f, 0.5f, 0, 1));
}

TEST(DepthState, TheSkyDoesNotEraseThem) {
    for (const char* properties : { "depthCulling : false", "depthWrite : false" }) {
        const float4 color = centerPixel(onBothApis([&](MaterialStage& stage) {
            const auto sky = std::make_shared<test::SkyObjects>(stage, test::kWhiteSky);
            const Skybox background = stage.engine.create(SkyboxDesc{ .cube = sky->cube });
            stage.keep(sky);
            stage.keep(std::make_shared<Owned<Skybox>>(stage.engine.own(background)));
            stage.scene.setSkybox(background, Lux{ 1 / stage.view.camera.exposure.factor() });
            stage.add(stage.material(coloured(properties)), { { 0, kGreenSurface } });
        }));
        EXPECT_EQ(color, kGreenSurface) << properties;
    }
}

TEST(DepthState, ChangesAtRunTimeMoveAnObjectInTheOrder) {
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        MaterialStage stage(*engine);
        stage.add(stage.material(coloured("")), { { 1, kRedSurface } });
        const MaterialInstance changing = stage.material(coloured(""));
        stage.add(changing, { { 0, kGreenSurface } });
        const auto color = [&] { return centerPixel(test::renderLinear(*engine, stage.scene, stage.view)); };
        EXPECT_EQ(color(), kRedSurface);
        engine->setDepthCulling(changing, false);
        EXPECT_EQ(color(), kGreenSurface);
        engine->setDepthCulling(changing, true);
        EXPECT_EQ(color(), kRedSurface);
        test::expectNoErrors(*engine);
    }
}

} // namespace
} // namespace filament_core
