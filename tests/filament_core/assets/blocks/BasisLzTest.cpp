// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/blocks/BasisLz.h"

#include "tests/filament_core/assets/blocks/BasisWriter.h"
#include "tests/filament_core/assets/blocks/BlockWriter.h"

#include <gmock/gmock.h>

namespace filament_core::assets {
namespace {

using blocks::BasisBits;
using blocks::BasisHuffman;
using blocks::BasisLz;
using blocks::Texel8;
using test::BasisBitWriter;
using test::BasisWriter;
using test::EvenCode;

TEST(BasisHuffman, SymbolsOfEverySizeOfTableComeBack) {
    for (const uint32_t count : { 1u, 2u, 3u, 5u, 16u, 64u, 257u, 1000u, 5000u }) {
        const EvenCode code(count);
        BasisBitWriter writer;
        code.putTable(writer);
        std::vector<uint32_t> symbols;
        for (uint32_t i = 0; i < 50; ++i) symbols.push_back(i * 7919 % count);
        for (const uint32_t symbol : symbols) code.put(symbol, writer);
        BasisBits bits(writer.bytes);
        BasisHuffman table;
        ASSERT_TRUE(table.read(bits)) << count;
        for (const uint32_t symbol : symbols) ASSERT_EQ(table.take(bits), symbol) << count;
        EXPECT_FALSE(bits.hasEnded());
    }
}

TEST(BasisHuffman, CodesOf16BitsAreRead) {
    std::vector<uint8_t> lengths; // 1, 2, 3, ... 15, 16, 16
    for (uint8_t length = 1; length <= 16; ++length) lengths.push_back(length);
    lengths.push_back(16);
    const EvenCode code(lengths);
    BasisBitWriter writer;
    for (uint32_t symbol = 0; symbol < lengths.size(); ++symbol) code.put(symbol, writer);
    BasisHuffman table;
    ASSERT_TRUE(table.build(lengths));
    BasisBits bits(writer.bytes);
    for (uint32_t symbol = 0; symbol < lengths.size(); ++symbol) EXPECT_EQ(table.take(bits), symbol);
}

TEST(BasisHuffman, TablesWithTooManyOrTooFewCodesAreNone) {
    BasisHuffman table;
    EXPECT_TRUE(table.build(std::vector<uint8_t>{ 1, 1 }));
    EXPECT_FALSE(table.build(std::vector<uint8_t>{ 1, 1, 1 })) << "over-subscribed";
    EXPECT_FALSE(table.build(std::vector<uint8_t>{ 1, 2 })) << "incomplete";
    EXPECT_TRUE(table.build(std::vector<uint8_t>{ 0, 0, 1 })) << "one symbol has half of a code";
    EXPECT_TRUE(table.build({}));
    BasisBits bits({});
    EXPECT_EQ(table.take(bits), BasisHuffman::kNoSymbol);
}

/// The lengths of 200 symbols as runs: zeros (17, 18) and repeats (19, 20).
TEST(BasisHuffman, RunsOfLengthsAreRead) {
    std::vector<uint8_t> ofLengths(21);
    ofLengths[17] = ofLengths[18] = ofLengths[19] = ofLengths[20] = 3, ofLengths[6] = 1;
    const EvenCode lengths(ofLengths);
    constexpr std::array<uint8_t, 21> kOrder{
        17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16
    };
    const auto table = [&](uint32_t symbols, auto const& write) {
        BasisBitWriter writer;
        writer.put(symbols, 14);
        writer.put(21, 5);
        for (const uint8_t symbol : kOrder) writer.put(ofLengths[symbol], 3);
        write(writer);
        BasisBits bits(writer.bytes);
        BasisHuffman read;
        return read.read(bits);
    };
    const auto put = [&](BasisBitWriter& writer, uint32_t symbol, uint32_t extra, uint32_t bits) {
        lengths.put(symbol, writer);
        writer.put(extra, bits);
    };
    EXPECT_TRUE(table(11 + 5 + 64, [&](BasisBitWriter& writer) {
        put(writer, 18, 0, 7), put(writer, 17, 2, 3); // 11 and 5 zeros
        put(writer, 6, 0, 0), put(writer, 19, 1, 2);  // one of 6 bits, 4 more
        put(writer, 20, 52, 7);                       // 59 more
    }));
    EXPECT_FALSE(table(80, [&](BasisBitWriter& writer) { put(writer, 19, 0, 2); })) << "there is nothing to repeat";
    EXPECT_FALSE(table(10, [&](BasisBitWriter& writer) { put(writer, 18, 0, 7); })) << "more than the table has";
}

TEST(BasisBits, NumbersOfVariableLengthAreRead) {
    BasisBitWriter writer;
    for (const uint32_t value : { 0u, 1u, 15u, 16u, 255u, 256u, 0xFFFFFu }) {
        writer.putVariable(value, 4);
        writer.putVariable(value, 7);
    }
    BasisBits bits(writer.bytes);
    for (const uint32_t value : { 0u, 1u, 15u, 16u, 255u, 256u, 0xFFFFFu }) {
        EXPECT_EQ(bits.takeVariable(4), value);
        EXPECT_EQ(bits.takeVariable(7), value);
    }
    EXPECT_FALSE(bits.hasEnded());
    bits.take(16);
    EXPECT_TRUE(bits.hasEnded());
}

TEST(BasisLz, SlicesOfEverySizeHaveTheTexelsThatWereWritten) {
    for (uint32_t seed = 0; seed < 40; ++seed) {
        BasisWriter writer(1 + seed * 7, 1 + seed * 5, seed % 3 == 2, seed);
        const uint32_t width = 1 + seed * 13 % 97, height = 1 + seed * 29 % 83;
        std::vector<Texel8> expected;
        const std::vector<std::byte> bytes = writer.slice(width, height, expected);
        const Result<BasisLz> books = BasisLz::read(writer.globalData({ {} }, seed % 2 != 0), 1);
        ASSERT_TRUE(books) << books.error().message;
        std::vector<Texel8> seen(expected.size());
        const Result<void> decoded = books->decodeSlice(bytes, width, height, seen);
        ASSERT_TRUE(decoded) << seed << ": " << decoded.error().message;
        ASSERT_EQ(seen, expected) << seed;
    }
}

TEST(BasisLz, PredictionsThatTheSpecificationDoesNotKnowAreErrors) {
    BasisWriter writer(1, 1, false, 5);
    writer.predictionSymbols = 300;
    const Result<BasisLz> books = BasisLz::read(writer.globalData({ {} }), 1);
    ASSERT_TRUE(books) << books.error().message;
    std::vector<Texel8> texels(16);
    for (const uint32_t symbol : { 255u, 257u, 299u }) {
        BasisBitWriter slice;
        EvenCode(300).put(symbol, slice);
        slice.put(0, 32), slice.put(0, 32);
        EXPECT_EQ(books->decodeSlice(slice.bytes, 4, 4, texels).ok(), symbol == 255) << symbol;
    }
}

TEST(BasisLz, CodebooksAndSlicesThatAreCutShortAreErrors) {
    BasisWriter writer(20, 30, false, 3);
    std::vector<Texel8> texels;
    const std::vector<std::byte> slice = writer.slice(40, 40, texels), data = writer.globalData({ {} });
    for (size_t length = 0; length < data.size(); ++length) {
        const Result<BasisLz> books = BasisLz::read(std::span(data).first(length), 1);
        ASSERT_FALSE(books) << length;
        EXPECT_EQ(books.error().code, ErrorCode::Corrupt);
    }
    const Result<BasisLz> books = BasisLz::read(data, 1);
    ASSERT_TRUE(books);
    for (size_t length = 0; length < slice.size(); ++length)
        EXPECT_FALSE(books->decodeSlice(std::span(slice).first(length), 40, 40, texels)) << length;
}

TEST(BasisLz, NoSingleBitOfDamageIsMoreThanAnErrorOrOtherTexels) {
    BasisWriter writer(20, 30, false, 4);
    std::vector<Texel8> texels;
    const std::vector<std::byte> slice = writer.slice(24, 24, texels);
    std::vector<std::byte> data = writer.globalData({ {} });
    uint32_t refused = 0;
    for (size_t bit = 0; bit < data.size() * 8; ++bit) {
        data[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
        const Result<BasisLz> books = BasisLz::read(data, 1);
        refused += !books || !books->decodeSlice(slice, 24, 24, texels);
        data[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
    }
    EXPECT_GT(refused, data.size()) << "most damage shows";
}

} // namespace
} // namespace filament_core::assets
