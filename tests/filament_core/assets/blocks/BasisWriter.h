// SPDX-License-Identifier: Apache-2.0
/// BasisWriter: a small encoder of BasisLZ, to test the decoder with bits whose meaning is known. Written from the KTX
/// 2.0 Specification, appendix "BasisLZ/ETC1S Bitstream"; it makes valid bits, not small ones.
#pragma once

#include "filament_core/assets/blocks/BlockTexels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <random>
#include <vector>

namespace filament_core::assets::test {

/// The lowest bit of each byte first.
class BasisBitWriter {
public:
    void put(uint32_t value, uint32_t bits) {
        for (uint32_t i = 0; i < bits; ++i, ++mCount) {
            if (mCount % 8 == 0) bytes.push_back(std::byte{ 0 });
            bytes.back() |= static_cast<std::byte>((value >> i & 1) << (mCount % 8));
        }
    }
    void putVariable(uint32_t value, uint32_t width) {
        do {
            const uint32_t rest = value >> width;
            put((value & ((1u << width) - 1)) | (rest ? 1u << width : 0), width + 1);
            value = rest;
        } while (value);
    }
    std::vector<std::byte> bytes;

private:
    uint32_t mCount = 0;
};

/// A prefix code of `count` symbols whose lengths differ by at most one bit.
class EvenCode {
public:
    explicit EvenCode(uint32_t count) : mLengths(count, 1) {
        if (count < 2) return;
        const auto low = static_cast<uint32_t>(std::bit_width(count) - 1);
        const uint32_t longer = 2 * (count - (1u << low));
        for (uint32_t i = 0; i < count; ++i) mLengths[i] = static_cast<uint8_t>(i < count - longer ? low : low + 1);
    }
    explicit EvenCode(std::vector<uint8_t> lengths) : mLengths(std::move(lengths)) {}

    void put(uint32_t symbol, BasisBitWriter& writer) const {
        const uint32_t length = mLengths[symbol];
        uint32_t code = 0;
        for (uint32_t l = 1; l <= length; ++l) { // RFC 1951, 3.2.2
            code <<= 1;
            if (l < length) code += static_cast<uint32_t>(std::count(mLengths.begin(), mLengths.end(), l));
        }
        code += static_cast<uint32_t>(std::count(mLengths.begin(), mLengths.begin() + symbol, length));
        for (uint32_t i = length; i-- > 0;) writer.put(code >> i & 1, 1);
    }
    /// The table, without runs: every length by itself.
    void putTable(BasisBitWriter& writer) const {
        constexpr std::array<uint8_t, 21> kOrder{ 17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                                  11, 4,  12, 3,  13, 2, 14, 1, 15, 16 };
        std::vector<uint8_t> lengths(21); // of the lengths 0 to 16: 15 of 4 bits and two of 5
        for (size_t i = 0; i < 17; ++i) lengths[i] = i < 15 ? 4 : 5;
        writer.put(static_cast<uint32_t>(mLengths.size()), 14);
        writer.put(21, 5);
        for (const uint8_t symbol : kOrder) writer.put(lengths[symbol], 3);
        const EvenCode ofLengths(lengths);
        for (const uint8_t length : mLengths) ofLengths.put(length, writer);
    }

private:
    std::vector<uint8_t> mLengths;
};

struct BasisEnds {
    std::array<uint8_t, 3> color{};
    uint8_t table = 0;
};

/// Codebooks and slices of random contents.
class BasisWriter {
public:
    static constexpr uint32_t kHistory = 8;
    uint32_t predictionSymbols = 257; ///< more are none of the specification

    BasisWriter(uint32_t ends, uint32_t selectors, bool isGrey, uint32_t seed) : mRandom(seed), mIsGrey(isGrey) {
        for (uint32_t i = 0; i < ends; ++i) {
            BasisEnds entry;
            for (uint8_t& channel : entry.color)
                channel = isGrey && &channel != &entry.color[0] ? entry.color[0] : below(32);
            entry.table = below(8);
            mEnds.push_back(entry);
        }
        for (uint32_t i = 0; i < selectors; ++i) mSelectors.push_back(static_cast<uint32_t>(mRandom()));
    }

    struct Image {
        uint32_t offset = 0, length = 0, alphaOffset = 0, alphaLength = 0, flags = 0;
    };
    std::vector<std::byte> globalData(std::vector<Image> const& images, bool hasPlainSelectors = false) const {
        const std::vector<std::byte> ends = endBook(), selectors = selectorBook(hasPlainSelectors), tables = codes();
        BasisBitWriter writer;
        writer.put(static_cast<uint32_t>(mEnds.size()), 16);
        writer.put(static_cast<uint32_t>(mSelectors.size()), 16);
        for (auto const* part : { &ends, &selectors, &tables }) writer.put(static_cast<uint32_t>(part->size()), 32);
        writer.put(0, 32);
        for (Image const& image : images) {
            for (const uint32_t number :
                 { image.flags, image.offset, image.length, image.alphaOffset, image.alphaLength })
                writer.put(number, 32);
        }
        for (auto const* part : { &ends, &selectors, &tables })
            writer.bytes.insert(writer.bytes.end(), part->begin(), part->end());
        return writer.bytes;
    }

