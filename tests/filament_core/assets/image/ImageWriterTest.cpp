// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ImageWriter.h"
#include "base/math/Half.h"
#include "filament_core/assets/image/HdrReader.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"

#include <zlib.h>

#include <cmath>
#include <cstring>

namespace filament_core::assets {
namespace {

using Bytes = std::vector<uint8_t>;

std::vector<std::byte> noise(size_t count) {
    std::mt19937 random(7);
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    return bytes;
}

TEST(ImageWriter, APngGivesBackTheBytesThatWereWritten) {
    const TemporaryFolder folder;
    const std::vector<std::byte> pixels = noise(31 * 17 * 4); // also the largest a PNG of this size can get
    ASSERT_TRUE(writePng(folder / "noise.png", 31, 17, pixels));
    const auto read = readPng(folder / "noise.png");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->width, 31u);
    EXPECT_EQ(read->height, 17u);
    EXPECT_EQ(read->data, pixels);
}

TEST(ImageWriter, ReadingWhatIsNoPngNamesTheFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(readPng(folder / "none.png").error().code, ErrorCode::NotFound);
    ASSERT_TRUE(replaceFile(folder / "text.png", noise(100)));
    const auto text = readPng(folder / "text.png");
    ASSERT_FALSE(text);
    EXPECT_NE(text.error().message.find("text.png"), std::string::npos);
}

TEST(ImageWriter, APathThatCannotBeWrittenIsAnErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    ASSERT_TRUE(replaceFile(folder / "file", noise(4)));
    const auto written = writePng(folder / "file" / "picture.png", 1, 1, noise(4)); // a file where a folder must be
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::Unreadable);
    EXPECT_NE(written.error().message.find("picture.png"), std::string::npos);
}

TEST(ImageWriter, ReplacingAFileLeavesNoTemporaryBehind) {
    const TemporaryFolder folder;
    ASSERT_TRUE(replaceFile(folder / "a" / "b" / "file", noise(10)));
    ASSERT_TRUE(replaceFile(folder / "a" / "b" / "file", noise(20)));
    EXPECT_EQ(readFileBytes(folder / "a" / "b" / "file").value(), noise(20));
    size_t files = 0;
    for ([[maybe_unused]] auto const& entry : std::filesystem::directory_iterator(folder / "a" / "b")) ++files;
    EXPECT_EQ(files, 1u);
}

TEST(ImageWriter, FloatExrsAreExactAndHalfExrsAreRoundedAndClamped) {
    const TemporaryFolder folder;
    const std::vector<float3> pixels{ float3(0.1f, 1.0f, 3e12f), float3(2.0f, 1e-3f, 0.0f) };
    ASSERT_TRUE(writeExr(folder / "float.exr", 2, 1, pixels, ExrPrecision::Float));
    ASSERT_TRUE(writeExr(folder / "half.exr", 2, 1, pixels, ExrPrecision::Half));
    EXPECT_EQ(readHdrImage(folder / "float.exr")->pixels, pixels);
    const auto half = readHdrImage(folder / "half.exr");
    EXPECT_EQ(half->pixels[0], float3(floatFromHalf(halfFromFloat(0.1f)), 1.0f, kMaxHalf));
}

TEST(ImageWriter, HalfPixelsOfTheRendererReachTheExrBitForBit) {
    const TemporaryFolder folder;
    const std::array<uint16_t, 8> texels{ halfFromFloat(0.3f),     halfFromFloat(7.0f),   halfFromFloat(0.0f),
                                          halfFromFloat(1.0f),     halfFromFloat(100.0f), halfFromFloat(0.5f),
                                          halfFromFloat(60000.0f), halfFromFloat(1.0f) };
    ASSERT_TRUE(writeExr(folder / "frame.exr", 2, 1, std::as_bytes(std::span(texels))));
    const auto read = readHdrImage(folder / "frame.exr");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->pixels[0], float3(floatFromHalf(texels[0]), 7.0f, 0.0f));
    EXPECT_EQ(read->pixels[1], float3(100.0f, 0.5f, floatFromHalf(texels[6])));
}

TEST(ImageWriter, RgbeKeepsTheLargestComponentWithinHalfAStepOfEightBits) {
    const TemporaryFolder folder;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> exponent(-20, 30);
    HdrImage image{ .width = 64, .height = 16, .pixels = {}, .repairs = {} };
    for (int i = 0; i < 64 * 16; ++i) {
        // the first rows repeat, so that run lengths are used as well
        const float value = i < 256 ? 0.75f : std::exp2(exponent(random));
        image.pixels.emplace_back(value, 0.5f * value, 0.0f);
    }
    ASSERT_TRUE(writeHdr(folder / "a.hdr", image));
    const auto read = readHdrImage(folder / "a.hdr");
    ASSERT_TRUE(read) << read.error().message;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        EXPECT_NEAR(read->pixels[i].x / image.pixels[i].x, 1.0f, 1.0f / 256);
        EXPECT_NEAR(read->pixels[i].y / image.pixels[i].y, 1.0f, 1.0f / 128);
        EXPECT_EQ(read->pixels[i].z, 0.0f);
    }
    EXPECT_EQ(read->pixels[0].x, 0.75f);
}

