// SPDX-License-Identifier: Apache-2.0
// DebugView::Luminance and Numerics on both APIs: images whose numbers come texel by texel from a texture.
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/DebugViews.h>

#include <array>
#include <bit>
#include <cmath>
#include <functional>

namespace filament_core {
namespace {

/// Each pixel is the texel at its place.
constexpr const char* kTexelMaterial = R"(material { name : texels, shadingModel : unlit, culling : none,
    parameters : [ { name : map, type : sampler2d, precision : high } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor = texelFetch(materialParams_map, ivec2(gl_FragCoord.xy), 0);
} })";

struct Numbers {
    uint32_t width = 0, height = 0;
    std::vector<float4> texels{};
};

/// Images by `draw` of the numbers on each API, which have the same bits.
Image numbersDrawn(Numbers const& numbers, std::function<Image(test::MaterialStage&, Renderer&)> const& draw) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        std::optional<Engine> engine = test::makeEngine(backend);
        if (!engine) return {};
        {
            test::MaterialStage stage(*engine);
            Renderer renderer(*engine);
            stage.view.size = { numbers.width, numbers.height };
            const MaterialInstance instance = stage.material(kTexelMaterial);
            const Texture map =
                    stage.own(engine->create(TextureDesc{ .format = Format::RGBA32F,
                                                          .width = numbers.width,
                                                          .height = numbers.height,
                                                          .pixels = std::as_bytes(std::span(numbers.texels)) }));
            EXPECT_TRUE(
                    engine->set(instance, "map", map, Sampler{ Filter::Nearest, Filter::Nearest, MipFilter::None }));
            stage.add(instance, { test::Square{ .halfSide = 100 } });
            images.push_back(draw(stage, renderer));
        }
        test::expectNoErrors(*engine);
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    return std::move(images[0]);
}

Image numbersShown(Numbers const& numbers, DebugView debugView) {
    return numbersDrawn(numbers, [&](test::MaterialStage& stage, Renderer& renderer) {
        stage.view.debugView = debugView;
        Result<Image> image = renderer.renderToImage(stage.scene, stage.view);
        EXPECT_TRUE(image);
        return image ? std::move(*image) : Image{};
    });
}

DebugColor codesOfPixel(Image const& image, size_t pixel) {
    const auto code = [&](size_t c) { return std::to_integer<uint8_t>(image.pixels[4 * pixel + c]); };
    return { code(0), code(1), code(2) };
}

// ---- luminance

TEST(DebugLuminance, IsInStopsFromMiddleGrey) {
    Numbers numbers{ .height = 4 };
    std::vector<int> expected;
    for (int stops = -12; stops <= 12; ++stops) {
        for (const double off : { -0.45, -0.2, 0.0, 0.2, 0.45 }) {
            expected.push_back(stops);
            numbers.texels.emplace_back(float3(static_cast<float>(0.18 * std::exp2(stops + off))), 1);
        }
    }
    numbers.width = static_cast<uint32_t>(expected.size());
    const auto grey = numbers.texels;
    const float3 weights(0.2126f, 0.7152f, 0.0722f); // of Rec. 709: one channel alone has the same luminance
    for (int channel = 0; channel < 3; ++channel) {
        for (float4 const& texel : grey) {
            float4 one(0, 0, 0, 1);
            one[channel] = texel.x / weights[channel];
            numbers.texels.push_back(one);
        }
    }
    const Image image = numbersShown(numbers, DebugView::Luminance);
    ASSERT_EQ(image.pixels.size(), 4 * numbers.texels.size());
    for (size_t i = 0; i < numbers.texels.size(); ++i)
        EXPECT_EQ(codesOfPixel(image, i), luminanceColor(expected[i % numbers.width]))
                << expected[i % numbers.width] << " stops, row " << i / numbers.width;
}

TEST(DebugLuminance, OfNothingAndOfNoNumberIsBlack) {
    const float nan = std::nanf("");
    const Numbers numbers{ .width = 4,
                           .height = 1,
                           .texels = { float4(0), float4(-1, -1, -1, 1), float4(nan, nan, nan, 1),
                                       float4(0, 0, 0, 1) } };
    const Image image = numbersShown(numbers, DebugView::Luminance);
    for (size_t i = 0; i < 4; ++i) EXPECT_EQ(codesOfPixel(image, i), (DebugColor{ 0, 0, 0 })) << i;
}

// ---- numerics

/// Every exponent with both signs and the smallest, some and the largest fraction, in each channel.
Numbers everyKindOfNumber() {
    Numbers numbers{ .width = 256 };
    for (const uint32_t fraction : { 0u, 1u, 0x3FFFFFu, 0x7FE000u, 0x7FE001u, 0x7FFFFFu }) {
        for (const uint32_t sign : { 0u, 1u }) {
            for (int channel = 0; channel < 3; ++channel) {
                for (uint32_t exponent = 0; exponent < 256; ++exponent) {
                    float4 texel(0, 0, 0, 1);
                    texel[channel] = std::bit_cast<float>(sign << 31 | exponent << 23 | fraction);
                    numbers.texels.push_back(texel);
                }
                ++numbers.height;
            }
        }
    }
    return numbers;
}