    /// Bytes of a slice, and the texels that they stand for.
    std::vector<std::byte> slice(uint32_t width, uint32_t height, std::vector<blocks::Texel8>& texels) {
        const uint32_t columns = (width + 3) / 4, rows = (height + 3) / 4;
        std::vector<uint32_t> ends, selectors;
        const std::vector<std::byte> bytes = indices(columns, rows, ends, selectors);
        texels.assign(size_t{ width } * height, {});
        for (uint32_t y = 0; y < height; ++y) {
            for (uint32_t x = 0; x < width; ++x) {
                const size_t block = size_t{ y / 4 } * columns + x / 4;
                texels[size_t{ y } * width + x] =
                        texelOf(mEnds[ends[block]], mSelectors[selectors[block]] >> (8 * (y % 4) + 2 * (x % 4)) & 3);
            }
        }
        return bytes;
    }

private:
    uint8_t below(uint32_t limit) { return static_cast<uint8_t>(mRandom() % limit); }
    uint32_t anyOf(size_t limit) { return static_cast<uint32_t>(mRandom() % limit); }

    static blocks::Texel8 texelOf(BasisEnds const& ends, uint32_t selector) {
        constexpr int kModifiers[8][2] = { { 2, 8 },   { 5, 17 },  { 9, 29 },   { 13, 42 },
                                           { 18, 60 }, { 24, 80 }, { 33, 106 }, { 47, 183 } };
        const int size = kModifiers[ends.table][selector == 0 || selector == 3], by = selector < 2 ? -size : size;
        const auto channel = [&](size_t c) {
            return static_cast<uint8_t>(std::clamp((ends.color[c] << 3 | ends.color[c] >> 2) + by, 0, 255));
        };
        return { channel(0), channel(1), channel(2), 255 };
    }

    std::vector<std::byte> endBook() const {
        BasisBitWriter writer;
        const EvenCode colors(32), tables(8);
        for (int i = 0; i < 3; ++i) colors.putTable(writer);
        tables.putTable(writer);
        writer.put(mIsGrey, 1);
        BasisEnds last{ { 16, 16, 16 }, 0 };
        for (BasisEnds const& entry : mEnds) {
            tables.put(static_cast<uint32_t>(entry.table - last.table) & 7, writer);
            for (size_t c = 0; c < (mIsGrey ? 1 : 3); ++c)
                colors.put(static_cast<uint32_t>(entry.color[c] - last.color[c]) & 31, writer);
            last = entry;
        }
        return writer.bytes;
    }

    std::vector<std::byte> selectorBook(bool isPlain) const {
        BasisBitWriter writer;
        const EvenCode deltas(256);
        writer.put(0, 2);
        writer.put(isPlain, 1);
        if (!isPlain) deltas.putTable(writer);
        for (size_t i = 0; i < mSelectors.size(); ++i) {
            for (uint32_t row = 0; row < 4; ++row) {
                const uint32_t value = mSelectors[i] >> (8 * row) & 255;
                if (isPlain || i == 0)
                    writer.put(value, 8);
                else
                    deltas.put(value ^ (mSelectors[i - 1] >> (8 * row) & 255), writer);
            }
        }
        return writer.bytes;
    }

    EvenCode predictionCode() const { return EvenCode(predictionSymbols); }
    EvenCode deltaCode() const { return EvenCode(static_cast<uint32_t>(mEnds.size())); }
    EvenCode selectorCode() const { return EvenCode(static_cast<uint32_t>(mSelectors.size()) + kHistory + 1); }
    EvenCode runCode() const { return EvenCode(64); }

    std::vector<std::byte> codes() const {
        BasisBitWriter writer;
        for (EvenCode const& code : { predictionCode(), deltaCode(), selectorCode(), runCode() }) code.putTable(writer);
        writer.put(kHistory, 13);
        return writer.bytes;
    }

    /// Predictions of 2 x 2 blocks whose neighbours exist; those beside the image do not matter.
    uint32_t predictionsAt(uint32_t x, uint32_t y) {
        uint32_t predictions = 0;
        for (uint32_t i = 0; i < 4; ++i) {
            const bool hasLeft = x + i % 2 > 0, hasAbove = y + i / 2 > 0;
            const uint32_t wanted = anyOf(4);
            const bool isThere =
                    wanted == 3 || (wanted == 0 && hasLeft) || (wanted == 1 && hasAbove) || (hasLeft && hasAbove);
            predictions |= (isThere ? wanted : 3u) << (2 * i);
        }
        return predictions;
    }

