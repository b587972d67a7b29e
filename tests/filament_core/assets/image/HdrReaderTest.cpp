// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/HdrReader.h"
#include "filament_core/assets/image/ExrWriter.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"
#include "tests/filament_core/assets/image/ImageFuzzBody.h"
#include "tests/filament_core/assets/image/StoredExr.h"

#include <gmock/gmock.h>

#include <limits>

namespace filament_core::assets {
namespace {

using ::testing::HasSubstr;

std::span<const std::byte> bytesOf(std::string const& text) { return std::as_bytes(std::span(text)); }

std::string rgbeFile(std::string const& resolution, std::string const& pixels, std::string const& more = "") {
    return "#?RADIANCE\n" + more + "FORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n" + pixels;
}

Result<HdrImage> decode(std::string const& file) { return decodeHdrImage(bytesOf(file), "sky.hdr"); }

// ---------------------------------------------------------------------------------------------- Radiance

TEST(HdrReader, AFlatPixelIsMantissaTimesTwoToTheExponentMinus136) {
    const auto image = decode(
            rgbeFile("-Y 1 +X 2", { char(128), char(64), char(0), char(129), char(255), char(1), char(2), char(0) }));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->at(0, 0), float3(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(image->at(1, 0), float3(0.0f)) << "exponent 0 is black whatever the mantissas say";
}

TEST(HdrReader, RunLengthsOf1991RepeatAndCopy) {
    std::string row{ 2, 2, 0, 8 };
    row += { char(128 + 8), char(128) };                   // red: eight times 128
    row += { 8, 0, 1, 2, 3, 4, 5, 6, 7 };                  // green: copied
    row += { char(128 + 3), 9, 1, 10, char(128 + 4), 11 }; // blue: mixed
    row += { char(128 + 8), char(136) };                   // exponent: times one
    const auto image = decode(rgbeFile("-Y 1 +X 8", row));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->at(5, 0), float3(128, 5, 11));
    EXPECT_EQ(image->at(2, 0), float3(128, 2, 9));
    EXPECT_EQ(image->at(3, 0), float3(128, 3, 10));
}

TEST(HdrReader, OldRunLengthsShiftByEightBitsEach) {
    const std::string pixel{ 1, 2, 3, char(136) }, two{ 1, 1, 1, 2 }, twoTimes256{ 1, 1, 1, 2 };
    const auto image = decode(rgbeFile("-Y 1 +X 515", pixel + two + twoTimes256));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->at(514, 0), float3(1, 2, 3));
}

TEST(HdrReader, RowsFromTheBottomAndColumnsFromTheRightAreTurned) {
    const std::string pixels{ 1, 0, 0, char(136), 2, 0, 0, char(136), 3, 0, 0, char(136), 4, 0, 0, char(136) };
    const auto image = decode(rgbeFile("+Y 2 -X 2", pixels));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->at(1, 1).x, 1);
    EXPECT_EQ(image->at(0, 1).x, 2);
    EXPECT_EQ(image->at(1, 0).x, 3);
    EXPECT_EQ(image->at(0, 0).x, 4);
}

TEST(HdrReader, ExposureLinesAreDividedOut) {
    const auto image = decode(rgbeFile("-Y 1 +X 1", { char(128), 0, 0, char(129) }, "EXPOSURE= 2.0\nEXPOSURE=2\n"));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_FLOAT_EQ(image->at(0, 0).x, 0.25f);
}

