// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/HdrReader.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"
#include "tests/filament_core/assets/image/ImageFuzzBody.h"

#include <gmock/gmock.h>
#include <tinyexr.h>

#include <cstdlib>
#include <limits>

namespace filament::assets {
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

// Uses libtinyexr to write files for our own reader.
std::vector<std::byte> exrFile(HdrImage const& image, int compression, bool half,
                               std::vector<const char*> names = { "B", "G", "R" }) {
    EXRHeader header;
    InitEXRHeader(&header);
    EXRImage planes;
    InitEXRImage(&planes);
    std::vector<EXRChannelInfo> channels(names.size());
    std::vector<std::vector<float>> samples(names.size());
    std::vector<unsigned char*> pointers;
    for (size_t c = 0; c < names.size(); ++c) {
        std::snprintf(channels[c].name, sizeof(channels[c].name), "%s", names[c]);
        for (float3 const& pixel : image.pixels) samples[c].push_back(pixel[static_cast<int>(2 - c % 3)]);
        pointers.push_back(reinterpret_cast<unsigned char*>(samples[c].data()));
    }
    std::vector<int> from(names.size(), TINYEXR_PIXELTYPE_FLOAT);
    std::vector<int> to(names.size(), half ? TINYEXR_PIXELTYPE_HALF : TINYEXR_PIXELTYPE_FLOAT);
    header.num_channels = planes.num_channels = static_cast<int>(names.size());
    header.channels = channels.data();
    header.pixel_types = from.data();
    header.requested_pixel_types = to.data();
    header.compression_type = compression;
    planes.images = pointers.data();
    planes.width = static_cast<int>(image.width);
    planes.height = static_cast<int>(image.height);
    unsigned char* memory = nullptr;
    const char* reason = nullptr;
    const size_t size = SaveEXRImageToMemory(&planes, &header, &memory, &reason);
    const auto* first = reinterpret_cast<const std::byte*>(memory);
    std::vector<std::byte> bytes(first, first + size);
    std::free(memory);
    return bytes;
}

constexpr std::array<int, 5> kCompressions{ TINYEXR_COMPRESSIONTYPE_NONE, TINYEXR_COMPRESSIONTYPE_RLE,
                                            TINYEXR_COMPRESSIONTYPE_ZIPS, TINYEXR_COMPRESSIONTYPE_ZIP,
                                            TINYEXR_COMPRESSIONTYPE_PIZ };

TEST(HdrReader, EveryCompressionOfOpenExrGivesThePixelsThatWereWritten) {
    const HdrImage written = testPicture();
    for (const int compression : kCompressions) {
        for (const bool half : { true, false }) {
            const auto read = decodeHdrImage(exrFile(written, compression, half), "x.exr");
            ASSERT_TRUE(read) << compression << ": " << read.error().message;
            EXPECT_EQ(read->pixels, written.pixels) << "compression " << compression << ", half " << half;
        }
    }
}

TEST(HdrReader, ALoneLuminanceChannelServesAllColours) {
    const auto grey = decodeHdrImage(exrFile(testPicture(), TINYEXR_COMPRESSIONTYPE_ZIP, true, { "Y" }), "grey.exr");
    ASSERT_TRUE(grey) << grey.error().message;
    EXPECT_EQ(grey->at(0, 0), float3(1000.0f));
}

TEST(HdrReader, AnExrWithoutColourChannelsIsRefused) {
    const auto depth = decodeHdrImage(exrFile(testPicture(), TINYEXR_COMPRESSIONTYPE_ZIP, true, { "Z" }), "depth.exr");
    ASSERT_FALSE(depth);
    EXPECT_EQ(depth.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(depth.error().message, HasSubstr("neither channels R, G, B nor Y"));
}

TEST(HdrReader, WhatCannotBeLightIsReplacedAndCounted) {
    HdrImage broken = testPicture(8, 8);
    broken.at(1, 0) = float3(std::numeric_limits<float>::quiet_NaN(), -1.0f, 2.0f);
    broken.at(2, 0) = float3(std::numeric_limits<float>::infinity(), 0.0f, -std::numeric_limits<float>::infinity());
    const auto read = decodeHdrImage(exrFile(broken, TINYEXR_COMPRESSIONTYPE_NONE, false), "broken.exr");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->repairs, (HdrRepairs{ .notANumber = 1, .infinite = 1, .negative = 2 }));
    EXPECT_EQ(read->at(1, 0), float3(0, 0, 2));
    EXPECT_EQ(read->at(2, 0), float3(1000, 0, 0)) << "infinity becomes the largest finite value";
    EXPECT_EQ(decodeHdrImage(exrFile(testPicture(), TINYEXR_COMPRESSIONTYPE_NONE, false), "x")->repairs, HdrRepairs{});
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
    for (const int compression : kCompressions) expectSurvival(exrFile(testPicture(), compression, true), 1000);
}

// More words than 14 bits number, sides that are no powers of two, one row, one column, and blocks that end early.
TEST(HdrReader, PizGivesThePixelsOfEverySizeAndRange) {
    std::mt19937 random(5);
    for (const auto& [width, height] :
         { std::pair(1u, 1u), { 1u, 40u }, { 200u, 1u }, { 64u, 64u }, { 131u, 70u }, { 300u, 200u } }) {
        HdrImage written{ .width = width, .height = height, .pixels = {}, .repairs = {} };
        for (uint32_t i = 0; i < width * height; ++i) {
            const auto bits = static_cast<float>(random() % 30000);
            written.pixels.emplace_back(bits, i % 11 == 0 ? 0.0f : 0.5f, std::ldexp(bits, static_cast<int>(i % 5)));
        }
        for (const bool half : { true, false }) {
            const auto piz = decodeHdrImage(exrFile(written, TINYEXR_COMPRESSIONTYPE_PIZ, half), "x.exr");
            const auto zip = decodeHdrImage(exrFile(written, TINYEXR_COMPRESSIONTYPE_ZIP, half), "x.exr");
            ASSERT_TRUE(piz && zip) << width << " x " << height << ": " << (piz ? "" : piz.error().message);
            EXPECT_EQ(piz->pixels, zip->pixels) << width << " x " << height << ", half " << half;
        }
    }
}

TEST(HdrReader, DamagedFilesKeepEveryPromiseOfTheFuzzer) {
    std::vector<std::vector<std::byte>> files;
    for (const int compression : kCompressions) files.push_back(exrFile(testPicture(), compression, false));
    size_t pictures = 0;
    for (uint32_t seed = 0; seed < 500; ++seed) {
        const std::vector<std::byte> file = damaged(files[seed % 5], seed, 2);
        pictures += test::fuzzHdrImage(file);
        test::fuzzPicture(file);
    }
    EXPECT_GT(pictures, 50u);
}

} // namespace
} // namespace filament::assets
