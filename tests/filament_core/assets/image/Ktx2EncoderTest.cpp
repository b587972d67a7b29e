// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/Ktx2Encoder.h"

#include "filament_core/assets/image/Ktx2Decoder.h"

#include <gmock/gmock.h>

#include <cstring>

namespace filament_core::assets {
namespace {

using backend::Format;

/// Texels are numbers that every format can hold.
Image encodable(Format format, uint32_t layers, uint32_t levels) {
    Image image{ .width = 6, .height = 6, .layers = layers, .levels = levels, .format = format, .data = {} };
    image.data.resize(image.levelOffset(levels));
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<std::byte>(i * 29 % 59);
    return image;
}

uint32_t wordAt(std::vector<std::byte> const& file, size_t at) {
    uint32_t word = 0;
    std::memcpy(&word, &file[at], sizeof(word));
    return word;
}

TEST(Ktx2Encoder, EveryFormatAndShapeIsReadAsItWasWritten) {
    for (const Format format : { Format::R8, Format::RGBA8, Format::RGBA8Srgb, Format::RGBA16F, Format::RGBA32F,
                                 Format::R11G11B10F, Format::RGB9E5, Format::BC4, Format::BC6HUfloat }) {
        for (const uint32_t layers : { 1u, 6u }) {
            for (const uint32_t levels : { 1u, 2u, 3u }) {
                const Image image = encodable(format, layers, levels);
                const std::vector<std::byte> bytes = encodeKtx2(image);
                const Result<Ktx2File> file = readKtx2(bytes, "made.ktx2");
                ASSERT_TRUE(file) << file.error().message;
                EXPECT_EQ(formatOfVkFormat(file->format), format);
                EXPECT_EQ(file->isCube, layers == 6);
                EXPECT_FALSE(file->isArray);
                ASSERT_EQ(file->levels.size(), levels);
                for (uint32_t level = 0; level < levels; ++level) {
                    const auto texels =
                            std::span(image.data).subspan(image.levelOffset(level), image.levelBytes(level));
                    EXPECT_TRUE(std::ranges::equal(file->levels[level].bytes, texels));
                }
                EXPECT_TRUE(decodeKtx2(bytes, "made.ktx2"));
            }
        }
    }
}

// KTX 2.0, 3.9 and 4: offsets are multiples of the texels' size and of 4, and smaller levels come first.
TEST(Ktx2Encoder, LevelsAreAlignedAndTheSmallestComesFirst) {
    const std::vector<std::byte> bytes = encodeKtx2(encodable(Format::RGBA32F, 6, 3));
    const Result<Ktx2File> file = readKtx2(bytes, "made.ktx2");
    ASSERT_TRUE(file);
    for (Ktx2Level const& level : file->levels)
        EXPECT_EQ(static_cast<size_t>(level.bytes.data() - bytes.data()) % 16, 0u);
    EXPECT_GT(file->levels[0].bytes.data(), file->levels[1].bytes.data());
    EXPECT_GT(file->levels[1].bytes.data(), file->levels[2].bytes.data());
    EXPECT_EQ(file->levels[0].bytes.data() + file->levels[0].bytes.size(), bytes.data() + bytes.size());
}

TEST(Ktx2Encoder, PairsAreSortedAndPadded) {
    const std::vector<std::byte> bytes =
            encodeKtx2(encodable(Format::RGBA8, 1, 1),
                       std::array{ ktx2Text("b", "two"), ktx2Text("KTXwriter", "me"), ktx2Text("a", "") });
    const Result<Ktx2File> file = readKtx2(bytes, "made.ktx2");
    ASSERT_TRUE(file);
    std::vector<std::string> keys;
    for (Ktx2Value const& value : file->values) keys.emplace_back(value.key);
    EXPECT_THAT(keys, testing::ElementsAre("KTXorientation", "KTXwriter", "a", "b"));
    EXPECT_EQ(file->value("b")->size(), 4u) << "with its zero";
    EXPECT_EQ(file->value("a")->size(), 1u);
    EXPECT_FALSE(file->value("c"));
    EXPECT_EQ(wordAt(bytes, 60) % 4, 0u);
}

// The words of a descriptor that other readers check: Khronos Data Format Specification 1.3, 5 and its examples.
TEST(Ktx2Encoder, DescriptorsAreThoseOfTheSpecification) {
    const std::vector<std::byte> half = encodeKtx2(encodable(Format::RGBA16F, 1, 1));
    const size_t at = wordAt(half, 48);
    EXPECT_EQ(wordAt(half, 16), 2u) << "typeSize";
    EXPECT_EQ(wordAt(half, at), 4 + 24 + 4 * 16u);
    EXPECT_EQ(wordAt(half, at + 8), 2u | 88u << 16) << "version and size of the block";
    EXPECT_EQ(wordAt(half, at + 12), 0x00010101u) << "RGBSDA, BT.709, linear, straight alpha";
    EXPECT_EQ(wordAt(half, at + 20), 8u) << "bytes of a texel";
    EXPECT_EQ(wordAt(half, at + 28), 0xC00F0000u) << "red: signed float from bit 0, 16 bits";
    EXPECT_EQ(wordAt(half, at + 28 + 48), 0xCF0F0030u) << "alpha";
    EXPECT_EQ(wordAt(half, at + 28 + 8), 0xBF800000u);
    EXPECT_EQ(wordAt(half, at + 28 + 12), 0x3F800000u);
    const std::vector<std::byte> shared = encodeKtx2(encodable(Format::RGB9E5, 1, 1));
    EXPECT_EQ(wordAt(shared, at), 4 + 24 + 6 * 16u) << "mantissa and exponent of each colour";
    EXPECT_EQ(wordAt(shared, at + 28 + 16), 0x2004001Bu) << "the exponent of red: 5 bits from bit 27";
    EXPECT_EQ(wordAt(shared, at + 28 + 12), 8448u);
    EXPECT_EQ(wordAt(encodeKtx2(encodable(Format::RGBA8Srgb, 1, 1)), at + 12), 0x00020101u) << "sRGB";
}

} // namespace
} // namespace filament_core::assets
