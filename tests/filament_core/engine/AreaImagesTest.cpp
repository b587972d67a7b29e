// SPDX-License-Identifier: Apache-2.0
// Images of rectangular area lights: white ones are plain lights, a surface nearby shows the texel in front of
// it, one far away their mean, and images are upright as seen from the front.
#include "tests/filament_core/engine/quality/QualityFixture.h"

#include <filament_core/LightImage.h>

#include <gtest/gtest.h>

namespace filament_core {
namespace {

using test::Patch;

class AreaImages : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
    }
    void TearDown() override { test::expectNoErrors(*engine); }

    Owned<LightImage> image(uint32_t width, uint32_t height, std::vector<float4> const& colors) {
        Result<LightImage> made = engine->create(LightImageDesc{ .width = width,
                                                                 .height = height,
                                                                 .format = Format::RGBA32F,
                                                                 .pixels = std::as_bytes(std::span(colors)),
                                                                 .shape = LightImageShape::Emitted });
        if (!made) ADD_FAILURE() << made.error().message;
        return made ? engine->own(*made) : Owned<LightImage>{};
    }

    decltype(test::makeEngine(Backend::Vulkan)) engine{};
};
INSTANTIATE_TEST_SUITE_P(Apis, AreaImages, testing::ValuesIn(test::kBothApis),
                         [](auto const& api) { return std::string(toString(api.param)); });

TEST_P(AreaImages, AWhiteImageIsAPlainRectangle) {
    const Owned<LightImage> white = image(1, 1, { float4(1) });
    for (const double degrees : { 0.0, 60.0 }) {
        for (const float roughness : { 0.1f, 0.8f }) {
            Patch patch(*engine, degrees);
            patch.setSurface(float4(0.8f, 0.6f, 0.4f, 1), 0.3f, roughness);
            const auto seen = [&](LightImage used) {
                const Light light =
                        patch.scene.add(RectLight{ .positionWorld = { 0.1, 0.2, 0.5 },
                                                   .directionWorld = { 0.2f, -0.1f, -1 },
                                                   .image = used,
                                                   .luminance = Nits{ 1 / patch.view.camera.exposure.factor() } });
                const Image picture = patch.render();
                patch.scene.remove(light);
                return picture;
            };
            const Image plain = seen({});
            EXPECT_GT(test::halfPixel(plain, 8, 8).x, 0.01f);
            const Image shown = seen(white);
            for (uint32_t i = 0; i < 256; ++i) { // within a unit of half floats
                const float expected = test::halfPixel(plain, i % 16, i / 16).y;
                EXPECT_NEAR(test::halfPixel(shown, i % 16, i / 16).y, expected, 1e-3f * expected) << i;
            }
        }
    }
}

/// The share of a plain light that the patch shows at the origin, from `metersAway` below a point of the rectangle.
struct Screen {
    double2 under{ 0.0 }; ///< metres from its middle, to the right and up as seen from the front
    double metersAway = 1;
    float roughness = 1, metallic = 0;
};
float3 shareOf(Engine& engine, LightImage image, Screen const& screen) {
    Patch patch(engine);
    patch.setSurface(float4(1), screen.metallic, screen.roughness);
    const auto seen = [&](LightImage used) {
        // Shines along -z; as seen from below, with +y upwards, its right is -x.
        const Light light =
                patch.scene.add(RectLight{ .positionWorld = { screen.under.x, -screen.under.y, screen.metersAway },
                                           .directionWorld = { 0, 0, -1 },
                                           .upWorld = { 0, 1, 0 },
                                           .widthMeters = 2,
                                           .heightMeters = 2,
                                           .image = used,
                                           .luminance = Nits{ 0.1f / patch.view.camera.exposure.factor() } });
        const float3 color(patch.renderCenter());
        patch.scene.remove(light);
        return color;
    };
    return seen(image) / seen({});
}

void expectColor(float3 seen, float3 expected, float tolerance, const char* what) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], tolerance) << what << ' ' << c;
}

TEST_P(AreaImages, AMirrorShowsTheImageUprightAndASurfaceFarAwayItsMean) {
    constexpr uint32_t kSize = 32;
    const float3 corners[4] = { { 1, 0.25f, 0 }, { 0, 1, 0.25f }, { 0.25f, 0, 1 }, { 1, 1, 0.5f } };
    std::vector<float4> colors;
    for (uint32_t y = 0; y < kSize; ++y) {
        for (uint32_t x = 0; x < kSize; ++x) colors.emplace_back(corners[x / 16 + 2 * (y / 16)], 1);
    }
    const Owned<LightImage> quarters = image(kSize, kSize, colors);
    const float3 mean = 0.25f * (corners[0] + corners[1] + corners[2] + corners[3]);
    for (int i = 0; i < 4; ++i) {
        const double2 under(i % 2 == 0 ? -0.5 : 0.5, i < 2 ? 0.5 : -0.5);
        expectColor(shareOf(*engine, quarters, { under, 0.5, 0.1f, 1 }), corners[i], 0.02f, "a mirror");
        expectColor(shareOf(*engine, quarters, { under, 0.05 }), corners[i], 0.06f, "nearby");
        expectColor(shareOf(*engine, quarters, { under, 30 }), mean, 0.03f, "far away");
    }
    expectColor(shareOf(*engine, quarters, { double2(0.0), 1 }), mean, 0.02f, "in the middle");
}

} // namespace
} // namespace filament_core
