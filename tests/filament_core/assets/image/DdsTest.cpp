// SPDX-License-Identifier: Apache-2.0
// DDS: every format beside the KTX 2.0 file with the same texels, masks, levels, and files that are not read.
#include "filament_core/assets/image/DdsDecoder.h"
#include "filament_core/assets/image/ImageSize.h"
#include "filament_core/assets/image/PictureDecoder.h"
#include "filament_core/assets/image/TextureDecoder.h"
#include "tests/filament_core/assets/image/DdsWriter.h"
#include "tests/filament_core/assets/image/Ktx2Writer.h"

#include <gmock/gmock.h>

#include <random>

namespace filament_core::assets::test {
namespace {

using backend::Format;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

Bytes noiseOf(size_t count, std::mt19937& random) {
    Bytes bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    return bytes;
}

Bytes bytesOf(std::initializer_list<int> values) {
    Bytes bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

Image decoded(DdsWriter const& writer, Ktx2Options const& options = {}) {
    const Result<DdsTexture> texture = decodeDds(writer.file(), "test", options);
    EXPECT_TRUE(texture) << (texture ? "" : texture.error().message);
    return texture ? texture->image : Image{};
}

std::string errorOf(Bytes const& file) {
    const Result<DdsTexture> texture = decodeDds(file, "test");
    return texture ? "" : texture.error().message;
}

struct SameFormat {
    uint32_t dxgi;
    const char* fourCc; ///< null: this format has none
    uint32_t vkFormat;
    size_t bytes; ///< of a texel, or of a block
};
/// Names as in dxgiformat.h and vulkan_core.h.
constexpr SameFormat kSameFormats[] = {
    { 2, nullptr, 109, 16 },  // R32G32B32A32_FLOAT
    { 10, nullptr, 97, 8 },   // R16G16B16A16_FLOAT
    { 11, nullptr, 91, 8 },   // R16G16B16A16_UNORM
    { 13, nullptr, 92, 8 },   // R16G16B16A16_SNORM
    { 24, nullptr, 64, 4 },   // R10G10B10A2_UNORM, A2B10G10R10_UNORM_PACK32
    { 26, nullptr, 122, 4 },  // R11G11B10_FLOAT
    { 28, nullptr, 37, 4 },   // R8G8B8A8_UNORM
    { 29, nullptr, 43, 4 },   // R8G8B8A8_UNORM_SRGB
    { 34, nullptr, 83, 4 },   // R16G16_FLOAT
    { 41, nullptr, 100, 4 },  // R32_FLOAT
    { 49, nullptr, 16, 2 },   // R8G8_UNORM
    { 61, nullptr, 9, 1 },    // R8_UNORM
    { 67, nullptr, 123, 4 },  // R9G9B9E5_SHAREDEXP
    { 71, "DXT1", 133, 8 },   // BC1
    { 72, nullptr, 134, 8 },  // BC1_SRGB
    { 74, "DXT3", 135, 16 },  // BC2
    { 77, "DXT5", 137, 16 },  // BC3
    { 78, nullptr, 138, 16 }, // BC3_SRGB
    { 80, "BC4U", 139, 8 },   // BC4
    { 80, "ATI1", 139, 8 },   // BC4
    { 81, "BC4S", 140, 8 },   // BC4_SNORM
    { 83, "ATI2", 141, 16 },  // BC5
    { 84, "BC5S", 142, 16 },  // BC5_SNORM
    { 85, nullptr, 4, 2 },    // B5G6R5, R5G6B5_UNORM_PACK16
    { 86, nullptr, 8, 2 },    // B5G5R5A1, A1R5G5B5_UNORM_PACK16
    { 87, nullptr, 44, 4 },   // B8G8R8A8_UNORM
    { 91, nullptr, 50, 4 },   // B8G8R8A8_UNORM_SRGB
    { 95, nullptr, 143, 16 }, // BC6H_UF16
    { 96, nullptr, 144, 16 }, // BC6H_SF16
    { 98, nullptr, 145, 16 }, // BC7
    { 99, nullptr, 146, 16 }, // BC7_SRGB
};

TEST(Dds, EveryFormatHasTheTexelsOfTheSameOneInKtx2) {
    std::mt19937 random(1);
    for (SameFormat const& same : kSameFormats) {
        const bool isBlock = same.vkFormat >= 131;
        const uint2 size = isBlock ? uint2(10, 6) : uint2(5, 3);
        const Bytes texels = noiseOf(same.bytes * (isBlock ? 3 * 2 : size.x * size.y), random);
        const Bytes other =
                Ktx2Writer{ .format = same.vkFormat, .width = size.x, .height = size.y, .levels = { texels } }.file();
        for (const bool isFull : { false, true }) {
            const Result<Ktx2Texture> expected = decodeKtx2(other, "other", { .isFull = isFull });
            ASSERT_TRUE(expected) << expected.error().message;
            DdsWriter writer{ .dxgi = same.dxgi, .width = size.x, .height = size.y, .texels = texels };
            const Image image = decoded(writer, { .isFull = isFull });
            EXPECT_EQ(image.format, expected->image.format) << same.dxgi;
            EXPECT_EQ(image.data, expected->image.data) << same.dxgi;
            if (!same.fourCc) continue;
            writer.dxgi = 0, writer.fourCc = same.fourCc;
            EXPECT_EQ(decoded(writer, { .isFull = isFull }).data, expected->image.data) << same.fourCc;
        }
    }
}

TEST(Dds, MasksAreChannelsWhereverTheyLie) {
    const auto texel = [](DdsWriter writer, Bytes const& bytes) {
        writer.bits = static_cast<uint32_t>(bytes.size() * 8);
        writer.texels = bytes;
        return decoded(writer).data;
    };
    EXPECT_EQ(texel({ .masks = { 0xFF0000, 0xFF00, 0xFF, 0xFF000000 } }, bytesOf({ 1, 2, 3, 4 })),
              bytesOf({ 3, 2, 1, 4 }));
    EXPECT_EQ(texel({ .flags = 0x40, .masks = { 0xFF0000, 0xFF00, 0xFF, 0xFF000000 } }, bytesOf({ 1, 2, 3, 4 })),
              bytesOf({ 3, 2, 1, 255 }))
            << "a header without the flag of alpha has none";
    EXPECT_EQ(texel({ .flags = 0x40, .masks = { 0xFF0000, 0xFF00, 0xFF, 0 } }, bytesOf({ 1, 2, 3 })),
              bytesOf({ 3, 2, 1, 255 }));
    EXPECT_EQ(texel({ .masks = { 0xF00, 0xF0, 0xF, 0xF000 } }, bytesOf({ 0x21, 0x43 })),
              bytesOf({ 3 * 17, 2 * 17, 1 * 17, 4 * 17 }));
    EXPECT_EQ(texel({ .flags = 0x20000, .masks = { 0xFF, 0, 0, 0 } }, bytesOf({ 9 })), bytesOf({ 9, 9, 9, 255 }));
    EXPECT_EQ(texel({ .flags = 0x20001, .masks = { 0xFF, 0, 0, 0xFF00 } }, bytesOf({ 9, 8 })), bytesOf({ 9, 9, 9, 8 }));
    EXPECT_EQ(texel({ .flags = 2, .masks = { 0, 0, 0, 0xFF } }, bytesOf({ 7 })), bytesOf({ 0, 0, 0, 7 }));
    EXPECT_EQ(texel({ .masks = { 0xFF0, 0xF000, 0xF, 0 } }, bytesOf({ 0xA5, 0x73 })),
              bytesOf({ 0x3A, 7 * 17, 5 * 17, 255 }))
            << "channels that begin within a byte";
    EXPECT_EQ(texel({ .dxgi = 65 }, bytesOf({ 7 })), bytesOf({ 0, 0, 0, 7 })) << "A8_UNORM";
    EXPECT_EQ(texel({ .dxgi = 88 }, bytesOf({ 1, 2, 3, 4 })), bytesOf({ 3, 2, 1, 255 })) << "B8G8R8X8_UNORM";
    EXPECT_EQ(texel({ .dxgi = 115 }, bytesOf({ 0x21, 0x43 })), bytesOf({ 51, 34, 17, 68 })) << "B4G4R4A4_UNORM";
}

TEST(Dds, LevelsFollowEachOtherAndStartWithTheFirstThatIsSmallEnough) {
    std::mt19937 random(2);
    DdsWriter writer{ .width = 8, .height = 4, .levels = 4, .texels = noiseOf(4 * (32 + 8 + 2 + 1), random) };
    const Image all = decoded(writer);
    EXPECT_EQ(all.levels, 4u);
    EXPECT_EQ(all.data, writer.texels);
    const Image small = decoded(writer, { .maxSize = 4 });
    EXPECT_EQ(small.levels, 3u);
    EXPECT_EQ(small.width, 4u);
    EXPECT_EQ(small.data, Bytes(writer.texels.begin() + 4 * 32, writer.texels.end()));
    writer.levels = 3; // ends before 1 x 1: its levels are made from the first
    EXPECT_EQ(decoded(writer, { .maxSize = 4 }).data, Bytes(writer.texels.begin(), writer.texels.begin() + 4 * 32));
    EXPECT_EQ(imageSize(writer.file()), uint2(8, 4));
}

// What writers of DDS store of a normal is x and y.
TEST(Dds, TwoChannelsOfATextureAreANormal) {
    const DdsWriter writer{ .dxgi = 49, .width = 3, .texels = bytesOf({ 128, 128, 255, 128, 200, 60 }) };
    const Result<DecodedTexture> texture = decodeTexture(writer.file(), "test");
    ASSERT_TRUE(texture);
    for (size_t i = 0; i < 3; ++i) {
        const auto at = [&](size_t c) { return static_cast<double>(texture->image.data[4 * i + c]) / 255 * 2 - 1; };
        EXPECT_NEAR(at(0) * at(0) + at(1) * at(1) + at(2) * at(2), 1, 0.02);
        EXPECT_GE(at(2), -0.01);
    }
    EXPECT_EQ(decoded(writer).data[2], std::byte{ 0 }) << "the file has no blue";
}

TEST(Dds, LoadImageTakesTheFirstLevelInTheColoursOfItsUse) {
    const DdsWriter plain{ .texels = bytesOf({ 1, 2, 3, 4 }) }, marked{ .dxgi = 29, .texels = bytesOf({ 1, 2, 3, 4 }) };
    const auto formatOf = [](DdsWriter const& writer, bool isColor) {
        return decodePicture(writer.file(), "test", { .isColor = isColor })->format;
    };
    EXPECT_EQ(formatOf(plain, true), Format::RGBA8Srgb);
    EXPECT_EQ(formatOf(plain, false), Format::RGBA8);
    EXPECT_EQ(formatOf(marked, false), Format::RGBA8Srgb);
}

TEST(Dds, FilesThatAreNotReadSayWhyAndWhatHelps) {
    const auto of = [](auto const& change) {
        DdsWriter writer{ .dxgi = 28, .texels = Bytes(4) };
        change(writer);
        return errorOf(writer.file());
    };
    EXPECT_EQ(of([](DdsWriter& w) { w.misc = 4; }), "image 'test' is a cube; export it as a two-dimensional texture");
    EXPECT_THAT(of([](DdsWriter& w) { w.caps2 = 0x200; }), HasSubstr("is a cube"));
    EXPECT_THAT(of([](DdsWriter& w) { w.caps2 = 0x200000; }), HasSubstr("has three dimensions"));
    EXPECT_THAT(of([](DdsWriter& w) { w.dimension = 4; }), HasSubstr("has resource dimension 4, not 3"));
    EXPECT_THAT(of([](DdsWriter& w) { w.array = 2; }), HasSubstr("is an array"));
    EXPECT_THAT(of([](DdsWriter& w) { w.misc2 = 2; }), HasSubstr("multiplied by alpha"));
    EXPECT_THAT(of([](DdsWriter& w) { w.dxgi = 0, w.fourCc = "DXT4"; }), HasSubstr("multiplied by alpha"));
    EXPECT_THAT(of([](DdsWriter& w) { w.dxgi = 0, w.fourCc = "UYVY"; }), HasSubstr("four-character code 0x59565955"));
    EXPECT_THAT(of([](DdsWriter& w) { w.dxgi = 107; }), HasSubstr("DXGI_FORMAT 107, which is not read; export it as"));
    EXPECT_THAT(of([](DdsWriter& w) { w.dxgi = 0, w.flags = 0x20; }), HasSubstr("pixel format flags 0x20"));
    EXPECT_THAT(of([](DdsWriter& w) { w.dxgi = 0, w.bits = 12; }), HasSubstr("12 bits a texel"));
    EXPECT_THAT(of([](DdsWriter& w) { w.dxgi = 0, w.masks[0] = 0xF0F; }), HasSubstr("channel mask 0x00000f0f"));
    EXPECT_THAT(of([](DdsWriter& w) { w.dxgi = 0, w.bits = 16; }), HasSubstr("channel mask 0x00ff0000 of 16 bits"));
    EXPECT_THAT(of([](DdsWriter& w) { w.width = 0; }), HasSubstr("it is 0 x 1 texels"));
    EXPECT_THAT(of([](DdsWriter& w) { w.width = 1u << 20; }), HasSubstr("more than 16384 on a side"));
    EXPECT_THAT(of([](DdsWriter& w) { w.levels = 2; }), HasSubstr("it has 2 levels, and its size has only 1"));
    EXPECT_EQ(
            of([](DdsWriter& w) { w.texels.resize(3); }),
            "image 'test' cannot be decoded: its level 0 is 4 bytes from byte 148 on, and the file has 151; export it "
            "again");
    const Result<DecodedTexture> deep = decodeTexture(DdsWriter{ .dxgi = 95, .texels = Bytes(16) }.file(), "test");
    EXPECT_EQ(deep.error().message,
              "image 'test' has more than 8 bits a channel, which materials of models do not read; export it as BC7");
}

TEST(Dds, EveryTruncationIsAnErrorOfOneLine) {
    const Bytes whole = DdsWriter{ .dxgi = 98, .width = 8, .height = 8, .texels = Bytes(64) }.file();
    for (size_t size = 4; size < whole.size(); ++size) {
        const std::string error = errorOf(Bytes(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size)));
        EXPECT_THAT(error, HasSubstr("image 'test' ")) << size;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    }
}

} // namespace
} // namespace filament_core::assets::test
