// SPDX-License-Identifier: Apache-2.0
#include "base/math/Half.h"
#include "filament_core/assets/blocks/BlockDecoder.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/Ktx2Decoder.h"
#include "filament_core/assets/image/Ktx2Formats.h"
#include "filament_core/assets/image/PictureDecoder.h"
#include "tests/filament_core/assets/blocks/BasisWriter.h"
#include "tests/filament_core/assets/image/Ktx2Packing.h"
#include "tests/filament_core/assets/image/Ktx2Writer.h"
#include "toolkit/paths/Paths.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <tuple>

namespace filament_core::assets {
namespace {

using backend::Format;
using test::BasisWriter;
using test::Ktx2Writer;
using test::zlibOf;
using test::zstdOf;
using testing::ElementsAreArray;
using testing::HasSubstr;
using KtxBytes = std::vector<std::byte>;

KtxBytes randomKtxBytes(size_t count, uint32_t seed = 1) {
    std::mt19937 random(seed);
    KtxBytes bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    return bytes;
}

KtxBytes bytesFrom(std::vector<int> const& values) {
    KtxBytes bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

Ktx2Texture decodedKtx(Ktx2Writer const& file, Ktx2Options const& options = {}) {
    Result<Ktx2Texture> texture = decodeKtx2(file.file(), "test.ktx2", options);
    EXPECT_TRUE(texture) << texture.error().message;
    return texture ? std::move(*texture) : Ktx2Texture{};
}

Error refusedKtx(KtxBytes const& file) {
    const Result<Ktx2Texture> texture = decodeKtx2(file, "test.ktx2");
    EXPECT_FALSE(texture);
    return texture ? Error{} : texture.error();
}

std::vector<float> floatsIn(Image const& image) {
    std::vector<float> floats;
    const size_t size = image.format == Format::RGBA32F ? 4 : 2;
    for (size_t at = 0; at < image.data.size(); at += size) {
        uint32_t bits = 0;
        std::memcpy(&bits, &image.data[at], size);
        floats.push_back(size == 4 ? std::bit_cast<float>(bits) : floatFromHalf(static_cast<uint16_t>(bits)));
    }
    return floats;
}

struct PlainCase {
    uint32_t format;
    std::vector<int> texel;
    Format decoded;
    std::array<double, 4> expected; ///< codes of 8 bits, or numbers
};

TEST(Ktx2, PlainFormatsAreTheTexelsThatVulkanDefines) {
    const std::vector<PlainCase> cases{
        { 1, { 0x5A }, Format::RGBA8, { 85, 170, 0, 255 } },
        { 2, { 0xCD, 0xAB }, Format::RGBA8, { 170, 187, 204, 221 } },
        { 3, { 0xCD, 0xAB }, Format::RGBA8, { 204, 187, 170, 221 } },
        { 4, { 0x1F, 0x80 }, Format::RGBA8, { 132, 0, 255, 255 } },
        { 5, { 0x1F, 0x80 }, Format::RGBA8, { 255, 0, 132, 255 } },
        { 6, { 0x01, 0xF8 }, Format::RGBA8, { 255, 0, 0, 255 } },
        { 8, { 0x1F, 0x80 }, Format::RGBA8, { 0, 0, 255, 255 } },
        { 9, { 77 }, Format::RGBA8, { 77, 0, 0, 255 } },
        { 15, { 77 }, Format::RGBA8Srgb, { 77, 0, 0, 255 } },
        { 16, { 1, 2 }, Format::RGBA8, { 1, 2, 0, 255 } },
        { 23, { 1, 2, 3 }, Format::RGBA8, { 1, 2, 3, 255 } },
        { 36, { 1, 2, 3 }, Format::RGBA8Srgb, { 3, 2, 1, 255 } },
        { 37, { 1, 2, 3, 4 }, Format::RGBA8, { 1, 2, 3, 4 } },
        { 50, { 1, 2, 3, 4 }, Format::RGBA8Srgb, { 3, 2, 1, 4 } },
        { 10, { 0x81 }, Format::RGBA16F, { -1, 0, 0, 1 } },
        { 38, { 0x80, 127, 0, 64 }, Format::RGBA16F, { -1, 1, 0, 64 / 127.0 } },
        { 64, { 0xFF, 0x03, 0x00, 0xC0 }, Format::RGBA16F, { 1, 0, 0, 1 } },
        { 58, { 0xFF, 0x03, 0x00, 0x40 }, Format::RGBA16F, { 0, 0, 1, 1 / 3.0 } },
        { 70, { 0xFF, 0xFF }, Format::RGBA16F, { 1, 0, 0, 1 } },
        { 71, { 0x01, 0x80 }, Format::RGBA16F, { -1, 0, 0, 1 } },
        { 91, { 0, 0, 0, 0x80, 0xFF, 0xFF, 0, 0x40 }, Format::RGBA16F, { 0, 0x8000 / 65535.0, 1, 0x4000 / 65535.0 } },
        { 97, { 0, 0x3C, 0, 0xC0, 0, 0x7C, 0, 0x7E }, Format::RGBA16F, { 1, -2, 65504, 0 } }, // infinity, not a number
        { 100, { 0, 0, 0x20, 0xC1 }, Format::RGBA16F, { -10, 0, 0, 1 } },
        { 122, { 0xC0, 0x03, 0, 0 }, Format::RGBA16F, { 1, 0, 0, 1 } },
        { 123, { 0x00, 0x01, 0, 0x80 }, Format::RGBA16F, { 1, 0, 0, 1 } },
    };
    for (PlainCase const& one : cases) {
        SCOPED_TRACE(one.format);
        const Image image = decodedKtx({ .format = one.format, .levels = { bytesFrom(one.texel) } }).image;
        ASSERT_EQ(image.format, one.decoded);
        const std::vector<float> floats = image.format == Format::RGBA16F ? floatsIn(image) : std::vector<float>{};
        for (size_t c = 0; c < 4; ++c) {
            if (image.format == Format::RGBA16F)
                EXPECT_NEAR(floats[c], one.expected[c], std::abs(one.expected[c]) / 2048) << c;
            else
                EXPECT_EQ(std::to_integer<int>(image.data[c]), one.expected[c]) << c;
        }
    }
}

TEST(Ktx2, FullFloatsKeepAllBits) {
    const Ktx2Writer deep{ .format = 70, .levels = { bytesFrom({ 0x01, 0x80 }) } };
    const Image image = decodedKtx(deep, { .isFull = true }).image;
    EXPECT_EQ(image.format, Format::RGBA32F);
    EXPECT_EQ(floatsIn(image)[0], 0x8001 / 65535.0f);
    const Ktx2Writer block{ .format = 143, .width = 4, .height = 4, .levels = { randomKtxBytes(16) } };
    EXPECT_EQ(floatsIn(decodedKtx(block, { .isFull = true }).image), floatsIn(decodedKtx(block).image));
}

// Vulkan 1.3, "VkFormat": VK_FORMAT_ASTC_WxH_UNORM_BLOCK; sRGB is the next number.
TEST(Ktx2, FormatsOfAstcHaveTheNumbersOfVulkan) {
    const std::tuple<uint32_t, uint8_t, uint8_t> numbers[] = { { 157, 4, 4 },   { 159, 5, 4 },  { 163, 6, 5 },
                                                               { 169, 8, 6 },   { 171, 8, 8 },  { 177, 10, 8 },
                                                               { 181, 12, 10 }, { 183, 12, 12 } };
    for (const auto& [number, width, height] : numbers) {
        for (const bool isSrgb : { false, true }) {
            const std::optional<Ktx2Format> format = ktx2Format(number + isSrgb);
            ASSERT_TRUE(format && format->block);
            EXPECT_EQ(*format->block, (BlockFormat{ BlockKind::Astc, width, height })) << number;
            EXPECT_EQ(format->isSrgb, isSrgb);
        }
    }
}

TEST(Ktx2, EveryBlockFormatIsDecodedByItsDecoder) {
    for (uint32_t format = 131; format <= 184; ++format) {
        SCOPED_TRACE(format);
        const bool isAstc = format >= 157;
        const bool isSrgb = isAstc          ? format % 2 == 0
                            : format <= 138 ? format % 2 == 0
                                            : format == 146 || format == 148 || format == 150 || format == 152;
        using enum BlockKind;
        constexpr std::array kKinds{ Bc1Rgb,   Bc1Rgb, Bc1Rgba,    Bc1Rgba, Bc2,        Bc2,       Bc3,
                                     Bc3,      Bc4,    Bc4Signed,  Bc5,     Bc5Signed,  Bc6,       Bc6Signed,
                                     Bc7,      Bc7,    Etc2Rgb,    Etc2Rgb, Etc2RgbA1,  Etc2RgbA1, Etc2Rgba,
                                     Etc2Rgba, EacR,   EacRSigned, EacRg,   EacRgSigned };
        BlockFormat block{ isAstc ? Astc : kKinds[format - 131] };
        if (isAstc)
            block.blockWidth = kAstcBlockSizes[(format - 157) / 2][0],
            block.blockHeight = kAstcBlockSizes[(format - 157) / 2][1];
        const KtxBytes bytes = randomKtxBytes(bytesOfBlocks(block, 13, 11), format);
        const Ktx2Texture texture = decodedKtx({ .format = format, .width = 13, .height = 11, .levels = { bytes } });
        KtxBytes expected(13 * 11 * (hasHalfTexels(block.kind) ? 8 : 4));
        decodeBlocks(block, isSrgb, bytes, 13, 11, expected);
        EXPECT_EQ(texture.image.data, expected);
        EXPECT_EQ(texture.isSrgb, isSrgb);
        EXPECT_EQ(texture.image.format, hasHalfTexels(block.kind) ? Format::RGBA16F
                                        : isSrgb                  ? Format::RGBA8Srgb
                                                                  : Format::RGBA8);
    }
}

TEST(Ktx2, SupercompressedLevelsHaveTheTexelsOfPlainOnes) {
    const KtxBytes large = randomKtxBytes(8 * 8 * 4), small = randomKtxBytes(4 * 4 * 4, 2);
    const Image plain = decodedKtx({ .width = 8, .height = 8, .levels = { large, small } }).image;
    EXPECT_EQ(plain.levels, 2u);
    for (const uint32_t compression : { 2u, 3u }) {
        const auto pack = compression == 2 ? zstdOf : zlibOf;
        Ktx2Writer file{ .width = 8, .height = 8, .compression = compression, .levels = { pack(large), pack(small) } };
        file.plainBytes = { large.size(), small.size() };
        EXPECT_EQ(decodedKtx(file).image.data, plain.data);
        file.plainBytes[1] = 65;
        EXPECT_THAT(refusedKtx(file.file()).message,
                    HasSubstr("'test.ktx2' cannot be decoded: level 1: 65 bytes instead of 64"));
        file.plainBytes[1] = 64;
        file.levels[0] = pack(KtxBytes(255));
        EXPECT_THAT(refusedKtx(file.file()).message, HasSubstr("level 0: 255 bytes instead of 256"));
        file.levels[0] = pack(KtxBytes(257));
        EXPECT_THAT(refusedKtx(file.file()).message, HasSubstr("level 0: "));
        file.levels[0] = KtxBytes(20, std::byte{ 7 });
        EXPECT_THAT(refusedKtx(file.file()).message,
                    HasSubstr(compression == 2 ? "level 0: Zstandard: " : "level 0: zlib: "));
    }
}

TEST(Ktx2, LevelsStartWithTheFirstThatIsSmallEnough) {
    Ktx2Writer file{ .format = 9, .width = 8, .height = 4 };
    for (const size_t size : { 32u, 8u, 2u, 1u })
        file.levels.push_back(randomKtxBytes(size, static_cast<uint32_t>(size)));
    const Image whole = decodedKtx(file).image, part = decodedKtx(file, { .maxSize = 4 }).image;
    EXPECT_EQ(whole.levels, 4u);
    EXPECT_EQ(part.width, 4u);
    EXPECT_EQ(part.height, 2u);
    EXPECT_EQ(part.levels, 3u);
    EXPECT_THAT(part.data, ElementsAreArray(std::span(whole.data).subspan(whole.levelOffset(1))));
    const Image first = decodedKtx(file, { .isOneLevel = true }).image;
    EXPECT_THAT(first.data, ElementsAreArray(std::span(whole.data).first(whole.levelOffset(1))));
    file.levels.resize(2);
    EXPECT_EQ(decodedKtx(file, { .maxSize = 1 }).image.width, 4u) << "the last one of the file";
}

TEST(Ktx2, CubesAndArraysKeepTheirOrder) {
    const KtxBytes bytes = randomKtxBytes(2 * 2 * 4 * 12);
    const Ktx2Texture texture = decodedKtx({ .width = 2, .height = 2, .elements = 2, .faces = 6, .levels = { bytes } });
    EXPECT_TRUE(texture.isCube && texture.isArray);
    EXPECT_EQ(texture.image.layers, 12u);
    EXPECT_EQ(texture.image.data, bytes);
}

TEST(Ktx2, SwizzlesAndOrientationsOfTheMetadataAreApplied) {
    Ktx2Writer file{ .width = 2, .height = 3, .levels = { randomKtxBytes(24) } };
    const KtxBytes plain = decodedKtx(file).image.data;
    file.keys = { { "KTXwriter", "test" }, { "KTXswizzle", "bg1r" }, { "KTXorientation", "lu" } };
    const KtxBytes arranged = decodedKtx(file).image.data;
    for (size_t y = 0; y < 3; ++y) {
        for (size_t x = 0; x < 2; ++x) {
            const std::byte* from = &plain[((2 - y) * 2 + 1 - x) * 4];
            EXPECT_THAT(std::span(arranged).subspan((y * 2 + x) * 4, 4),
                        testing::ElementsAre(from[2], from[1], std::byte{ 255 }, from[0]));
        }
    }
    Ktx2Writer halves{ .format = 97, .width = 1, .height = 1, .levels = { bytesFrom({ 1, 0, 2, 0, 3, 0, 4, 0 }) } };
    halves.keys = { { "KTXswizzle", "ab01" } };
    EXPECT_EQ(decodedKtx(halves).image.data, bytesFrom({ 4, 0, 3, 0, 0, 0, 0, 0x3C }));
    file.keys = { { "KTXswizzle", "rgbx" } };
    EXPECT_THAT(refusedKtx(file.file()).message, HasSubstr("its KTXswizzle is not four of r, g, b, a, 0 and 1"));
}

/// One level of ETC1S.
struct Etc1sFile {
    Ktx2Writer file;
    std::vector<blocks::Texel8> colors, alphas;
};
Etc1sFile etc1sFile(std::vector<uint8_t> channels, bool isGrey = false) {
    Etc1sFile made;
    BasisWriter writer(30, 40, isGrey, 5);
    KtxBytes level = writer.slice(21, 18, made.colors);
    BasisWriter::Image image{ .length = static_cast<uint32_t>(level.size()) };
    if (channels.size() > 1) {
        const KtxBytes alpha = writer.slice(21, 18, made.alphas);
        image.alphaOffset = image.length, image.alphaLength = static_cast<uint32_t>(alpha.size());
        level.insert(level.end(), alpha.begin(), alpha.end());
    }
    made.file = { .format = 0,
                  .width = 21,
                  .height = 18,
                  .compression = 1,
                  .model = 163,
                  .transfer = 2,
                  .channels = std::move(channels),
                  .levels = { level } };
    made.file.plainBytes = { 0 };
    made.file.globalData = writer.globalData({ image });
    return made;
}

TEST(Ktx2, ChannelsOfEtc1sAreThoseOfItsDescriptor) {
    struct Case {
        std::vector<uint8_t> channels;
        bool isGrey;
    };
    for (Case const& one : { Case{ { 0 }, false }, { { 0, 15 }, false }, { { 3 }, true }, { { 3, 4 }, true } }) {
        const Etc1sFile made = etc1sFile(one.channels, one.isGrey);
        const Ktx2Texture texture = decodedKtx(made.file);
        EXPECT_EQ(texture.image.format, Format::RGBA8Srgb);
        for (size_t i = 0; i < made.colors.size(); ++i) {
            const auto at = [&](size_t c) { return std::to_integer<uint8_t>(texture.image.data[4 * i + c]); };
            const blocks::Texel8 expected{ made.colors[i].r, made.colors[i].g, made.colors[i].b,
                                           made.alphas.empty() ? uint8_t{ 255 } : made.alphas[i].g };
            ASSERT_EQ((blocks::Texel8{ at(0), at(1), at(2), at(3) }), expected) << i;
        }
    }
}

TEST(Ktx2, VideosOfEtc1sAreNotRead) {
    Etc1sFile made = etc1sFile({ 0 });
    made.file.globalData[20] = std::byte{ 2 };
    const Error error = refusedKtx(made.file.file());
    EXPECT_EQ(error.code, ErrorCode::Unsupported);
    EXPECT_EQ(error.message, "image 'test.ktx2' is a video; export its pictures one by one");
}

TEST(Ktx2, ChannelsOfUastcAreThoseOfItsDescriptor) {
    const KtxBytes bytes = randomKtxBytes(16 * 6);
    KtxBytes all(12 * 8 * 4);
    decodeBlocks({ BlockKind::Uastc }, false, bytes, 12, 8, all);
    for (const uint8_t channel : std::array<uint8_t, 5>{ 0, 3, 4, 5, 6 }) {
        const Ktx2Texture texture = decodedKtx(
                { .format = 0, .width = 12, .height = 8, .model = 166, .channels = { channel }, .levels = { bytes } });
        for (size_t i = 0; i < all.size(); i += 4) {
            EXPECT_EQ(texture.image.data[i], all[i]);
            EXPECT_EQ(texture.image.data[i + 2], channel == 6 ? std::byte{ 0 } : all[i + 2]);
            EXPECT_EQ(texture.image.data[i + 3], channel == 3 || channel == 5 ? all[i + 3] : std::byte{ 255 });
        }
    }
}

KtxBytes fileOf(const char* name) {
    const auto bytes = readFileBytes(tools::sourceDir() / "tests/filament_core/assets/image/basis" / name);
    EXPECT_TRUE(bytes) << bytes.error().message;
    return bytes ? *bytes : KtxBytes{};
}

TEST(Ktx2, FilesOfBasisUniversalHaveTheTexelsOfItsOwnDecoder) {
    const Result<Ktx2Texture> etc1s = decodeKtx2(fileOf("etc1s.ktx2"), "etc1s.ktx2");
    ASSERT_TRUE(etc1s) << etc1s.error().message;
    EXPECT_EQ(etc1s->image.levels, 5u);
    EXPECT_TRUE(etc1s->isSrgb);
    const Result<Image> colors = decodeImage(fileOf("etc1s.png"), "etc1s.png");
    ASSERT_TRUE(colors) << colors.error().message;
    for (size_t i = 0; i < colors->data.size(); ++i) {
        const bool isAlpha = i % 4 == 3; // which the image does not have
        ASSERT_TRUE(isAlpha || etc1s->image.data[i] == colors->data[i]) << i;
    }
    const Result<Ktx2Texture> uastc = decodeKtx2(fileOf("uastc.ktx2"), "uastc.ktx2");
    ASSERT_TRUE(uastc) << uastc.error().message;
    EXPECT_EQ(uastc->image.format, Format::RGBA8);
    const Result<Image> texels = decodeImage(fileOf("uastc.png"), "uastc.png");
    ASSERT_TRUE(texels) << texels.error().message;
    EXPECT_THAT(texels->data, ElementsAreArray(std::span(uastc->image.data).first(texels->data.size())));
}

TEST(Ktx2, LoadImageTakesTheFirstLevelOfATexture) {
    const Ktx2Writer file{ .format = 43, .width = 2, .height = 2, .levels = { randomKtxBytes(16), randomKtxBytes(4) } };
    for (const bool isColor : { true, false }) {
        const Result<Image> picture = decodePicture(file.file(), "a.ktx2", { .isColor = isColor });
        ASSERT_TRUE(picture) << picture.error().message;
        EXPECT_EQ(picture->levels, 1u);
        EXPECT_EQ(picture->format, Format::RGBA8Srgb) << "the file says so";
        EXPECT_EQ(picture->data, file.levels[0]);
    }
    const Ktx2Writer cube{ .width = 1, .height = 1, .faces = 6, .levels = { randomKtxBytes(24) } };
    const Result<Image> refused = decodePicture(cube.file(), "a.ktx2");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "image 'a.ktx2' has 6 pictures (a cube); export one of them");
}

TEST(Ktx2, FilesThatAreNotReadSayWhyAndWhatHelps) {
    const auto message = [](Ktx2Writer file) {
        if (file.levels.empty()) file.levels = { randomKtxBytes(4) };
        return refusedKtx(file.file()).message;
    };
    EXPECT_THAT(message({ .format = 13 }),
                HasSubstr("has VkFormat 13 and colour model 1, which are not read; export it as UASTC"));
    EXPECT_THAT(message({ .format = 0, .model = 167 }), HasSubstr("VkFormat 0 and colour model 167"));
    EXPECT_THAT(message({ .flags = 1 }),
                HasSubstr("has colours that are multiplied by alpha; export it with straight alpha"));
    EXPECT_THAT(message({ .width = 0 }), HasSubstr("it is 0 texels wide"));
    EXPECT_THAT(message({ .height = 0 }), HasSubstr("has one dimension; export it as a two-dimensional texture"));
    EXPECT_THAT(message({ .depth = 2 }), HasSubstr("has three dimensions"));
    EXPECT_THAT(message({ .width = 16385 }),
                HasSubstr("is 16385 x 1 texels, more than 16384 on a side; make it smaller"));
    EXPECT_THAT(message({ .elements = 3000 }), HasSubstr("has 3000 layers of 1 x 1 texels, more than 2048"));
    EXPECT_THAT(message({ .elements = ~0u, .faces = 6 }), HasSubstr("has 25769803770 layers"));
    EXPECT_THAT(message({ .faces = 2 }), HasSubstr("it has 2 faces, not 1 or 6"));
    EXPECT_THAT(message({ .width = 2, .faces = 6 }), HasSubstr("it is a cube whose faces are no squares"));
    EXPECT_THAT(message({ .levelCount = 2 }), HasSubstr("it has 2 levels, and its size has only 1"));
    EXPECT_THAT(message({ .compression = 9 }), HasSubstr("has supercompression 9, which is not known"));
    EXPECT_THAT(message({ .compression = 1 }), HasSubstr("its format and its supercompression do not belong together"));
    EXPECT_THAT(message({ .levels = { randomKtxBytes(5) } }),
                HasSubstr("level 0: 5 bytes instead of 4; export it again"));
    EXPECT_THAT(message({ .levels = { {} } }), HasSubstr("its level 0 is empty"));
    EXPECT_EQ(refusedKtx(bytesFrom({ 1, 2, 3 })).message,
              "image 'test.ktx2' is not KTX 2.0; export it as KTX 2.0, PNG or JPEG");
}

std::vector<KtxBytes> smallFiles() {
    const KtxBytes uastc = randomKtxBytes(16 * 4);
    Ktx2Writer packed{ .format = 0,
                       .width = 8,
                       .height = 8,
                       .compression = 2,
                       .model = 166,
                       .channels = { 3 },
                       .levels = { zstdOf(uastc) } };
    packed.plainBytes = { uastc.size() };
    packed.keys = { { "KTXorientation", "rd" } };
    Ktx2Writer deflated{
        .format = 16, .width = 3, .height = 3, .compression = 3, .levels = { zlibOf(randomKtxBytes(18)) }
    };
    deflated.plainBytes = { 18 };
    return { packed.file(), deflated.file(), etc1sFile({ 0, 15 }).file.file() };
}

TEST(Ktx2, EveryTruncationIsAnErrorOfOneLine) {
    for (KtxBytes const& file : smallFiles()) {
        ASSERT_TRUE(decodeKtx2(file, "test.ktx2"));
        for (size_t length = 0; length < file.size(); ++length) {
            const Result<Ktx2Texture> texture = decodeKtx2(std::span(file).first(length), "test.ktx2");
            ASSERT_FALSE(texture) << length << " of " << file.size();
            EXPECT_THAT(texture.error().message, HasSubstr("image 'test.ktx2' "));
            EXPECT_EQ(texture.error().message.find('\n'), std::string::npos);
        }
    }
}

TEST(Ktx2, EverySingleBitOfDamageIsAnErrorOrAPicture) {
    for (KtxBytes file : smallFiles()) {
        for (size_t bit = 0; bit < file.size() * 8; ++bit) {
            const uint32_t byte = static_cast<uint32_t>(bit / 8);
            if (byte >= 20 && byte < 40 && bit % 8 > 3) continue; // sizes: only slow
            file[byte] ^= static_cast<std::byte>(1u << bit % 8);
            const Result<Ktx2Texture> texture = decodeKtx2(file, "test.ktx2");
            if (texture)
                EXPECT_EQ(texture->image.data.size(), texture->image.levelOffset(texture->image.levels));
            else
                EXPECT_THAT(texture.error().message, HasSubstr("image 'test.ktx2' ")) << bit;
            file[byte] ^= static_cast<std::byte>(1u << bit % 8);
        }
    }
}

} // namespace
} // namespace filament_core::assets
