// SPDX-License-Identifier: Apache-2.0
// Rectangles, discs and tubes in images: closed forms, both sides, nodes, and what must not happen.
#include "tests/filament_core/engine/quality/QualityFixture.h"

#include <filament_core/Light.h>

#include <algorithm>

namespace filament_core {
namespace {

using test::Patch;

constexpr float kHuge = 1e5f;

class AreaLights : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
    }

    /// Pre-exposed: pixels are multiples of it.
    static Nits nits(View const& view, float radiance = 1) { return { radiance / view.camera.exposure.factor() }; }

    static RectLight facing(View const& view, double3 at, float side) {
        return { .positionWorld = at,
                 .directionWorld = -float3(glm::normalize(at)),
                 .upWorld = { 1, 0, 0 },
                 .widthMeters = side,
                 .heightMeters = side,
                 .luminance = nits(view) };
    }

    decltype(test::makeEngine(Backend::Vulkan)) engine{};
};
INSTANTIATE_TEST_SUITE_P(Apis, AreaLights, testing::ValuesIn(test::kBothApis),
                         [](auto const& api) { return std::string(toString(api.param)); });

// All directions are as bright, so a surface that absorbs nothing is, too: the irradiance is pi L.
TEST_P(AreaLights, AHugeRectangleIsAFurnaceForWhiteMetal) {
    for (const double degrees : { 0.0, 50.0, 75.0 }) {
        for (const float roughness : { 0.0f, 0.3f, 1.0f }) {
            Patch patch(*engine, degrees);
            patch.setSurface(float4(1), 1, roughness);
            patch.scene.add(facing(patch.view, { 0, 0, 60 }, kHuge)); // behind the camera
            const float3 seen = patch.renderCenter();
            EXPECT_NEAR(seen.x, 1, 0.02) << degrees << ' ' << roughness;
        }
    }
}

TEST_P(AreaLights, AHugeRectangleGivesPiTimesItsLuminance) {
    const auto seenWith = [&](float baseColor) {
        Patch patch(*engine, 30);
        patch.view.quality.diffuseCoupling = false;
        patch.setSurface(float4(float3(baseColor), 1), 0, 0.5f);
        patch.scene.add(facing(patch.view, { 0, 0, 60 }, kHuge));
        return patch.renderCenter().x;
    };
    EXPECT_NEAR(seenWith(1) - seenWith(0), 1, 0.005) << "Lambert's lobe: pi L / pi";
}

TEST_P(AreaLights, AMirrorShowsTheLuminanceOfTheLight) {
    const double angle = 40 * std::numbers::pi / 180;
    const double3 mirrored(-std::sin(angle), 0, std::cos(angle));
    for (const double turned : { 0.0, 0.4 }) { // beside its image
        Patch patch(*engine, 40);
        patch.setSurface(float4(1), 1, 0);
        patch.scene.add(facing(patch.view, (mirrored + double3(0, turned, 0)) * 5.0, 1));
        EXPECT_NEAR(patch.renderCenter().x, turned == 0 ? 1 : 0, 0.02);
    }
}

TEST_P(AreaLights, ADiscOverheadHasTheClosedFormOfItsCone) {
    const auto seenWith = [&](float baseColor) {
        Patch patch(*engine);
        patch.view.quality.diffuseCoupling = false;
        patch.setSurface(float4(float3(baseColor), 1), 0, 1);
        patch.scene.add(DiscLight{ .positionWorld = { 0, 0, 2 },
                                   .directionWorld = { 0, 0, -1 },
                                   .radiusMeters = 1,
                                   .luminance = nits(patch.view) });
        return patch.renderCenter().x;
    };
    EXPECT_NEAR(seenWith(1) - seenWith(0), 0.2, 0.002) << "sin^2 of the angle of the rim";
}

