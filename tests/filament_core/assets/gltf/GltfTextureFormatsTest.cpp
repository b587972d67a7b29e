// SPDX-License-Identifier: Apache-2.0
// KHR_texture_basisu, EXT_texture_astc, EXT_texture_webp, EXT_texture_avif and MSFT_texture_dds: which image a texture
// reads, and what of it reaches the model.
#include "base/math/Half.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "filament_core/assets/image/Ktx2File.h"
#include "tests/filament_core/assets/blocks/BasisWriter.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "tests/filament_core/assets/image/AvifFile.h"
#include "tests/filament_core/assets/image/DdsWriter.h"
#include "tests/filament_core/assets/image/Ktx2Writer.h"
#include "tests/filament_core/assets/image/PictureFiles.h"

#include <filament_core/Color.h>

#include <gmock/gmock.h>

#include <array>
#include <cstring>

namespace filament_core::assets::test {
namespace {

using backend::Format;
using testing::ElementsAre;
using testing::HasSubstr;

/// Lossless WebP of 1 x 1 pixels of (10, 20, 30, 255): cwebp -lossless
constexpr std::array<uint8_t, 38> kWebpPixel{ 0x52, 0x49, 0x46, 0x46, 0x1E, 0x00, 0x00, 0x00, 0x57, 0x45,
                                              0x42, 0x50, 0x56, 0x50, 0x38, 0x4C, 0x11, 0x00, 0x00, 0x00,
                                              0x2F, 0x00, 0x00, 0x00, 0x00, 0x07, 0x50, 0x8A, 0x2A, 0xD4,
                                              0xA3, 0xFF, 0x81, 0x88, 0xE8, 0x7F, 0x00, 0x00 };

Bytes pngPixel(uint8_t grey) {
    const std::array<uint8_t, 4> pixel{ grey, grey, grey, 255 };
    return glbImageFromPixels("image", 1, 1, std::as_bytes(std::span(pixel)))->file;
}

/// Levels of UASTC whose blocks are of one colour: red is 100 and less for each level.
Ktx2Writer uastcOf(uint32_t side, uint32_t levels, uint8_t transfer = Ktx2Description::kSrgb) {
    Ktx2Writer file{ .format = 0,
                     .width = side,
                     .height = side,
                     .model = Ktx2Description::kUastc,
                     .transfer = transfer,
                     .channels = { 3 } };
    for (uint32_t level = 0; level < levels; ++level) {
        const uint32_t blocks = std::max(side >> level, 4u) / 4;
        BasisBitWriter writer;
        for (uint32_t i = 0; i < blocks * blocks; ++i) {
            writer.put(0x17, 5); // mode 8: one colour
            for (const uint32_t code : { 100 - 10 * level, 50u, 20u, 200u }) writer.put(code, 8);
            for (int k = 0; k < 91; k += 7) writer.put(0, 7);
        }
        file.levels.push_back(writer.bytes);
    }
    return file;
}

/// A triangle with one material; its base colour, or its occlusion, is a texture with this JSON.
TestFile texturedBy(std::vector<Bytes> const& images, const char* texture, bool isColor = true) {
    TestFile file = TestFile::triangle();
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    for (Bytes const& image : images) file.root["images"].push_back({ { "bufferView", file.addView(image) } });
    file.root["textures"] = { Json::parse(texture) };
    Json material;
    if (isColor)
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    else
        material["occlusionTexture"]["index"] = 0;
    file.root["materials"] = { material };
    file.root["extensionsUsed"] = { "KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif", "EXT_texture_astc",
                                    "MSFT_texture_dds" };
    file.primitive()["material"] = 0;
    return file;
}

/// A texel of ASTC: a block of one colour (void extent), of 16 bits a channel.
Bytes astcOf(uint8_t red, uint32_t format = 158) {
    Bytes block{ std::byte{ 0xFC }, std::byte{ 0xFD } };
    block.resize(8, std::byte{ 0xFF });
    for (const uint8_t code : { red, uint8_t{ 0 }, uint8_t{ 0 }, uint8_t{ 255 } })
        block.insert(block.end(), 2, static_cast<std::byte>(code));
    return Ktx2Writer{
        .format = format,
        .model = 162,
        .transfer = static_cast<uint8_t>(format % 2 == 0 ? Ktx2Description::kSrgb : 1),
        .levels = { block }
    }.file();
}

Bytes ddsOf(uint8_t red) {
    return DdsWriter{ .dxgi = 28, .texels = { static_cast<std::byte>(red), {}, {}, std::byte{ 255 } } }.file();
}

constexpr const char* kAstc = R"({ "extensions": { "EXT_texture_astc": { "source": 0 } } })";
constexpr const char* kBasis = R"({ "extensions": { "KHR_texture_basisu": { "source": 0 } } })";

TEST(GltfTextureFormats, TheImageOfAnExtensionTakesThePlaceOfTheCoreOne) {
    const Bytes webp(reinterpret_cast<const std::byte*>(kWebpPixel.data()),
                     reinterpret_cast<const std::byte*>(kWebpPixel.data() + kWebpPixel.size()));
    const test::AvifFile avif{ .width = 1, .height = 1, .code = [](uint32_t, uint2) { return 60u; } };
    const std::vector<Bytes> images{ pngPixel(1), webp, uastcOf(4, 1).file(), avif.file(), astcOf(170), ddsOf(30) };
    const auto red = [&](const char* texture) {
        const ModelData model = loaded(texturedBy(images, texture));
        EXPECT_THAT(model.warnings, testing::IsEmpty());
        return model.images.size() == 1 ? std::to_integer<int>(model.images[0].data[0]) : -1;
    };
    EXPECT_EQ(red(R"({ "source": 0 })"), 1);
    EXPECT_EQ(red(R"({ "source": 0, "extensions": { "EXT_texture_webp": { "source": 1 } } })"), 10);
    EXPECT_EQ(red(R"({ "extensions": { "EXT_texture_webp": { "source": 1 } } })"), 10) << "without a fallback";
    EXPECT_EQ(red(R"({ "source": 0, "extensions": { "KHR_texture_basisu": { "source": 2 } } })"), 100);
    EXPECT_EQ(red(R"({ "source": 0, "extensions": { "EXT_texture_avif": { "source": 3 } } })"), 60);
    EXPECT_EQ(red(R"({ "source": 0, "extensions": { "EXT_texture_avif": { "source": 3 },
                                                    "EXT_texture_webp": { "source": 1 } } })"),
              10);
    EXPECT_EQ(red(R"({ "source": 0, "extensions": { "EXT_texture_webp": { "source": 1 },
                                                    "KHR_texture_basisu": { "source": 2 } } })"),
              100);
    EXPECT_EQ(red(R"({ "extensions": { "EXT_texture_astc": { "source": 4 } } })"), 170);
    EXPECT_EQ(red(R"({ "source": 0, "extensions": { "EXT_texture_astc": { "source": 4 },
                                                    "EXT_texture_webp": { "source": 1 } } })"),
              170);
    EXPECT_EQ(red(R"({ "source": 0, "extensions": { "MSFT_texture_dds": { "source": 5 } } })"), 30);
    EXPECT_EQ(red(R"({ "extensions": { "MSFT_texture_dds": { "source": 5 }, "EXT_texture_avif": { "source": 3 } } })"),
              60);
    EXPECT_EQ(red(R"({ "source": 0, "extensions": { "VENDOR_texture": { "source": 2 } } })"), 1)
            << "a format that is not read has its fallback";
}