TEST(HdrReader, ErrorsNameTheFileTheReasonAndTheCure) {
    const auto xyze = decode("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd");
    EXPECT_EQ(xyze.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(xyze.error().message, HasSubstr("sky.hdr"));
    EXPECT_THAT(xyze.error().message, HasSubstr("32-bit_rle_xyze"));
    EXPECT_THAT(xyze.error().message, HasSubstr("save it as"));
    EXPECT_EQ(decode(rgbeFile("+X 1 -Y 1", "abcd")).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(decode(rgbeFile("-Y 0 +X 1", "abcd")).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(decode(rgbeFile("-Y 99999 +X 99999", "abcd")).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(decode(rgbeFile("-Y 2 +X 1", "abcd")).error().code, ErrorCode::Corrupt);
    EXPECT_EQ(decode("PNG or what").error().code, ErrorCode::Unsupported);
    EXPECT_EQ(decode("").error().code, ErrorCode::Unsupported);
    EXPECT_EQ(readHdrImage("/no/such/sky.hdr").error().code, ErrorCode::NotFound);
    EXPECT_EQ(readHdrImage(std::filesystem::temp_directory_path()).error().code, ErrorCode::Unreadable);
}

// ---------------------------------------------------------------------------------------------- OpenEXR

HdrImage testPicture(uint32_t width = 23, uint32_t height = 37) {
    HdrImage image{ .width = width, .height = height, .pixels = {}, .repairs = {} };
    for (uint32_t i = 0; i < width * height; ++i) {
        image.pixels.emplace_back(float(i % 7), float(i) * 0.25f, i % 5 == 0 ? 1000.0f : 0.125f);
    }
    return image;
}

/// `channels` of one letter have the blue component.
std::vector<std::byte> floatExr(HdrImage const& image, std::string_view channels = "RGB") {
    std::vector<float> samples;
    for (float3 const& pixel : image.pixels)
        for (size_t c = 3 - channels.size(); c < 3; ++c) samples.push_back(pixel[static_cast<int>(c)]);
    return encodeExr({ image.width, image.height, channels, ExrType::Float, std::as_bytes(std::span(samples)) });
}

TEST(HdrReader, ALoneLuminanceChannelServesAllColours) {
    const auto grey = decodeHdrImage(floatExr(testPicture(), "Y"), "grey.exr");
    ASSERT_TRUE(grey) << grey.error().message;
    EXPECT_EQ(grey->at(0, 0), float3(1000.0f));
}

TEST(HdrReader, AnExrWithoutColourChannelsIsRefused) {
    const auto depth = decodeHdrImage(floatExr(testPicture(), "Z"), "depth.exr");
    ASSERT_FALSE(depth);
    EXPECT_EQ(depth.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(depth.error().message, HasSubstr("neither channels R, G, B nor Y"));
}

TEST(HdrReader, WhatCannotBeLightIsReplacedAndCounted) {
    HdrImage broken = testPicture(8, 8);
    broken.at(1, 0) = float3(std::numeric_limits<float>::quiet_NaN(), -1.0f, 2.0f);
    broken.at(2, 0) = float3(std::numeric_limits<float>::infinity(), 0.0f, -std::numeric_limits<float>::infinity());
    const auto read = decodeHdrImage(floatExr(broken), "broken.exr");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->repairs, (HdrRepairs{ .notANumber = 1, .infinite = 1, .negative = 2 }));
    EXPECT_EQ(read->at(1, 0), float3(0, 0, 2));
    EXPECT_EQ(read->at(2, 0), float3(1000, 0, 0)) << "infinity becomes the largest finite value";
    EXPECT_EQ(decodeHdrImage(floatExr(testPicture()), "x")->repairs, HdrRepairs{});
}

// ---------------------------------------------------------------------------------------------- damage

void expectSurvival(std::vector<std::byte> const& file, uint32_t mutations) {
    for (size_t size = 0; size < file.size(); size += 1 + file.size() / 512) {
        const auto cut = decodeHdrImage(std::span(file).first(size), "cut");
        EXPECT_FALSE(cut) << "only " << size << " of " << file.size() << " bytes";
    }
    for (uint32_t seed = 0; seed < mutations; ++seed) {
        const auto result = decodeHdrImage(damaged(file, seed), "damaged");
        if (!result) {
            EXPECT_FALSE(result.error().message.empty());
            continue;
        }
        EXPECT_EQ(result->pixels.size(), size_t(result->width) * result->height);
        for (float3 const& pixel : result->pixels) {
            for (int c = 0; c < 3; ++c) ASSERT_TRUE(pixel[c] >= 0 && pixel[c] <= kMaxRadiance) << "seed " << seed;
        }
    }
}

TEST(HdrReader, DamagedRadianceFilesNeverCrash) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeHdr(folder / "picture.hdr", testPicture()));
    const auto file = readFileBytes(folder / "picture.hdr");
    ASSERT_TRUE(file);
    expectSurvival(*file, 3000);
}

TEST(HdrReader, DamagedExrFilesNeverCrash) {
    for (const char* name : { "plain", "rle_half", "zips_half", "zip_half", "piz_half" })
        expectSurvival(storedExr(name), 1000);
}

TEST(HdrReader, DamagedFilesKeepEveryPromiseOfTheFuzzer) {
    std::vector<std::vector<std::byte>> files;
    for (const char* name : { "plain_float", "rle_float", "zips_float", "zip_float", "piz_float" })
        files.push_back(storedExr(name));
    size_t pictures = 0;
    for (uint32_t seed = 0; seed < 500; ++seed) {
        const std::vector<std::byte> file = damaged(files[seed % 5], seed, 2);
        pictures += test::fuzzHdrImage(file);
        test::fuzzPicture(file);
    }
    EXPECT_GT(pictures, 50u);
}

} // namespace
} // namespace filament_core::assets