// Of an endless strip between planes at angles -a and a from the normal, the irradiance is pi L sin(a).
TEST_P(AreaLights, ALongTubeHasTheClosedFormOfItsWedge) {
    const auto seenWith = [&](float baseColor) {
        Patch patch(*engine);
        patch.view.quality.diffuseCoupling = false;
        patch.setSurface(float4(float3(baseColor), 1), 0, 1);
        patch.scene.add(TubeLight{ .positionWorld = { 0, 0, 2 },
                                   .axisWorld = { 1, 1, 0 },
                                   .lengthMeters = 4000,
                                   .radiusMeters = 0.5f,
                                   .luminance = nits(patch.view) });
        return patch.renderCenter().x;
    };
    EXPECT_NEAR(seenWith(1) - seenWith(0), 0.25, 0.003);
}

TEST_P(AreaLights, OneSideShinesUnlessBothDo) {
    const auto seenWith = [&](bool isAway, bool isTwoSided) {
        Patch patch(*engine, 20);
        patch.setSurface(float4(0.8f, 0.8f, 0.8f, 1), 0, 0.4f);
        RectLight light = facing(patch.view, { 0.5, 0, 2 }, 1);
        if (isAway) light.directionWorld = -light.directionWorld;
        light.isTwoSided = isTwoSided;
        patch.scene.add(light);
        return patch.renderCenter().x;
    };
    const float seen = seenWith(false, false);
    EXPECT_GT(seen, 0.01f);
    EXPECT_EQ(seenWith(true, false), 0);
    EXPECT_NEAR(seenWith(false, true), seen, 1e-3 * seen);
    EXPECT_NEAR(seenWith(true, true), seen, 1e-3 * seen);
}

TEST_P(AreaLights, TheLightEndsAtItsRange) {
    for (const float range : { 1.9f, 2.5f }) {
        Patch patch(*engine);
        patch.setSurface(float4(1), 0, 0.5f);
        RectLight light = facing(patch.view, { 0, 0, 2 }, 1);
        light.rangeMeters = range;
        patch.scene.add(light);
        EXPECT_EQ(patch.renderCenter().x > 0, range > 2) << range;
    }
}

TEST_P(AreaLights, ALightOfANodeFollowsIt) {
    Patch apart(*engine, 20), attached(*engine, 20);
    const double4x4 world{ { 0, 1, 0, 0 }, { -1, 0, 0, 0 }, { 0, 0, 1, 0 }, { 0.4, 0.2, 2, 1 } }; // x to y, y to -x
    const float3 down{ 0, 0, -1 };
    for (Patch* patch : { &apart, &attached }) patch->setSurface(float4(0.8f, 0.8f, 0.8f, 1), 0, 0.5f);
    RectLight light{ .directionWorld = down,
                     .upWorld = { 0, 1, 0 },
                     .widthMeters = 2,
                     .heightMeters = 0.3f,
                     .luminance = nits(apart.view) };
    TubeLight tube{ .positionWorld = { 1, 0, 0 }, .axisWorld = { 0, 1, 0 }, .luminance = nits(apart.view) };
    const Node node = attached.scene.add(NodeDesc{});
    attached.scene.setTransform(node, world);
    attached.scene.add(light, node);
    attached.scene.add(tube, node);
    light.positionWorld = { 0.4, 0.2, 2 };
    light.upWorld = { -1, 0, 0 };
    tube.positionWorld = { 0.4, 1.2, 2 };
    tube.axisWorld = { -1, 0, 0 };
    apart.scene.add(light);
    apart.scene.add(tube);
    const float3 expected = apart.renderCenter();
    EXPECT_GT(expected.x, 0.01f);
    EXPECT_NEAR(attached.renderCenter().x, expected.x, 1e-3 * expected.x);
}

