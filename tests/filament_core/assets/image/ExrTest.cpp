// SPDX-License-Identifier: Apache-2.0
// OpenEXR files that OpenEXR itself wrote (tests/fuzz/corpus/exr): every compression, tiles, layers.
#include "base/math/Half.h"
#include "filament_core/assets/image/ExrBlock.h"
#include "filament_core/assets/image/HdrReader.h"
#include "tests/filament_core/assets/image/HdrTestSupport.h"
#include "tests/filament_core/assets/image/ImageFuzzBody.h"
#include "tests/filament_core/assets/image/StoredExr.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include <bit>
#include <random>
#include <set>
#include <string>

namespace filament_core::assets {
namespace {

using testing::HasSubstr;

HdrImage exrPicture(std::string const& name) {
    const Result<HdrImage> picture = decodeHdrImage(storedExr(name), name);
    EXPECT_TRUE(picture) << picture.error().message;
    return picture ? *picture : HdrImage{};
}

TEST(Exr, WhatLosesNothingHasThePixelsThatWereWritten) {
    const HdrImage plain = exrPicture("plain");
    EXPECT_EQ(plain.width, 13u);
    EXPECT_EQ(plain.at(12, 0), float3(0.25f)) << "the even corner";
    for (const char* name :
         { "rle_half", "zips_half", "zip_half", "piz_half", "pxr24_half", "tiled_zip", "tiled_piz_mips" })
        EXPECT_EQ(exrPicture(name).pixels, plain.pixels) << name;
    const HdrImage plainFloat = exrPicture("plain_float");
    for (size_t i = 0; i < plain.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_EQ(halfFromFloat(plainFloat.pixels[i][c]), halfFromFloat(plain.pixels[i][c])) << i;
    for (const char* name : { "rle_float", "zips_float", "zip_float", "piz_float" })
        EXPECT_EQ(exrPicture(name).pixels, plainFloat.pixels) << name;
}

/// What writePiz() in write.cpp wrote.
HdrImage pizPicture(uint32_t width, uint32_t height, bool isFloat) {
    std::mt19937 random(5);
    HdrImage image{ .width = width, .height = height, .pixels = {}, .repairs = {} };
    const uint32_t first = isFloat ? 0x3F800000 : 0x0400;
    const auto value = [&](uint32_t bits) {
        return isFloat ? std::bit_cast<float>(bits) : floatFromHalf(static_cast<uint16_t>(bits));
    };
    for (uint32_t i = 0; i < width * height; ++i) {
        const auto number = i % 32 == 0 ? static_cast<uint32_t>(random() % 12000) : i;
        image.pixels.emplace_back(value(first + 2 * number), i % 11 == 0 ? 1.0f : 0.5f, value(first + 2 * number + 1));
    }
    return image;
}

// Sides that are no powers of two, one row, one column, blocks that end early, and words of more than 14 bits.
TEST(Exr, PizGivesThePixelsOfEverySizeAndRange) {
    for (const auto& [width, height] :
         { std::pair(1u, 1u), { 1u, 40u }, { 200u, 1u }, { 64u, 64u }, { 131u, 70u }, { 300u, 40u } }) {
        for (const bool isFloat : { false, true }) {
            const std::string name = fmt::format("piz_{}x{}_{}", width, height, isFloat ? "float" : "half");
            EXPECT_EQ(exrPicture(name).pixels, pizPicture(width, height, isFloat).pixels) << name;
        }
    }
    std::set<uint16_t> words;
    const HdrImage wide = pizPicture(300, 40, false);
    for (float3 const& pixel : std::span(wide.pixels).first(size_t{ 300 } * 32))
        for (int c = 0; c < 3; ++c) words.insert(halfFromFloat(pixel[c]));
    EXPECT_GT(words.size(), 1u << 14) << "of the first block";
}

TEST(Exr, CodingsOfIntegersHaveThePixelsThatOpenExrReads) {
    for (const std::string name : { "pxr24_float", "b44", "b44a", "b44_perceptual" })
        EXPECT_EQ(exrPicture(name).pixels, exrPicture(name + ".decoded").pixels) << name;
}

// OpenEXR computes cosines in the order that the CPU has instructions for, so that a value may be rounded to the next
// half before the curve, which makes at most 0.3 % of it.
TEST(Exr, CosinesHaveThePixelsThatOpenExrReadsButForRounding) {
    for (const std::string name : { "dwaa", "dwaa_float", "dwaa_one_block", "dwab", "tiled_dwaa_rips" }) {
        const HdrImage picture = exrPicture(name), expected = exrPicture(name + ".decoded");
        ASSERT_EQ(picture.pixels.size(), expected.pixels.size()) << name;
        size_t others = 0;
        for (size_t i = 0; i < picture.pixels.size(); ++i) {
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(picture.pixels[i][c], expected.pixels[i][c], 0.003f * expected.pixels[i][c]) << name;
            others += picture.pixels[i] != expected.pixels[i];
        }
        EXPECT_LE(others, picture.pixels.size() / 100) << name;
    }
}

/// FNV-1a of the bits.
uint64_t hashOf(HdrImage const& picture) {
    uint64_t hash = 0xCBF29CE484222325;
    for (float3 const& pixel : picture.pixels)
        for (int c = 0; c < 3; ++c) hash = (hash ^ std::bit_cast<uint32_t>(pixel[c])) * 0x100000001B3;
    return hash;
}

TEST(Exr, CosinesHaveTheSameBitsOnEveryCpu) {
    EXPECT_EQ(hashOf(exrPicture("dwaa")), 9307789531145766199u);
    EXPECT_EQ(hashOf(exrPicture("dwaa_float")), 4523728369246045079u);
    EXPECT_EQ(hashOf(exrPicture("dwab")), 13051039052014748983u);
}

// ---------------------------------------------------------------------------------------------- other blocks

/// A DWA file with one block, taken apart.
struct OneBlock {
    static constexpr size_t kSizes = 11, kVersion = 0, kPackedWords = 3, kWords = 8, kCoding = 10;

    std::vector<std::byte> header; ///< up to the size of the block
    std::array<uint64_t, kSizes> sizes{};
    std::vector<std::byte> rules, words, rest;

    explicit OneBlock(std::vector<std::byte> const& file) {
        size_t block = 8;
        const auto read = [&]<class T>(size_t at, T& value) { std::memcpy(&value, &file[at], sizeof value); };
        for (uint64_t offset = 0; offset != block; ++block) read(block + 1 - 8, offset);
        header.assign(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(block + 4));
        size_t at = block + 8;
        read(at, sizes);
        at += sizeof sizes;
        uint16_t rulesSize = 0;
        read(at, rulesSize);
        const auto take = [&](size_t count) {
            const auto first = file.begin() + static_cast<std::ptrdiff_t>(at);
            at += count;
            return std::vector<std::byte>(first, first + static_cast<std::ptrdiff_t>(count));
        };
        rules = take(rulesSize);
        words = take(static_cast<size_t>(sizes[kPackedWords]));
        rest = take(file.size() - at);
    }

    std::vector<std::byte> file() const {
        std::vector<std::byte> bytes = header;
        const auto add = [&](std::span<const std::byte> part) { bytes.insert(bytes.end(), part.begin(), part.end()); };
        const auto size = static_cast<uint32_t>(sizeof sizes + rules.size() + words.size() + rest.size());
        add(std::as_bytes(std::span(&size, 1)));
        add(std::as_bytes(std::span(sizes)));
        add(rules);
        add(words);
        add(rest);
        return bytes;
    }
};

TEST(Exr, WordsOfCosinesMayBeAZlibStream) {
    const std::vector<std::byte> file = storedExr("dwaa_one_block");
    OneBlock block(file);
    EXPECT_EQ(block.file(), file);
    ASSERT_EQ(block.sizes[OneBlock::kCoding], 0u);
    std::vector<uint16_t> words(block.sizes[OneBlock::kWords]);
    ASSERT_TRUE(expandHuffman(block.words, words));
    uLongf packed = compressBound(words.size() * 2);
    block.words.resize(packed);
    ASSERT_EQ(compress(reinterpret_cast<Bytef*>(block.words.data()), &packed,
                       reinterpret_cast<Bytef const*>(words.data()), words.size() * 2),
              Z_OK);
    block.words.resize(packed);
    block.sizes[OneBlock::kPackedWords] = packed;
    block.sizes[OneBlock::kCoding] = 1;
    const Result<HdrImage> picture = decodeHdrImage(block.file(), "zlib");
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(picture->pixels, exrPicture("dwaa_one_block").pixels);
}

TEST(Exr, TheFirstVersionOfCosinesHasNoRulesOfItsOwn) {
    OneBlock block(storedExr("dwaa_one_block"));
    block.sizes[OneBlock::kVersion] = 1;
    block.rules.clear();
    const Result<HdrImage> picture = decodeHdrImage(block.file(), "version 1");
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(picture->pixels, exrPicture("dwaa_one_block").pixels);
    block.sizes[OneBlock::kVersion] = 3;
    const Result<HdrImage> later = decodeHdrImage(block.file(), "version 3");
    ASSERT_FALSE(later);
    EXPECT_THAT(later.error().message, HasSubstr("the block at 0, 0 cannot be unpacked"));
}

// ---------------------------------------------------------------------------------------------- damage

TEST(Exr, DamagedFilesAreRefusedOrReadWhole) {
    for (const char* name : { "pxr24_half", "pxr24_float", "b44", "b44a", "b44_perceptual", "dwaa", "dwaa_float",
                              "dwaa_one_block", "dwab", "tiled_zip", "tiled_piz_mips", "tiled_dwaa_rips" }) {
        const std::vector<std::byte> file = storedExr(name);
        size_t pictures = 0;
        for (uint32_t seed = 0; seed < 300; ++seed) pictures += test::fuzzHdrImage(damaged(file, seed, 3));
        EXPECT_LT(pictures, 300u) << name;
    }
}

TEST(Exr, TilesOfNoSizeAndOtherKindsOfFilesAreRefused) {
    std::vector<std::byte> file = storedExr("tiled_zip");
    constexpr std::string_view kTiles("tiles\0tiledesc\0\x09\0\0\0", 19);
    const auto* begin = reinterpret_cast<char const*>(file.data());
    const size_t at = std::string_view(begin, file.size()).find(kTiles);
    ASSERT_NE(at, std::string_view::npos);
    std::fill_n(file.begin() + static_cast<std::ptrdiff_t>(at + kTiles.size()), 4, std::byte{ 0 });
    const auto refusal = [&] {
        const Result<HdrImage> picture = decodeHdrImage(file, "x.exr");
        return picture ? "none" : picture.error().message;
    };
    EXPECT_THAT(refusal(), HasSubstr("its tiles have no size"));
    const auto setWords = [&](std::string_view after, std::initializer_list<uint32_t> words) {
        const size_t found = std::string_view(begin, file.size()).find(after);
        ASSERT_NE(found, std::string_view::npos);
        std::memcpy(&file[found + after.size()], words.begin(), words.size() * 4);
    };
    setWords(kTiles, { 16384, 4096 });
    setWords(std::string_view("dataWindow\0box2i\0\x10\0\0\0", 21), { 0, 0, 16383, 4095 });
    EXPECT_THAT(refusal(), HasSubstr("its tiles have more than 512 MiB"));
    file = storedExr("plain");
    file[5] = std::byte{ 0x08 }; // deep
    EXPECT_THAT(refusal(), HasSubstr("it is deep or has several parts"));
}

} // namespace
} // namespace filament_core::assets
