// SPDX-License-Identifier: Apache-2.0
// Pictures through the public API: from files and memory, as textures with mips on both APIs.
#include "base/math/Half.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <glm/gtc/matrix_transform.hpp>

#include <filament_core/BuiltInMaterials.h>
#include <filament_core/Color.h>
#include <filament_core/Image.h>
#include <filament_core/TexelBytes.h>

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <random>

namespace filament_core {
namespace {

Image imageOf(Format format, uint2 size, size_t bytesPerPixel) {
    Image image{ .width = size.x, .height = size.y, .format = format };
    image.pixels.resize(size_t{ size.x } * size.y * bytesPerPixel);
    return image;
}

Image noisyImage(Format format, uint2 size) {
    Image image = imageOf(format, size, 4);
    std::mt19937 random(5);
    for (std::byte& code : image.pixels) code = static_cast<std::byte>(random());
    return image;
}

std::vector<std::byte> bytesOf(std::filesystem::path const& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<char> text{ std::istreambuf_iterator<char>(file), {} };
    const auto bytes = std::as_bytes(std::span(text));
    return { bytes.begin(), bytes.end() };
}

/// Both forms of loadImage(), which must agree.
Image loadedFrom(std::filesystem::path const& path, ImageLoadOptions const& options = {}) {
    Result<Image> image = loadImage(path, options);
    const Result<Image> again = loadImage(bytesOf(path), "memory", options);
    EXPECT_TRUE(image) << (image ? "" : image.error().message);
    EXPECT_TRUE(again) << (again ? "" : again.error().message);
    if (!image || !again) return {};
    EXPECT_EQ(image->pixels, again->pixels);
    EXPECT_EQ(image->format, again->format);
    return std::move(*image);
}

TEST(LoadImage, GivesTheCodesOfAPngAsColorsOrAsData) {
    const std::filesystem::path path = test::folderOfThisTest() / "noise.png";
    for (const Format saved : { Format::RGBA8, Format::RGBA8Srgb }) {
        const Image image = noisyImage(saved, { 13, 5 });
        ASSERT_TRUE(savePng(path, image));
        for (const ImageContent content : { ImageContent::Color, ImageContent::Data }) {
            const Image loaded = loadedFrom(path, { .content = content });
            EXPECT_EQ(loaded.format, content == ImageContent::Color ? Format::RGBA8Srgb : Format::RGBA8);
            EXPECT_EQ(uint2(loaded.width, loaded.height), uint2(13, 5));
            EXPECT_EQ(loaded.pixels, image.pixels);
        }
    }
}

TEST(LoadImage, KeepsSixteenBits) {
    Image image = imageOf(Format::RGB10A2, { 32, 32 }, 4);
    for (uint32_t code = 0; code < 1024; ++code) {
        const uint32_t word = code | (1023 - code) << 10 | (code / 2) << 20;
        std::memcpy(&image.pixels[size_t{ code } * 4], &word, sizeof(word));
    }
    const std::filesystem::path path = test::folderOfThisTest() / "ramp.png";
    ASSERT_TRUE(savePng(path, image));
    const auto share = [](uint32_t code) { return static_cast<float>((code * 65535 + 511) / 1023) / 65535.0f; };
    const Image full = loadedFrom(path, { .content = ImageContent::Data, .fullFloats = true });
    const Image halves = loadedFrom(path, { .content = ImageContent::Data });
    const Image light = loadedFrom(path);
    ASSERT_EQ(full.format, Format::RGBA32F);
    ASSERT_EQ(halves.format, Format::RGBA16F);
    ASSERT_EQ(light.format, Format::RGBA16F);
    for (uint32_t code = 0; code < 1024; ++code) {
        float4 exact;
        std::memcpy(&exact, &full.pixels[size_t{ code } * 16], sizeof(exact));
        EXPECT_EQ(exact, float4(share(code), share(1023 - code), share(code / 2), 1));
        const uint32_t x = code % 32, y = code / 32;
        for (int c = 0; c < 4; ++c) EXPECT_EQ(test::halfPixel(halves, x, y)[c], floatFromHalf(halfFromFloat(exact[c])));
        const float linear = color::linearFromSrgb(float3(share(code))).x;
        EXPECT_EQ(test::halfPixel(light, x, y).x, floatFromHalf(halfFromFloat(linear)));
        EXPECT_EQ(test::halfPixel(light, x, y).w, 1);
    }
}

TEST(LoadImage, GivesTheFloatsOfAnExr) {
    Image image = imageOf(Format::RGBA16F, { 3, 2 }, 8);
    for (size_t i = 0; i < 24; ++i) {
        const uint16_t half = i % 4 == 3 ? halfFromFloat(1) : halfFromFloat(std::pow(10.0f, static_cast<float>(i) / 6));
        std::memcpy(&image.pixels[i * 2], &half, sizeof(half));
    }
    const std::filesystem::path path = test::folderOfThisTest() / "light.exr";
    ASSERT_TRUE(saveExr(path, image));
    for (const ImageContent content : { ImageContent::Color, ImageContent::Data }) {
        const Image loaded = loadedFrom(path, { .content = content });
        EXPECT_EQ(loaded.format, Format::RGBA16F);
        EXPECT_EQ(loaded.pixels, image.pixels) << "light is what it is";
    }
    EXPECT_EQ(loadedFrom(path, { .fullFloats = true }).format, Format::RGBA32F);
}

TEST(LoadImage, SaysWhyThereIsNone) {
    const std::filesystem::path folder = test::folderOfThisTest(), path = folder / "broken.png";
    const auto message = [](Result<Image> const& image) { return image ? std::string() : image.error().message; };
    EXPECT_EQ(loadImage(folder / "absent.png").error().code, ErrorCode::NotFound);
    EXPECT_THAT(message(loadImage(folder / "absent.png")), testing::HasSubstr((folder / "absent.png").string()));
    EXPECT_EQ(loadImage(folder).error().code, ErrorCode::Unreadable);
    ASSERT_TRUE(savePng(path, noisyImage(Format::RGBA8, { 9, 9 })));
    std::vector<std::byte> bytes = bytesOf(path);
    bytes.resize(bytes.size() / 2);
    EXPECT_EQ(message(loadImage(bytes, "half.png")),
              "image 'half.png' cannot be decoded: the file is cut short; export it again");
    constexpr std::string_view kText = "GIF89a is something else";
    const Result<Image> text = loadImage(std::as_bytes(std::span(kText)), "a.gif");
    EXPECT_EQ(text.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(message(text),
              "image 'a.gif' is none of PNG, JPEG, WebP, AVIF, KTX2, DDS, HDR and EXR; convert it to one of them");
    EXPECT_EQ(message(loadImage({}, "nothing")),
              "image 'nothing' is none of PNG, JPEG, WebP, AVIF, KTX2, DDS, HDR and EXR; convert it to one of "
              "them");
}

/// One colour everywhere, in a format of loadImage().
Image plainImage(Format format, float4 color) {
    const bool isCode = format == Format::RGBA8 || format == Format::RGBA8Srgb;
    Image image = imageOf(format, { 21, 13 }, isCode ? 4 : format == Format::RGBA16F ? 8 : 16);
    for (size_t i = 0, at = 0; at < image.pixels.size(); ++i) {
        const float value = color[static_cast<int>(i % 4)];
        const uint16_t half = halfFromFloat(value);
        const auto code = static_cast<uint8_t>(std::lround(value * 255));
        const size_t bytes = isCode ? 1 : format == Format::RGBA16F ? 2 : 4;
        std::memcpy(&image.pixels[at],
                    isCode       ? static_cast<void const*>(&code)
                    : bytes == 2 ? static_cast<void const*>(&half)
                                 : &value,
                    bytes);
        at += bytes;
    }
    return image;
}

TEST(TextureOf, AnImageIsDrawnWithItsMipsAlikeOnBothApis) {
    for (const Format format : { Format::RGBA8Srgb, Format::RGBA8, Format::RGBA16F, Format::RGBA32F }) {
        const Image image = plainImage(format, { 0.2f, 0.4f, 0.8f, 1 });
        const Image seen = test::onBothApis([&](test::MaterialStage& stage) {
            const Texture texture = stage.own(stage.engine.create(textureOf(image, "plain")));
            const Result<Material> material = createBuiltInMaterial(stage.engine, "unlitTextured");
            ASSERT_TRUE(material) << material.error().message;
            const MaterialInstance instance = stage.keep(*material);
            EXPECT_TRUE(stage.engine.set(instance, "baseColorMap", texture));
            // A texel of level 0 is a third of a pixel wide: the smaller levels are read.
            stage.add(instance, { {} }, glm::scale(double4x4(1), double3(0.5)));
            stage.view.size = { 16, 16 };
        });
        const float4 expected = format == Format::RGBA8Srgb ? float4(color::linearFromSrgb({ 0.2f, 0.4f, 0.8f }), 1)
                                                            : float4(0.2f, 0.4f, 0.8f, 1);
        for (uint32_t y = 4; y < 12; ++y) {
            for (uint32_t x = 4; x < 12; ++x)
                EXPECT_NEAR(glm::length(test::halfPixel(seen, x, y) - expected), 0, 0.002f) << static_cast<int>(format);
        }
    }
}

TEST(TexelBytes, AreThoseOfOneTexelThatIsNotInABlock) {
    const std::pair<Format, uint32_t> sizes[] = {
        { Format::None, 0 },    { Format::R8, 1 },        { Format::RG8, 2 },     { Format::R16F, 2 },
        { Format::RGBA8, 4 },   { Format::RGBA8Srgb, 4 }, { Format::RGB10A2, 4 }, { Format::R32F, 4 },
        { Format::RGBA16F, 8 }, { Format::RGBA32F, 16 },  { Format::BC7, 0 }
    };
    for (auto const& [format, bytes] : sizes) EXPECT_EQ(texelBytes(format), bytes) << static_cast<int>(format);
}

} // namespace
} // namespace filament_core