TEST(GltfTextureFormats, EverySizeOfAstcBlocksIsRead) {
    for (uint32_t format = 157; format < 185; ++format) { // VK_FORMAT_ASTC_4x4_UNORM_BLOCK and on
        const ModelData model = loaded(texturedBy({ astcOf(90, format) }, kAstc, format % 2 == 0));
        EXPECT_THAT(model.warnings, testing::IsEmpty());
        ASSERT_EQ(model.images.size(), 1u);
        EXPECT_EQ(std::to_integer<int>(model.images[0].data[0]), 90) << format;
    }
}

// A PNG of 16 bits and an AVIF of 10 keep them in a texture of their own; two maps in one texture have 8 bits.
TEST(GltfTextureFormats, MoreThan8BitsReachTheModel) {
    const PngFile png = makePng({ .colorType = 2, .depth = 16 }, 5, 3);
    const AvifFile avif{ .width = 5, .height = 3, .depth = 10 };
    for (const bool isColor : { true, false }) {
        const ModelData model = loaded(texturedBy({ png.bytes }, R"({ "source": 0 })", isColor));
        ASSERT_EQ(model.images.size(), 1u);
        EXPECT_EQ(model.images[0].format, Format::RGBA16F);
        EXPECT_EQ(model.images[0].levels, 3u);
        uint16_t half = 0;
        std::memcpy(&half, model.images[0].data.data(), sizeof(half));
        const float share = static_cast<float>(png.deep[0]) / 65535.0f;
        EXPECT_EQ(half, halfFromFloat(isColor ? color::linearFromSrgb(float3(share)).x : share));
        const ModelData other = loaded(
                texturedBy({ avif.file() }, R"({ "extensions": { "EXT_texture_avif": { "source": 0 } } })", isColor));
        ASSERT_EQ(other.images.size(), 1u);
        EXPECT_EQ(other.images[0].format, Format::RGBA16F);
    }
}

TEST(GltfTextureFormats, TheExtensionsMayBeRequired) {
    TestFile file = texturedBy({ uastcOf(4, 1).file() }, kBasis);
    file.root["extensionsRequired"] = { "KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif" };
    EXPECT_TRUE(file.load());
}