/// By the C library; without what the display clips.
NumericsMark markOf(float value) {
    if (std::isnan(value)) return NumericsMark::NotANumber;
    if (std::isinf(value)) return NumericsMark::Infinite;
    if (std::abs(value) > 65504) return NumericsMark::OutOfRange;
    return value != 0 && std::abs(value) < std::ldexp(1.0f, -14) ? NumericsMark::Denormal : NumericsMark::None;
}

NumericsMark markOf(float4 texel) {
    NumericsMark most = NumericsMark::None;
    for (int c = 0; c < 4; ++c) most = std::max(most, markOf(texel[c]));
    return most;
}

bool isFull(DebugColor color) { return color[0] == 255 || color[1] == 255 || color[2] == 255; }

TEST(DebugNumerics, MarksEveryKindOfNumberAndNothingElse) {
    const Numbers numbers = everyKindOfNumber();
    const Image image = numbersShown(numbers, DebugView::Numerics), picture = numbersShown(numbers, DebugView::None);
    ASSERT_EQ(image.pixels.size(), 4 * numbers.texels.size());
    NumericsCounts expected{};
    for (size_t i = 0; i < numbers.texels.size(); ++i) {
        NumericsMark mark = markOf(numbers.texels[i]);
        if (mark < NumericsMark::Clipped && isFull(codesOfPixel(picture, i))) mark = NumericsMark::Clipped;
        ++expected[static_cast<size_t>(mark)];
        ASSERT_EQ(numericsMarkOf(codesOfPixel(image, i)), mark)
                << numbers.texels[i].x << ' ' << numbers.texels[i].y << ' ' << numbers.texels[i].z;
    }
    for (size_t i = 0; i < kNumericsMarks; ++i)
        EXPECT_GE(expected[i], 6u) << toString(static_cast<NumericsMark>(i)) << " is among what is tested";
    EXPECT_EQ(countNumerics(image.pixels), expected);
}

TEST(DebugNumerics, ShowsOfAPixelTheWorst) {
    const float inf = HUGE_VALF, nan = std::nanf(""), many = 1e6f, little = 1e-6f;
    const std::array worst{ std::pair(float4(many, inf, nan, 1), NumericsMark::NotANumber),
                            std::pair(float4(inf, many, little, 1), NumericsMark::Infinite),
                            std::pair(float4(little, 100, many, 1), NumericsMark::OutOfRange),
                            std::pair(float4(60000, little, 0, 1), NumericsMark::Clipped),
                            std::pair(float4(0.1f, little, 0.2f, 1), NumericsMark::Denormal),
                            std::pair(float4(0.1f, 0, 0.2f, 1), NumericsMark::None) };
    Numbers numbers{ .width = worst.size(), .height = 1 };
    for (auto const& [texel, mark] : worst) numbers.texels.push_back(texel);
    const Image image = numbersShown(numbers, DebugView::Numerics);
    for (size_t i = 0; i < worst.size(); ++i) EXPECT_EQ(numericsMarkOf(codesOfPixel(image, i)), worst[i].second) << i;
}

/// A target of light: no display clips it, and the marks are the light of their colours.
TEST(DebugNumerics, ClipsNothingInTargetsOfLight) {
    const Numbers numbers{ .width = 2, .height = 1, .texels = { float4(60000, 0, 0, 1), float4(1e6f, 0, 0, 1) } };
    const Image image = numbersDrawn(numbers, [](test::MaterialStage& stage, Renderer&) {
        stage.view.debugView = DebugView::Numerics;
        return test::renderLinear(stage.engine, stage.scene, stage.view);
    });
    const float4 grey = test::halfPixel(image, 0, 0), mark = test::halfPixel(image, 1, 0);
    EXPECT_EQ(grey.x, grey.y);
    EXPECT_NEAR(mark.x, std::pow((230 / 255.0 + 0.055) / 1.055, 2.4), 1e-3);
    EXPECT_NEAR(mark.z, 0, 1e-6);
}

/// Only this view has the values that half floats round away: the normal image does not change.
TEST(DebugNumerics, LeavesTheNextPictureAsItWas) {
    const Numbers numbers = everyKindOfNumber();
    std::vector<std::vector<std::byte>> pictures;
    numbersDrawn(numbers, [&](test::MaterialStage& stage, Renderer& renderer) {
        Image last;
        for (const DebugView view : { DebugView::None, DebugView::Numerics, DebugView::Luminance, DebugView::None }) {
            stage.view.debugView = view;
            Result<Image> image = renderer.renderToImage(stage.scene, stage.view);
            EXPECT_TRUE(image);
            if (image) last = std::move(*image);
            if (view == DebugView::None) pictures.push_back(last.pixels);
        }
        return last;
    });
    for (auto const& picture : pictures) EXPECT_EQ(picture, pictures[0]);
}

} // namespace
} // namespace filament_core
