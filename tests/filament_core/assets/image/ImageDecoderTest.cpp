// SPDX-License-Identifier: Apache-2.0
// PNG: every kind of pixel against the specification. JPEG: the same bits with and without SIMD. Both: hostile files.
#include "filament_core/assets/image/ImageDecoder.h"
#include "tests/base/ScopedVariable.h"
#include "tests/filament_core/assets/image/ImageFuzzBody.h"
#include "tests/filament_core/assets/image/PictureFiles.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <thread>

namespace filament_core::assets::test {
namespace {

using ::testing::HasSubstr;

class Pngs : public ::testing::TestWithParam<PngKind> {};

// ISO/IEC 15948, 13.12: floor(sample * 255 / largest + 0.5).
TEST_P(Pngs, HaveThePixelsOfTheSpecification) {
    const PngKind kind = GetParam();
    const PngFile file = makePng(kind, 13, 11);
    const Result<Image> image = decodeImage(file.bytes, "a.png");
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->width, 13u);
    ASSERT_EQ(image->height, 11u);
    EXPECT_EQ(image->data, file.rgba);
    EXPECT_EQ(isDeepPng(file.bytes), kind.depth == 16);
    const Result<DeepImage> deep = decodeDeepPng(file.bytes, "a.png");
    ASSERT_TRUE(deep) << deep.error().message;
    EXPECT_EQ(uint2(deep->width, deep->height), uint2(13, 11));
    EXPECT_EQ(deep->codes, file.deep) << "with 16 bits a channel";
}

INSTANTIATE_TEST_SUITE_P(Of, Pngs, ::testing::ValuesIn(pngKinds()),
                         [](auto const& each) { return pngKindName(each.param); });

std::vector<std::byte> decoded(std::vector<std::byte> const& file) {
    const Result<Image> image = decodeImage(file, "a.jpg");
    EXPECT_TRUE(image) << (image ? "" : image.error().message);
    return image ? image->data : std::vector<std::byte>{};
}

class Jpegs : public ::testing::TestWithParam<JpegKind> {};

// libjpeg-turbo reads the variable once per thread.
TEST_P(Jpegs, HaveTheSameBitsWithAndWithoutSimd) {
    const std::vector<std::byte> file = makeJpeg(GetParam(), 67, 45);
    const std::vector<std::byte> fast = decoded(file);
    std::vector<std::byte> plain;
    {
        const filament_core::test::ScopedVariable none("JSIMD_FORCENONE", "1");
        std::thread([&] { plain = decoded(file); }).join();
    }
    EXPECT_EQ(fast, plain);
}

TEST_P(Jpegs, AreCloseToWhatWasCompressed) {
    const std::vector<std::byte> pixels = decoded(makeJpeg(GetParam(), 67, 45));
    ASSERT_EQ(pixels.size(), 67u * 45 * 4);
    double sum = 0;
    for (uint32_t i = 0; i < 67 * 45; ++i) {
        const auto expected = jpegPixel(GetParam(), i % 67, i / 67);
        for (size_t c = 0; c < 3; ++c)
            sum += std::abs(static_cast<double>(static_cast<uint8_t>(pixels[i * 4 + c])) - expected[c]);
        EXPECT_EQ(pixels[i * 4 + 3], std::byte{ 255 });
    }
    EXPECT_LT(sum / (67 * 45 * 3), 3.0);
}

TEST_P(Jpegs, ThatEndEarlyAreErrorsWithAPlace) {
    const std::vector<std::byte> file = makeJpeg(GetParam(), 24, 24);
    for (size_t size = 2; size + 2 < file.size(); size += 1 + size / 40) { // the last two bytes end the file
        const Result<Image> image = decodeImage(std::span(file).first(size), "a.jpg");
        ASSERT_FALSE(image) << size << " of " << file.size();
        EXPECT_THAT(image.error().message, HasSubstr("(at byte ")) << size;
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Jpegs, ::testing::ValuesIn(jpegKinds()),
                         [](auto const& each) { return jpegKindName(each.param); });

TEST(HostileJpegs, WithATableOfMoreThan256CodesAreErrors) {
    std::vector<std::byte> file = makeJpeg({}, 16, 16);
    const size_t table = findSegment(file, 0xC4);
    for (size_t i = 0; i < 16; ++i) file[table + 5 + i] = std::byte{ 255 }; // codes of each length
    const Result<Image> image = decodeImage(file, "dht.jpg");
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().message, HasSubstr("image 'dht.jpg' cannot be decoded: Bogus Huffman table"));
}

TEST(HostileJpegs, WhoseScanNamesAnUndefinedTableAreErrors) {
    std::vector<std::byte> file = makeJpeg({}, 16, 16);
    const size_t scan = findSegment(file, 0xDA);
    file[scan + 6] = std::byte{ 0x33 };
    const Result<Image> image = decodeImage(file, "sos.jpg");
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().message, HasSubstr("Huffman table 0x03 was not defined"));
}

TEST(HostileJpegs, OfHugeSizeAreRefusedBeforeAnythingIsAllocated) {
    std::vector<std::byte> file = makeJpeg({}, 16, 16);
    const size_t frame = findSegment(file, 0xC0);
    for (size_t i = 5; i < 9; ++i) file[frame + i] = std::byte{ 0xFF };
    EXPECT_THAT(decodeImage(file, "a.jpg").error().message, HasSubstr("65535 x 65535 pixels, more than 16384"));
}

TEST(HostilePngs, OfHugeSizeOrWithADamagedChunkAreErrors) {
    std::vector<std::byte> file = makePng({}, 16, 16).bytes;
    std::vector<std::byte> huge = file;
    huge[16] = std::byte{ 0x7F };
    EXPECT_THAT(decodeImage(huge, "a.png").error().message, HasSubstr("more than 16384"));
    file[file.size() - 30] ^= std::byte{ 1 };
    EXPECT_THAT(decodeImage(file, "a.png").error().message, HasSubstr("(at byte "));
}

TEST(ImageFuzz, ReplaysDamagedFilesWithoutACrash) {
    std::vector<std::vector<std::byte>> seeds;
    for (PngKind const& kind : pngKinds()) seeds.push_back(makePng(kind, 9, 7).bytes);
    for (JpegKind const& kind : jpegKinds()) seeds.push_back(makeJpeg(kind, 19, 17));
    std::mt19937 random(1);
    size_t pictures = 0;
    for (int round = 0; round < 4000; ++round) {
        std::vector<std::byte> file = seeds[random() % seeds.size()];
        for (auto i = random() % 6; i > 0; --i) file[random() % file.size()] = static_cast<std::byte>(random());
        if (random() % 4 == 0) file.resize(random() % file.size());
        pictures += fuzzImage(file);
        fuzzPicture(file);
    }
    EXPECT_GT(pictures, 100u);
}

} // namespace
} // namespace filament_core::assets::test