TEST(GltfTextureFormats, AFileWithAllLevelsKeepsThem) {
    const ModelData model = loaded(texturedBy({ uastcOf(8, 4).file() }, kBasis));
    ASSERT_EQ(model.images.size(), 1u);
    Image const& image = model.images[0];
    EXPECT_EQ(image.levels, 4u);
    EXPECT_EQ(image.format, Format::RGBA8Srgb);
    for (uint32_t level = 0; level < 4; ++level)
        EXPECT_EQ(std::to_integer<uint32_t>(image.data[image.levelOffset(level)]), 100 - 10 * level);
}

TEST(GltfTextureFormats, AFileWithFewerLevelsGetsThoseOfItsFirst) {
    for (const uint32_t levels : { 1u, 2u }) {
        const ModelData model = loaded(texturedBy({ uastcOf(8, levels).file() }, kBasis));
        ASSERT_EQ(model.images.size(), 1u);
        EXPECT_EQ(model.images[0].levels, 4u);
        EXPECT_EQ(std::to_integer<int>(model.images[0].data[model.images[0].levelOffset(2)]), 100);
    }
}

TEST(GltfTextureFormats, ALimitOfSizesStartsWithASmallerLevel) {
    for (const uint32_t levels : { 1u, 4u }) {
        const Result<ModelData> model = texturedBy({ uastcOf(8, levels).file() }, kBasis).load({ .maxTextureSize = 2 });
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_EQ(model->images[0].width, 2u);
        EXPECT_EQ(model->images[0].levels, 2u);
        EXPECT_EQ(std::to_integer<int>(model->images[0].data[0]), levels == 1 ? 100 : 80);
    }
}

TEST(GltfTextureFormats, AFileThatContradictsItsUseIsNamed) {
    const ModelData model = loaded(texturedBy({ uastcOf(4, 1, Ktx2Description::kLinear).file() }, kBasis));
    EXPECT_EQ(model.images[0].format, Format::RGBA8Srgb);
    EXPECT_THAT(model.warnings,
                ElementsAre("images[0] is used for colours, but its file says that it is linear; the use counts"));
    const ModelData data = loaded(texturedBy({ uastcOf(4, 1).file() }, kBasis, false));
    EXPECT_EQ(data.images[0].format, Format::RGBA8);
    EXPECT_THAT(data.warnings,
                ElementsAre("images[0] is used for data, but its file says that it is sRGB; the use counts"));
    EXPECT_THAT(loaded(texturedBy({ uastcOf(4, 1, Ktx2Description::kLinear).file() }, kBasis, false)).warnings,
                testing::IsEmpty());
}

TEST(GltfTextureFormats, WhatMaterialsDoNotReadIsAnError) {
    const auto refusal = [](Bytes const& image) {
        const Result<ModelData> model = texturedBy({ image }, kBasis).load();
        return model ? std::string() : model.error().message;
    };
    Ktx2Writer cube{ .width = 4, .height = 4, .faces = 6, .levels = { Bytes(4 * 4 * 4 * 6) } };
    EXPECT_THAT(refusal(cube.file()), HasSubstr("image 'images[0]' is a cube; export it as a two-dimensional texture"));
    Ktx2Writer deep{ .format = 91, .width = 1, .height = 1, .levels = { Bytes(8) } };
    EXPECT_THAT(refusal(deep.file()),
                HasSubstr("has more than 8 bits a channel, which materials of models do not read"));
    EXPECT_THAT(refusal(Bytes(30, std::byte{ 1 })),
                HasSubstr("is none of PNG, JPEG, WebP, AVIF, KTX2 and DDS; convert it to one of them"));
    Bytes cut = uastcOf(4, 1).file();
    cut.pop_back();
    EXPECT_THAT(refusal(cut), HasSubstr("image 'images[0]' cannot be decoded: its level 0 is 16 bytes from byte"));
}

TEST(GltfTextureFormats, MapsThatShareATextureMayBeOfDifferentFormats) {
    TestFile file = texturedBy({ uastcOf(1, 1, Ktx2Description::kLinear).file(), pngPixel(77) }, kBasis);
    file.root["textures"].push_back({ { "source", 1 } });
    file.root["extensionsUsed"].push_back("KHR_materials_clearcoat");
    file.root["materials"][0] = Json::parse(R"({ "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 1,
        "clearcoatTexture": { "index": 0 }, "clearcoatRoughnessTexture": { "index": 1 } } } })");
    const ModelData model = loaded(file);
    ASSERT_EQ(model.images.size(), 1u);
    EXPECT_EQ(std::to_integer<int>(model.images[0].data[0]), 100);
    EXPECT_EQ(std::to_integer<int>(model.images[0].data[1]), 77);
}

} // namespace
} // namespace filament_core::assets::test
