// SPDX-License-Identifier: Apache-2.0
// Images whose colours are multiplied by alpha, and their straight colours.
#include <filament_core/StraightAlpha.h>

#include "tests/filament_core/engine/postprocess/PassStage.h"

#include <cmath>
#include <cstring>

namespace filament_core {
namespace {

using test::bytePixel;
using test::PassStage;

/// IEC 61966-2-1.
double lightOf(double code) { return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4); }
double codeOf(double light) { return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055; }

/// All codes in one row for each alpha: red counts up, green down.
Image everyCode() {
    Image image{ .width = 256, .height = 256, .pixels = std::vector<std::byte>(256 * 256 * 4) };
    for (uint32_t i = 0; i < 256 * 256; ++i) {
        image.pixels[4 * i] = static_cast<std::byte>(i % 256), image.pixels[4 * i + 1] = std::byte(255 - i % 256);
        image.pixels[4 * i + 3] = static_cast<std::byte>(i / 256);
    }
    return image;
}

TEST(StraightAlpha, IsTheLightOfACodeDividedByAlphaToTheNearestCode) {
    for (const Format format : { Format::RGBA8, Format::RGBA8Srgb }) {
        Image given = everyCode();
        given.format = format;
        const Image straight = straightAlpha(given);
        EXPECT_EQ(straight.format, format);
        for (uint32_t alpha = 1; alpha < 256; ++alpha) {
            for (uint32_t code = 0; code < 256; ++code) {
                const float4 seen = 255.0f * bytePixel(straight, code, alpha);
                const double exact = 255 * codeOf(std::min(lightOf(code / 255.0) * 255 / alpha, 1.0));
                ASSERT_NEAR(seen.x, exact, 0.501) << code << " of " << alpha;
                ASSERT_EQ(std::lround(seen.w), alpha);
            }
        }
    }
}

TEST(StraightAlpha, OfOpaqueTexelsIsTheCodeAndOfClearOnesBlack) {
    const Image given = everyCode(), straight = straightAlpha(given);
    for (uint32_t code = 0; code < 256; ++code) {
        EXPECT_EQ(bytePixel(straight, code, 255), bytePixel(given, code, 255));
        EXPECT_EQ(bytePixel(straight, code, 0), float4(0));
    }
}

TEST(StraightAlpha, OfNumbersIsTheQuotient) {
    const std::array<float4, 4> texels{
        { { 0.25f, -0.5f, 3, 0.5f }, { 1, 2, 3, 1 }, { 4, 5, 6, 0 }, { 60000, 0, 0, 0.5f } }
    };
    Image floats{
        .width = 4, .height = 1, .format = Format::RGBA32F, .pixels = std::vector<std::byte>(sizeof(texels))
    };
    std::memcpy(floats.pixels.data(), texels.data(), sizeof(texels));
    Image halves{ .width = 4, .height = 1, .format = Format::RGBA16F };
    for (float4 const& texel : texels) {
        for (int c = 0; c < 4; ++c) {
            const uint16_t half = halfFromFloat(texel[c]);
            halves.pixels.push_back(static_cast<std::byte>(half & 255));
            halves.pixels.push_back(static_cast<std::byte>(half >> 8));
        }
    }
    const Image divided = straightAlpha(floats), dividedHalves = straightAlpha(halves);
    std::array<float4, 4> seen;
    std::memcpy(seen.data(), divided.pixels.data(), sizeof(seen));
    EXPECT_EQ(seen[0], float4(0.5f, -1, 6, 0.5f));
    EXPECT_EQ(seen[1], float4(1, 2, 3, 1));
    EXPECT_EQ(seen[2], float4(0));
    EXPECT_EQ(seen[3], float4(120000, 0, 0, 0.5f));
    for (uint32_t i = 0; i < 3; ++i) EXPECT_EQ(test::halfPixel(dividedHalves, i, 0), seen[i]) << i;
    EXPECT_EQ(test::halfPixel(dividedHalves, 3, 0), float4(65504, 0, 0, 0.5f)) << "the largest half";
}

struct StraightFrameTest : testing::TestWithParam<Backend>, PassStage {
    StraightFrameTest() : PassStage(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(BothApis, StraightFrameTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

// A surface that covers a half, and the edges of opaque ones, have the colours of the surface where it is opaque.
TEST_P(StraightFrameTest, PixelsThatAreCoveredInPartHaveTheColourOfTheirSurface) {
    constexpr float4 kColor(0.25f, 0.5f, 0.125f, 1);
    view.display.toneMapper = ToneMapper::Linear;
    view.clearColor = float4(0);
    view.samples = 4;
    Scene opaque(engine), half(engine);
    const Owned<MaterialInstance> whole = engine.own(engine.createInstance(solid)),
                                  part = engine.own(engine.createInstance(flat));
    ASSERT_TRUE(engine.set(whole, "color", kColor) && engine.set(part, "color", 0.5f * kColor));
    square.add(opaque, whole, { 0.03, 0.02, 0 }, 0.7);
    square.add(half, part, { 0.03, 0.02, 0 }, 0.7);
    const std::array<int, 3> codes{ 137, 188, 99 }; // of 0.25, 0.5, 0.125
    uint32_t covered = 0, edges = 0;
    for (Scene const* shown : { &opaque, &half }) {
        auto image = renderer.renderToImage(*shown, view);
        ASSERT_TRUE(image);
        const Image straight = straightAlpha(*std::move(image));
        for (uint32_t i = 0; i < test::kPassSide * test::kPassSide; ++i) {
            const float4 seen = 255.0f * bytePixel(straight, i % test::kPassSide, i / test::kPassSide);
            if (seen.w < 30) continue;
            ++covered;
            edges += shown == &opaque && seen.w < 250;
            for (size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(seen[static_cast<int>(c)], codes[c], seen.w > 120 ? 1.01f : 3.01f) << i << ", " << seen.w;
        }
    }
    EXPECT_GT(covered, 100u);
    EXPECT_GT(edges, 4u);
}

} // namespace
} // namespace filament_core