TEST_P(AreaLights, NoPlaceAndNoSizeGivesWhatIsNotANumberOrNegative) {
    constexpr std::array kSizes{ 0.0f, 1e-20f, 1e-6f, 0.3f, 1e8f, 1e18f };
    constexpr std::array kHeights{ -1e-3, 0.0, 1e-9, 0.01, 1.0, 1e7 };
    for (const double degrees : { 0.0, 60.0, 89.9 }) {
        Patch patch(*engine, degrees);
        patch.setSurface(float4(0.8f, 0.8f, 0.8f, 1), 0.5f, degrees > 80 ? 0.0f : 0.6f);
        for (const float size : kSizes) {
            for (const double height : kHeights) {
                const double3 at(0.01, -0.02, height);
                const std::array<Light, 4> lights{ patch.scene.add(RectLight{ .positionWorld = at,
                                                                              .directionWorld = { 0, 0, -1 },
                                                                              .widthMeters = size,
                                                                              .heightMeters = 0.5f,
                                                                              .luminance = nits(patch.view) }),
                                                   patch.scene.add(RectLight{ .positionWorld = at,
                                                                              .directionWorld = { 1, 0, 0 },
                                                                              .widthMeters = size,
                                                                              .heightMeters = size,
                                                                              .luminance = nits(patch.view),
                                                                              .isTwoSided = true }),
                                                   patch.scene.add(DiscLight{ .positionWorld = at,
                                                                              .directionWorld = { 1, 0, -1e-4f },
                                                                              .radiusMeters = size,
                                                                              .luminance = nits(patch.view),
                                                                              .isTwoSided = true }),
                                                   patch.scene.add(TubeLight{ .positionWorld = at,
                                                                              .lengthMeters = 1,
                                                                              .radiusMeters = size,
                                                                              .luminance = nits(patch.view) }) };
                const Image image = patch.render();
                for (uint32_t i = 0; i < 16; ++i) {
                    const float4 pixel = test::halfPixel(image, i, i);
                    ASSERT_TRUE(pixel.x >= 0 && pixel.x < 50)
                            << pixel.x << ": " << degrees << ' ' << size << ' ' << height;
                }
                for (const Light light : lights) patch.scene.remove(light);
            }
        }
    }
    test::expectNoErrors(*engine);
}

TEST_P(AreaLights, ALuminanceThatIsNotUsableGivesNoLight) {
    Patch patch(*engine);
    patch.setSurface(float4(1), 0, 0.5f);
    for (const float bad : { -1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity() }) {
        RectLight light = facing(patch.view, { 0, 0, 2 }, 1);
        light.luminance = { bad };
        patch.scene.add(light);
    }
    EXPECT_EQ(patch.renderCenter(), float3(0));
    EXPECT_EQ(patch.scene.lightCount(), 3u);
}

TEST_P(AreaLights, AnUpAlongTheDirectionIsAnyUp) {
    Patch patch(*engine);
    patch.setSurface(float4(1), 0, 0.5f);
    RectLight light = facing(patch.view, { 0, 0, 2 }, 1);
    const auto seen = [&](float3 up) {
        light.upWorld = up;
        const Light added = patch.scene.add(light);
        const float radiance = patch.renderCenter().x;
        patch.scene.remove(added);
        return radiance;
    };
    const float expected = seen({ 1, 0, 0 });
    for (const float3 up : { float3(0, 0, 5), float3(0), float3(NAN) })
        EXPECT_NEAR(seen(up), expected, 2e-3 * expected);
}

TEST(AreaLightUnits, TheFluxOfALightIsPiTimesLuminanceTimesArea) {
    const float pi = std::numbers::pi_v<float>;
    EXPECT_FLOAT_EQ(luminanceFromFlux(Lumen{ 600 * pi }, RectLight{ .widthMeters = 2, .heightMeters = 3 }).value, 100);
    EXPECT_FLOAT_EQ(
            luminanceFromFlux(Lumen{ 600 * pi }, RectLight{ .widthMeters = 2, .heightMeters = 3, .isTwoSided = true })
                    .value,
            50);
    EXPECT_FLOAT_EQ(luminanceFromFlux(Lumen{ 4 * pi * pi }, DiscLight{ .radiusMeters = 2 }).value, 1);
    EXPECT_FLOAT_EQ(luminanceFromFlux(Lumen{ 4 * pi * pi }, TubeLight{ .lengthMeters = 4, .radiusMeters = 0.5f }).value,
                    1);
    EXPECT_EQ(luminanceFromFlux(Lumen{ 100 }, RectLight{ .widthMeters = 0 }).value, 0);
    EXPECT_EQ(luminanceFromFlux(Lumen{ 100 }, DiscLight{ .radiusMeters = 0 }).value, 0);
}

} // namespace
} // namespace filament_core
