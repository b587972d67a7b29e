// SPDX-License-Identifier: Apache-2.0
// Tone mappers, output spaces, looks and vision at night: what shaders show beside what the CPU computes, on both APIs.
#include "filament_core/assets/tables/DisplayColor.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/Look.h>

#include <array>

namespace filament_core {
namespace {

constexpr ToneMapper kMappers[] = { ToneMapper::Linear,  ToneMapper::Aces,         ToneMapper::Filmic,
                                    ToneMapper::Mobile,  ToneMapper::Agx,          ToneMapper::PbrNeutral,
                                    ToneMapper::Generic, ToneMapper::DisplayRange, ToneMapper::AcesReference };

const std::array kLights{ float3(0),
                          float3(0.001f),
                          float3(0.18f),
                          float3(1, 0.2f, 0.05f),
                          float3(0.03f, 2, 9),
                          float3(300, 0.5f, 1),
                          float3(0.4f, 0.4f, 3),
                          float3(7, 7, 0.01f),
                          float3(0.2f, 5, 0.2f),
                          float3(0.7f, 0.72f, 0.75f),
                          float3(0.05f, 0.01f, 0.02f) };

using Colors = std::vector<std::array<int, 3>>;

/// Each of kLights as an RGBA8 display gets it, the same bits on both APIs.
Colors shown(View view) {
    std::vector<Colors> ofApis;
    view.size = { 4, 4 };
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        if (!engine) return Colors(kLights.size());
        const Scene scene(*engine);
        Renderer renderer(*engine);
        Colors& colors = ofApis.emplace_back();
        for (float3 const& light : kLights) {
            view.clearColor = float4(light, 1);
            auto image = renderer.renderToImage(scene, view);
            EXPECT_TRUE(image);
            const float4 pixel = image ? test::bytePixel(*image, 1, 2) * 255.0f : float4(0);
            colors.push_back({ static_cast<int>(pixel.x), static_cast<int>(pixel.y), static_cast<int>(pixel.z) });
        }
        test::expectNoErrors(*engine);
    }
    EXPECT_EQ(ofApis[0], ofApis[1]) << toString(view.display.toneMapper);
    return ofApis[0];
}

/// As the CPU computes them, in steps of 255.
std::vector<float3> computed(View const& view) {
    const assets::DisplayColor displayColor(view.display,
                                            view.effects.colorGrading.enabled ? &view.effects.colorGrading : nullptr);
    std::vector<float3> colors;
    for (float3 const& light : kLights) {
        float3 stored;
        for (int c = 0; c < 3; ++c) stored[c] = floatFromHalf(halfFromFloat(light[c])); // of the colour pass
        colors.push_back(glm::clamp(displayColor(stored), 0.0f, 1.0f) * 255.0f);
    }
    return colors;
}

void expectNear(Colors const& drawn, std::vector<float3> const& expected, float steps, std::string const& what) {
    for (size_t i = 0; i < expected.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(static_cast<float>(drawn[i][static_cast<size_t>(c)]), expected[i][c], steps)
                    << what << ", light " << i << ", component " << c;
    }
}

constexpr float kRounded = 0.65f; // half a step, and the rounding of light to 16 bits, which may be towards zero

TEST(ToneMappers, ShadersShowWhatTheCpuComputes) {
    for (const ToneMapper mapper : kMappers) {
        View view;
        view.display.toneMapper = mapper;
        // The ACES transforms come from a table, whose entries are 1/4 of a stop apart.
        const float steps = mapper == ToneMapper::AcesReference ? 6 : kRounded;
        expectNear(shown(view), computed(view), steps, toString(mapper));
    }
}

TEST(ToneMappers, LooksOfAgxAndPointsOfTheGenericCurveReachTheShaders) {
    View view;
    view.display.toneMapper = ToneMapper::Agx;
    const Colors base = shown(view);
    for (const AgxLook look : { AgxLook::Golden, AgxLook::Punchy }) {
        view.display.agxLook = look;
        const Colors drawn = shown(view);
        EXPECT_NE(drawn, base);
        expectNear(drawn, computed(view), kRounded, toString(look));
    }
    view.display.toneMapper = ToneMapper::Generic;
    view.display.toneCurve = { .contrast = 2, .midGreyIn = 0.2f, .midGreyOut = 0.3f, .maximum = 50 };
    expectNear(shown(view), computed(view), kRounded, "curve");
}

TEST(ToneMappers, TablesHaveTheColoursOfTheFormulas) {
    for (const ToneMapper mapper : kMappers) {
        if (mapper == ToneMapper::DisplayRange) continue; // its colours do not follow light evenly
        View view;
        view.display.toneMapper = mapper;
        view.quality.toneMapping = ToneMapping::Table64;
        const bool hasKink = mapper == ToneMapper::Linear || mapper == ToneMapper::PbrNeutral;
        expectNear(shown(view), computed(view), hasKink ? 8 : 6, toString(mapper));
    }
}

TEST(OutputSpaces, ShadersShowWhatTheCpuComputes) {
    for (const OutputSpace space : { OutputSpace::LinearRec709, OutputSpace::DisplayP3, OutputSpace::Rec2020Pq }) {
        for (const ToneMapper mapper : { ToneMapper::Linear, ToneMapper::Aces, ToneMapper::Mobile, ToneMapper::Agx }) {
            View view;
            view.display = { .toneMapper = mapper, .outputSpace = space, .whiteNits = 250 };
            expectNear(shown(view), computed(view), kRounded, toString(space));
        }
    }
}

TEST(OutputSpaces, OnesOfTablesAreThoseOfFormulas) {
    for (const OutputSpace space : { OutputSpace::DisplayP3, OutputSpace::Rec2020Pq }) {
        View view;
        view.display = { .toneMapper = ToneMapper::Filmic, .outputSpace = space };
        view.quality.toneMapping = ToneMapping::Table64;
        expectNear(shown(view), computed(view), 3, toString(space));
    }
}

TEST(OutputSpaces, LightStaysRec709) {
    auto engine = test::makeEngine(Backend::Vulkan);
    ASSERT_TRUE(engine);
    View view{ .size = { 4, 4 }, .clearColor = float4(0.5f, 0.25f, 4, 1) };
    view.display.outputSpace = OutputSpace::Rec2020Pq;
    EXPECT_EQ(float3(test::halfPixel(test::renderLinear(*engine, Scene(*engine), view), 1, 1)), float3(0.5f, 0.25f, 4));
}

std::shared_ptr<const Look> inverse() {
    return std::make_shared<Look>(Look{ .isCube = false, .size = 2, .entries = { float3(1), float3(0) } });
}

TEST(Looks, AreAppliedToWhatTheToneMapperShows) {
    for (const ToneMapper mapper : { ToneMapper::Filmic, ToneMapper::AcesReference }) {
        View view;
        view.display = { .toneMapper = mapper, .look = inverse() };
        const Colors drawn = shown(view);
        expectNear(drawn, computed(view), mapper == ToneMapper::Filmic ? 2 : 6, "inverse");
        view.display.look = nullptr;
        view.quality.toneMapping = ToneMapping::Table64;
        const Colors plain = shown(view);
        for (size_t i = 0; i < plain.size(); ++i)
            for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(drawn[i][c], 255 - plain[i][c], 1);
    }
}

TEST(Looks, ManyAfterEachOtherKeepTheirColours) {
    auto engine = test::makeEngine(Backend::Vulkan);
    ASSERT_TRUE(engine);
    Renderer renderer(*engine);
    const Scene scene(*engine);
    View view{ .size = { 4, 4 }, .clearColor = float4(0.18f, 0.18f, 0.18f, 1) };
    view.quality.toneMapping = ToneMapping::Table16;
    for (int i = 0; i < 20; ++i) {
        const float value = static_cast<float>(i % 7) / 8;
        view.display.look =
                std::make_shared<Look>(Look{ .isCube = false, .size = 2, .entries = { float3(value), float3(value) } });
        auto image = renderer.renderToImage(scene, view);
        ASSERT_TRUE(image);
        EXPECT_NEAR(test::bytePixel(*image, 1, 1).x, value, 0.003f) << i;
    }
    test::expectNoErrors(*engine);
}

TEST(NightVision, ShadersShowWhatTheCpuComputes) {
    for (const float amount : { 0.3f, 1.0f }) {
        View view;
        view.display.toneMapper = ToneMapper::Filmic;
        view.effects.colorGrading = { .enabled = true, .nightAdaptation = amount, .exposure = -1 };
        const Colors drawn = shown(view);
        expectNear(drawn, computed(view), kRounded + 0.1f, "night");
        EXPECT_GT(drawn[1][2], drawn[1][0]) << "dark greys are blue";
        view.quality.toneMapping = ToneMapping::Table64;
        expectNear(shown(view), computed(view), 8, "table");
    }
}

TEST(NightVision, OffChangesNoBit) {
    View view;
    view.effects.colorGrading = { .enabled = true, .contrast = 1.2f };
    const Colors without = shown(view);
    view.effects.colorGrading.nightAdaptation = 1;
    EXPECT_NE(shown(view), without);
    view.effects.colorGrading.enabled = false;
    EXPECT_EQ(shown(view), shown(View{}));
}

} // namespace
} // namespace filament_core