TEST(ImageWriter, RgbeOfNarrowPicturesIsWrittenFlat) {
    const TemporaryFolder folder;
    const HdrImage image{
        .width = 3, .height = 1, .pixels = { float3(1), float3(2), float3(-4, 4, 0) }, .repairs = {}
    };
    ASSERT_TRUE(writeHdr(folder / "narrow.hdr", image));
    const auto read = readHdrImage(folder / "narrow.hdr");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->pixels[1], float3(2.0f));
    EXPECT_EQ(read->pixels[2], float3(0, 4, 0)) << "negative light becomes black";
}

TEST(ImageLevels, OffsetsOfACubeCountAllFacesAndLevels) {
    const Image cube{
        .width = 8, .height = 8, .layers = 6, .levels = 4, .format = backend::Format::RGBA16F, .data = {}
    };
    EXPECT_EQ(cube.levelBytes(0), 6u * 64 * 8);
    EXPECT_EQ(cube.levelBytes(3), 6u * 8);
    EXPECT_EQ(cube.levelOffset(0), 0u);
    EXPECT_EQ(cube.levelOffset(4), 6u * 8 * (64 + 16 + 4 + 1));
    const Image blocks{ .width = 10, .height = 2, .levels = 2, .format = backend::Format::BC1, .data = {} };
    EXPECT_EQ(blocks.levelBytes(0), 3u * 8) << "partial blocks count whole";
}

