// SPDX-License-Identifier: Apache-2.0
// Expected bytes are those of "OpenEXR File Layout" (openexr.com). OpenEXR 3.1 reads such files, too.
#include "filament_core/assets/image/ExrWriter.h"
#include "base/math/Half.h"
#include "filament_core/assets/image/HdrDecoders.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"

#include <gmock/gmock.h>

#include <bit>
#include <cstring>
#include <random>

namespace filament_core::assets {
namespace {

using ::testing::HasSubstr;
using std::operator""sv;

/// Up to the table of offsets: attributes as name, type, size, value.
std::string exrHeader(std::string_view channelList, std::string_view lastColumnAndRow) {
    const auto size = static_cast<char>(channelList.size());
    std::string header("\x76\x2F\x31\x01\2\0\0\0"
                       "channels\0chlist\0"sv);
    header += { size, 0, 0, 0 };
    header += channelList;
    header += "compression\0compression\0\1\0\0\0\3"sv;
    header += "dataWindow\0box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0"sv;
    header += lastColumnAndRow;
    header += "displayWindow\0box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0"sv;
    header += lastColumnAndRow;
    header += "lineOrder\0lineOrder\0\1\0\0\0\0"sv;
    header += "pixelAspectRatio\0float\0\4\0\0\0\0\0\x80\x3F"sv;
    header += "screenWindowCenter\0v2f\0\x08\0\0\0\0\0\0\0\0\0\0\0"sv;
    header += "screenWindowWidth\0float\0\4\0\0\0\0\0\x80\x3F"sv;
    header += "chromaticities\0chromaticities\0\x20\0\0\0"sv;
    for (const float value : { 0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f }) {
        for (uint32_t shift = 0; shift < 32; shift += 8)
            header += static_cast<char>(std::bit_cast<uint32_t>(value) >> shift & 0xFF);
    }
    return header + '\0';
}

std::string exrText(std::span<const std::byte> bytes) {
    return { reinterpret_cast<const char*>(bytes.data()), bytes.size() };
}

TEST(ExrWriter, LayersKeepTheirNamesAndTheirPrecision) {
    const std::array<uint16_t, 4> halves{ 0x243F, 0x6A88, 0x85A3, 0x08D3 }; // two pixels of two channels
    const std::array<uint32_t, 2> floats{ 0x13198A2E, 0x03707344 };         // two pixels of one
    const auto at = [](auto const& values, size_t i) { return reinterpret_cast<const std::byte*>(&values[i]); };
    const std::array<ExrSource, 3> sources{ { { "normal.Y", ExrType::Half, at(halves, 1), 4 },
                                              { "depth.Z", ExrType::Float, at(floats, 0), 4 },
                                              { "normal.X", ExrType::Half, at(halves, 0), 4 } } };
    const auto file = encodeExr(2, 1, sources);
    std::string expected = exrHeader("depth.Z\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0"
                                     "normal.X\0\1\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0"
                                     "normal.Y\0\1\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0\0"sv,
                                     "\1\0\0\0\0\0\0\0"sv);
    const size_t offset = expected.size() + 8;
    expected += { static_cast<char>(offset & 0xFF), static_cast<char>(offset >> 8), 0, 0, 0, 0, 0, 0 };
    expected += "\0\0\0\0\x10\0\0\0"sv; // row 0, 16 bytes
    expected += "\x2E\x8A\x19\x13\x44\x73\x70\x03"sv;
    expected += "\x3F\x24\xA3\x85\x88\x6A\xD3\x08"sv;
    EXPECT_EQ(exrText(file), expected);
}

/// Compressing does not make them smaller, so that no version of zlib matters.
TEST(ExrWriter, APictureOfFourPixelsHasTheBytesOfTheSpecification) {
    const std::array<uint16_t, 12> rgb{ 0x243F, 0x6A88, 0x85A3, 0x08D3, 0x1319, 0x8A2E,
                                        0x0370, 0x7344, 0xA409, 0x3822, 0x299F, 0x31D0 }; // of pi
    const auto file = encodeExr({ 2, 2, "RGB", ExrType::Half, std::as_bytes(std::span(rgb)) });
    std::string expected = exrHeader("B\0\1\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0"
                                     "G\0\1\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0"
                                     "R\0\1\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0\0"sv,
                                     "\1\0\0\0\1\0\0\0"sv);
    const size_t offset = expected.size() + 8;
    expected += { static_cast<char>(offset & 0xFF), static_cast<char>(offset >> 8), 0, 0, 0, 0, 0, 0 };
    expected += "\0\0\0\0\x18\0\0\0"sv; // row 0, 24 bytes
    expected += "\xA3\x85\x2E\x8A\x88\x6A\x19\x13\x3F\x24\xD3\x08"sv;
    expected += "\x09\xA4\xD0\x31\x44\x73\x9F\x29\x70\x03\x22\x38"sv;
    EXPECT_EQ(exrText(file), expected);
}

TEST(ExrWriter, ChannelsAreSortedAndNameTheirType) {
    const std::array<float, 4> rgba{ 1, 2, 3, 4 };
    const auto file = encodeExr({ 1, 1, "RGBA", ExrType::Float, std::as_bytes(std::span(rgba)) });
    const std::string header = exrHeader("A\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0"
                                         "B\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0"
                                         "G\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0"
                                         "R\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0\0"sv,
                                         "\0\0\0\0\0\0\0\0"sv);
    EXPECT_EQ(exrText(file).substr(0, header.size()), header);
    EXPECT_EQ(exrText(file).substr(header.size() + 16), "\0\0\x80\x40\0\0\x40\x40\0\0\0\x40\0\0\x80\x3F"sv);
}

/// Samples of any bits: NaNs with every payload, infinities, denormals. `kind` 1 repeats rows, 2 is even.
std::vector<std::byte> exrSamples(size_t count, ExrType type, size_t rowSamples, int kind) {
    std::mt19937 random(3);
    std::vector<std::byte> bytes;
    const size_t sampleBytes = type == ExrType::Half ? 2 : 4;
    for (size_t i = 0; i < count * sampleBytes; ++i) {
        const size_t row = rowSamples * sampleBytes;
        const auto any = static_cast<std::byte>(random());
        bytes.push_back(kind == 2 ? std::byte{ 0x3C } : kind == 1 && i >= row ? bytes[i - row] : any);
    }
    return bytes;
}

/// Follows the table of offsets: blocks of 16 rows without gaps. Returns the samples in the order of memory.
std::vector<std::byte> unpackedExr(std::span<const std::byte> file, ExrPixels const& pixels, size_t& rawBlocks) {
    std::string sorted(pixels.channels);
    std::ranges::sort(sorted);
    std::vector<ExrChannel> channels;
    for (const char name : sorted) channels.push_back({ { name }, pixels.type, false });
    const size_t header = exrHeader(std::string(sorted.size() * 18 + 1, ' '), std::string(8, ' ')).size();
    const size_t blocks = (pixels.height + 15) / 16, bytes = channels[0].bytes();
    ByteCursor table(file.subspan(header)), rest(file.subspan(header + blocks * 8));
    std::vector<std::byte> samples(pixels.samples.size()), rows;
    for (uint32_t y = 0; y < pixels.height; y += 16) {
        EXPECT_EQ(table.read<uint64_t>(), file.size() - rest.remaining());
        EXPECT_EQ(rest.read<uint32_t>(), y);
        const auto packed = rest.take(rest.read<uint32_t>().value_or(0));
        const ExrBlock block{ channels, pixels.width, std::min(pixels.height - y, 16u) };
        rows.resize(block.bytes());
        EXPECT_TRUE(packed && unpackExrBlock(ExrCompression::Zip, block, *packed, rows));
        rawBlocks += packed && packed->size() == rows.size();
        for (size_t i = 0; i < rows.size() / bytes; ++i) {
            const size_t x = i % pixels.width, channel = i / pixels.width % sorted.size();
            const size_t row = y + i / pixels.width / sorted.size();
            const size_t at = (row * pixels.width + x) * sorted.size() + pixels.channels.find(sorted[channel]);
            std::memcpy(&samples[at * bytes], &rows[i * bytes], bytes);
        }
    }
    EXPECT_EQ(rest.remaining(), 0u);
    return samples;
}

TEST(ExrWriter, EverySampleOfEveryChannelKeepsItsBits) {
    size_t rawBlocks = 0, allBlocks = 0;
    for (const auto& [width, height] :
         { std::pair(1u, 1u), { 1u, 40u }, { 31u, 15u }, { 7u, 16u }, { 13u, 17u }, { 301u, 33u } }) {
        for (const std::string_view channels : { "Y", "RGB", "RGBA" }) {
            for (int kind = 0; kind < 6; ++kind) {
                const ExrType type = kind < 3 ? ExrType::Half : ExrType::Float;
                const auto samples =
                        exrSamples(size_t{ width } * height * channels.size(), type, width * channels.size(), kind % 3);
                const ExrPixels pixels{ width, height, channels, type, samples };
                const auto file = encodeExr(pixels);
                ASSERT_EQ(unpackedExr(file, pixels, rawBlocks), samples) << width << " x " << height << channels;
                ASSERT_EQ(encodeExr(pixels), file) << "again";
                allBlocks += (height + 15) / 16;
            }
        }
    }
    EXPECT_GT(rawBlocks, allBlocks / 4) << "noise is not made larger";
    EXPECT_LT(rawBlocks, allBlocks / 2) << "what repeats is made smaller";
}

TEST(ExrWriter, OurReaderFindsTheBitsThatWereWritten) {
    for (const auto& [width, height] : { std::pair(1u, 1u), { 13u, 17u }, { 301u, 33u } }) {
        const size_t count = size_t{ width } * height * 3;
        const auto halves = exrSamples(count, ExrType::Half, 1, 0), floats = exrSamples(count, ExrType::Float, 1, 0);
        const auto half = decodeExr(encodeExr({ width, height, "RGB", ExrType::Half, halves }), HdrPart::All);
        const auto whole = decodeExr(encodeExr({ width, height, "RGB", ExrType::Float, floats }), HdrPart::All);
        ASSERT_TRUE(half && whole) << width;
        EXPECT_EQ(std::memcmp(whole->image.pixels.data(), floats.data(), floats.size()), 0) << width << " x " << height;
        for (size_t i = 0; i < count; ++i) {
            uint16_t bits = 0;
            std::memcpy(&bits, &halves[2 * i], 2);
            ASSERT_EQ(std::bit_cast<uint32_t>(half->image.pixels[i / 3][static_cast<int>(i % 3)]),
                      std::bit_cast<uint32_t>(floatFromHalf(bits)))
                    << i;
        }
    }
}

TEST(ExrWriter, WhatCannotBeWrittenIsAnErrorThatNamesThePath) {
    const TemporaryFolder folder;
    const std::vector<float3> pixel(1);
    ASSERT_TRUE(replaceFile(folder / "file", {}));
    const auto unwritable = writeExr(folder / "file" / "light.exr", 1, 1, pixel); // a file where a folder must be
    ASSERT_FALSE(unwritable);
    EXPECT_EQ(unwritable.error().code, ErrorCode::Unreadable);
    EXPECT_THAT(unwritable.error().message, HasSubstr("light.exr"));
    const auto full = writeExr("/dev/full", 1, 1, pixel);
    ASSERT_FALSE(full);
    EXPECT_EQ(full.error().code, ErrorCode::Unreadable);
    EXPECT_THAT(full.error().message, HasSubstr("/dev/full"));
    const std::vector<std::byte> row(size_t{ kMaxExrSide + 1 } * 8);
    const auto wide = writeExr(folder / "wide.exr", kMaxExrSide + 1, 1, row);
    ASSERT_FALSE(wide);
    EXPECT_EQ(wide.error().code, ErrorCode::Unreadable);
    EXPECT_THAT(wide.error().message, HasSubstr("4194305 x 1 pixels are more than 4194304 per side; make it smaller"));
    EXPECT_FALSE(std::filesystem::exists(folder / "wide.exr"));
}

} // namespace
} // namespace filament_core::assets