    /// Predictions of all pairs, with repeated ones now and then, so that the runs of them are used.
    std::vector<uint32_t> predictionsOf(uint32_t columns, uint32_t rows, std::vector<uint32_t>& runs) {
        const uint32_t across = (columns + 1) / 2, count = across * ((rows + 1) / 2);
        std::vector<uint32_t> predictions(count);
        runs.assign(count, 0);
        for (uint32_t i = 0; i < count; ++i) {
            predictions[i] = anyOf(3) ? predictionsAt(i % across * 2, i / across * 2) : 255;
            const uint32_t run = 3 + anyOf(30);
            const bool isInner = predictions[i] == 255 && i + run < count && anyOf(2);
            if (!isInner) continue;
            runs[i + 1] = run; // the run follows this one
            for (uint32_t k = 1; k <= run; ++k) predictions[i + k] = 255;
            i += run;
        }
        return predictions;
    }

    void putEnds(uint32_t prediction, size_t at, uint32_t columns, std::vector<uint32_t>& ends,
                 BasisBitWriter& writer) {
        const uint32_t left = at ? ends[at - 1] : 0;
        if (prediction == 0) ends[at] = left;
        if (prediction == 1) ends[at] = ends[at - columns];
        if (prediction == 2) ends[at] = ends[at - columns - 1];
        if (prediction != 3) return;
        const auto count = static_cast<uint32_t>(mEnds.size());
        ends[at] = anyOf(count);
        deltaCode().put((ends[at] + count - left) % count, writer);
    }

    void putSelectors(size_t at, std::vector<uint32_t>& selectors, BasisBitWriter& writer) {
        const auto count = static_cast<uint32_t>(mSelectors.size());
        if (mRun > 0) {
            --mRun;
            selectors[at] = mHistory[0];
            return;
        }
        const uint32_t kind = anyOf(3), longest = static_cast<uint32_t>(selectors.size() - at);
        if (kind == 0 && longest > 3) {
            const uint32_t run = std::min(3 + anyOf(anyOf(4) ? 20 : 400), longest);
            selectorCode().put(count + kHistory, writer);
            runCode().put(std::min(run - 3, 63u), writer);
            if (run - 3 >= 63) writer.putVariable(run - 3, 7);
            mRun = run - 1;
            selectors[at] = mHistory[0];
        } else if (kind == 1) {
            const uint32_t index = anyOf(kHistory);
            selectorCode().put(count + index, writer);
            selectors[at] = mHistory[index];
            if (index) std::swap(mHistory[index], mHistory[index / 2]);
        } else {
            selectors[at] = anyOf(count);
            selectorCode().put(selectors[at], writer);
            mHistory[mRover++] = selectors[at];
            if (mRover == kHistory) mRover = kHistory / 2;
        }
    }

    std::vector<std::byte> indices(uint32_t columns, uint32_t rows, std::vector<uint32_t>& ends,
                                   std::vector<uint32_t>& selectors) {
        BasisBitWriter writer;
        std::vector<uint32_t> runs;
        const std::vector<uint32_t> predictions = predictionsOf(columns, rows, runs);
        ends.assign(size_t{ columns } * rows, 0);
        selectors = ends;
        mHistory.fill(0);
        mRover = kHistory / 2, mRun = 0;
        uint32_t inRun = 0;
        for (uint32_t y = 0; y < rows; ++y) {
            for (uint32_t x = 0; x < columns; ++x) {
                const uint32_t pair = y / 2 * ((columns + 1) / 2) + x / 2;
                if (x % 2 == 0 && y % 2 == 0) {
                    if (runs[pair]) {
                        predictionCode().put(256, writer);
                        writer.putVariable(runs[pair] - 3, 4);
                        inRun = runs[pair];
                    }
                    if (inRun)
                        --inRun;
                    else
                        predictionCode().put(predictions[pair], writer);
                }
                const size_t at = size_t{ y } * columns + x;
                putEnds(predictions[pair] >> (2 * (y % 2 * 2 + x % 2)) & 3, at, columns, ends, writer);
                putSelectors(at, selectors, writer);
            }
        }
        return writer.bytes;
    }

    std::mt19937 mRandom;
    bool mIsGrey;
    std::vector<BasisEnds> mEnds;
    std::vector<uint32_t> mSelectors;
    std::array<uint32_t, kHistory> mHistory{};
    uint32_t mRover = 0, mRun = 0;
};

} // namespace filament_core::assets::test