/// Name and data of every chunk; expects that their checksums are right, because libpng reads the file.
std::vector<std::pair<std::string, std::vector<int>>> chunksOf(std::filesystem::path const& path) {
    const std::vector<std::byte> bytes = readFileBytes(path).value();
    std::vector<std::pair<std::string, std::vector<int>>> chunks;
    for (size_t at = 8; at + 12 <= bytes.size();) {
        size_t size = 0;
        for (size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<size_t>(bytes[at + i]);
        auto& [name, data] = chunks.emplace_back();
        for (size_t i = 4; i < 8; ++i) name += static_cast<char>(bytes[at + i]);
        for (size_t i = 0; i < size; ++i) data.push_back(static_cast<int>(bytes[at + 8 + i]));
        at += size + 12;
    }
    EXPECT_TRUE(readPng(path).ok());
    return chunks;
}

std::vector<std::string> namesOf(std::filesystem::path const& path) {
    std::vector<std::string> names;
    for (auto const& [name, data] : chunksOf(path)) names.push_back(name);
    return names;
}

TEST(ImageWriter, PngsNameTheirColourSpace) {
    const TemporaryFolder folder;
    const auto written = [&](OutputSpace space) {
        const std::filesystem::path path = folder / (std::string(toString(space)) + ".png");
        EXPECT_TRUE(writePng(path, 3, 2, noise(24), space));
        return path;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(namesOf(written(OutputSpace::Srgb)), (Names{ "IHDR", "sRGB", "IDAT", "IEND" }));
    EXPECT_EQ(namesOf(written(OutputSpace::LinearRec709)), (Names{ "IHDR", "cICP", "gAMA", "cHRM", "IDAT", "IEND" }));
    EXPECT_EQ(namesOf(written(OutputSpace::DisplayP3)), (Names{ "IHDR", "cICP", "gAMA", "cHRM", "IDAT", "IEND" }));
    EXPECT_EQ(namesOf(written(OutputSpace::Rec2020Pq)), (Names{ "IHDR", "cICP", "cHRM", "IDAT", "IEND" }));
    const auto dataOf = [&](OutputSpace space) { return chunksOf(written(space))[1].second; };
    EXPECT_EQ(dataOf(OutputSpace::LinearRec709), (std::vector{ 1, 8, 0, 1 }));
    EXPECT_EQ(dataOf(OutputSpace::DisplayP3), (std::vector{ 12, 13, 0, 1 }));
    EXPECT_EQ(dataOf(OutputSpace::Rec2020Pq), (std::vector{ 9, 16, 0, 1 }));
    EXPECT_EQ(chunksOf(written(OutputSpace::DisplayP3))[2].second, (std::vector{ 0, 0, 177, 143 })) << "45 455";
}

/// The rows of a PNG that writePng16() wrote, as codes of 16 bits: inflated, and filter 1 undone.
std::vector<uint32_t> codesOf16(std::filesystem::path const& path, uint32_t width, uint32_t height) {
    Bytes packed;
    for (auto const& [name, data] : chunksOf(path)) {
        if (name != "IDAT") continue;
        for (const int byte : data) packed.push_back(static_cast<uint8_t>(byte));
    }
    const size_t rowBytes = size_t{ width } * 6 + 1;
    Bytes rows(rowBytes * height);
    uLongf size = static_cast<uLongf>(rows.size());
    EXPECT_EQ(uncompress(rows.data(), &size, packed.data(), static_cast<uLong>(packed.size())), Z_OK);
    EXPECT_EQ(size, rows.size());
    std::vector<uint32_t> codes;
    for (size_t y = 0; y < height; ++y) {
        uint8_t* const row = rows.data() + y * rowBytes;
        EXPECT_EQ(row[0], 1);
        for (size_t i = 7; i < rowBytes; ++i) row[i] = static_cast<uint8_t>(row[i] + row[i - 6]);
        for (size_t i = 1; i < rowBytes; i += 2) codes.push_back(static_cast<uint32_t>(row[i] << 8 | row[i + 1]));
    }
    return codes;
}

/// Every code of ten bits in every channel, in rows of 33: the last row is not full.
TEST(ImageWriter, PngsOf16BitsHoldAllCodesOfTen) {
    constexpr uint32_t kWidth = 33, kHeight = 32;
    const TemporaryFolder folder;
    std::vector<uint32_t> words(kWidth * kHeight);
    for (uint32_t i = 0; i < words.size(); ++i)
        words[i] = i % 1024 | (i * 7 + 3) % 1024 << 10 | (1023 - i % 1024) << 20 | i % 4 << 30;
    const auto bytes = std::as_bytes(std::span(words));
    ASSERT_TRUE(writePng16(folder / "ten.png", kWidth, kHeight, bytes));
    const std::vector<uint32_t> codes = codesOf16(folder / "ten.png", kWidth, kHeight);
    const auto read = readPng(folder / "ten.png"); // in eight bits
    ASSERT_TRUE(read);
    ASSERT_EQ(codes.size(), words.size() * 3);
    for (size_t i = 0; i < words.size(); ++i) {
        for (uint32_t c = 0; c < 3; ++c) {
            const uint32_t ten = words[i] >> 10 * c & 1023, wide = codes[3 * i + c];
            ASSERT_EQ(wide, static_cast<uint32_t>(std::lround(ten * 65535.0 / 1023))) << ten;
            ASSERT_EQ((wide * 1023 + 32767) / 65535, ten) << "and back";
            ASSERT_EQ(std::to_integer<uint32_t>(read->data[4 * i + c]),
                      static_cast<uint32_t>(std::lround(wide * 255.0 / 65535)))
                    << ten;
        }
        ASSERT_EQ(read->data[4 * i + 3], std::byte{ 255 });
    }
}

TEST(ImageWriter, PngsOf16BitsNameTheirColourSpaceAndTheirBits) {
    const TemporaryFolder folder;
    const auto written = [&](OutputSpace space) {
        const std::filesystem::path path = folder / (std::string(toString(space)) + ".png");
        EXPECT_TRUE(writePng16(path, 3, 2, noise(24), space));
        return path;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(namesOf(written(OutputSpace::Srgb)), (Names{ "IHDR", "sRGB", "sBIT", "IDAT", "IEND" }));
    EXPECT_EQ(namesOf(written(OutputSpace::DisplayP3)),
              (Names{ "IHDR", "cICP", "gAMA", "cHRM", "sBIT", "IDAT", "IEND" }));
    EXPECT_EQ(namesOf(written(OutputSpace::Rec2020Pq)), (Names{ "IHDR", "cICP", "cHRM", "sBIT", "IDAT", "IEND" }));
    const auto chunks = chunksOf(written(OutputSpace::Rec2020Pq));
    EXPECT_EQ(chunks[0].second, (std::vector{ 0, 0, 0, 3, 0, 0, 0, 2, 16, 2, 0, 0, 0 })) << "16 bits of RGB";
    EXPECT_EQ(chunks[1].second, (std::vector{ 9, 16, 0, 1 }));
    EXPECT_EQ(chunks[3].second, (std::vector{ 10, 10, 10 }));
}

TEST(ImageWriter, EveryExrSaysThatItIsRec709) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeExr(folder / "light.exr", 2, 1, std::vector{ float3(1), float3(2) }, ExrPrecision::Float));
    const std::vector<std::byte> bytes = readFileBytes(folder / "light.exr").value();
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string_view attribute("chromaticities\0chromaticities\0\x20\0\0\0", 34);
    const size_t at = text.find(attribute);
    ASSERT_NE(at, std::string_view::npos);
    std::array<float, 8> values{};
    std::memcpy(values.data(), bytes.data() + at + attribute.size(), sizeof(values));
    EXPECT_EQ(values, (std::array{ 0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f }));
}

} // namespace
} // namespace filament_core::assets
