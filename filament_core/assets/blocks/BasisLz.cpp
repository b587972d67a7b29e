// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/blocks/BasisLz.h"

#include <algorithm>
#include <utility>

namespace filament_core::assets::blocks {
namespace {

Error damaged(const char* what) { return fail(ErrorCode::Corrupt, "{}", what); }

/// Values that were used last, roughly in order: section "Approximate Move to Front Routines".
class History {
public:
    explicit History(uint32_t size) : mValues(size), mRover(size / 2) {}

    size_t size() const { return mValues.size(); }
    void add(uint32_t value) {
        if (mValues.empty()) return;
        mValues[mRover++] = value;
        if (mRover == mValues.size()) mRover = mValues.size() / 2;
    }
    /// `index` is below size().
    uint32_t use(size_t index) {
        const uint32_t value = mValues[index];
        if (index) std::swap(mValues[index / 2], mValues[index]);
        return value;
    }

private:
    std::vector<uint32_t> mValues;
    size_t mRover;
};

} // namespace

/// The indices of a slice, block by block.
class BasisSlice {
public:
    BasisSlice(BasisLz const& books, std::span<const std::byte> bytes, uint32_t columns)
            : mBooks(books), mBits(bytes), mHistory(books.mHistorySize), mAbove(columns),
              mBelowPairs((columns + 1) / 2) {}

    /// Of each block in a row in turn; null: the bits are damaged.
    const BasisLz::Ends* nextEnds(uint32_t x, uint32_t y) {
        if (x % 2 == 0 && !startPair(x / 2, y)) return nullptr;
        const uint32_t prediction = mPredictions & 3;
        mPredictions >>= 2;
        const uint32_t aboveLeft = std::exchange(mAboveLeft, mAbove[x]);
        if ((x == 0 && (prediction == 0 || prediction == 2)) || (y == 0 && (prediction == 1 || prediction == 2)))
            return nullptr;
        uint32_t index = mIndex;
        if (prediction == 1) index = mAbove[x];
        if (prediction == 2) index = aboveLeft;
        if (prediction == 3) {
            const uint32_t delta = mBooks.mEndDeltas.take(mBits);
            if (delta >= mBooks.mEnds.size()) return nullptr;
            index += delta;
            if (index >= mBooks.mEnds.size()) index -= static_cast<uint32_t>(mBooks.mEnds.size());
        }
        mAbove[x] = static_cast<uint16_t>(index);
        mIndex = index;
        return &mBooks.mEnds[index];
    }

    const uint32_t* nextSelectors() {
        const auto count = static_cast<uint32_t>(mBooks.mSelectors.size());
        uint32_t symbol = count; // the last one again
        if (mRun > 0)
            --mRun;
        else
            symbol = mBooks.mSelectorCodes.take(mBits);
        if (symbol == count + mHistory.size()) {
            if (!startRun()) return nullptr;
            symbol = count;
        }
        if (symbol < count) {
            mHistory.add(symbol);
            return &mBooks.mSelectors[symbol];
        }
        if (symbol == BasisHuffman::kNoSymbol || symbol - count >= mHistory.size()) return nullptr;
        return &mBooks.mSelectors[mHistory.use(symbol - count)];
    }

    bool hasEnded() const { return mBits.hasEnded(); }

private:
    static constexpr uint32_t kRepeatPredictions = 256, kLeastRepeats = 3;
    static constexpr uint32_t kLongRun = 63, kLeastRun = 3;

    /// Two bits for each of 2 x 2 blocks are read once, at the upper left one. Returns whether they are predictions.
    bool startPair(uint32_t pair, uint32_t y) {
        if (y % 2) {
            mPredictions = mBelowPairs[pair];
            return true;
        }
        if (mRepeats > 0) {
            --mRepeats;
        } else {
            const uint32_t symbol = mBooks.mPredictions.take(mBits);
            if (symbol > kRepeatPredictions) return false;
            if (symbol == kRepeatPredictions)
                mRepeats = mBits.takeVariable(4) + kLeastRepeats - 1;
            else
                mLastPredictions = symbol;
        }
        mPredictions = mLastPredictions;
        mBelowPairs[pair] = static_cast<uint8_t>(mPredictions >> 4);
        return true;
    }

    bool startRun() {
        const uint32_t symbol = mBooks.mRuns.take(mBits);
        if (symbol > kLongRun) return false;
        mRun = (symbol == kLongRun ? mBits.takeVariable(7) : symbol) + kLeastRun - 1;
        return true;
    }

    BasisLz const& mBooks;
    BasisBits mBits;
    History mHistory;
    std::vector<uint16_t> mAbove;     ///< ends of the row above, and of this one to the left
    std::vector<uint8_t> mBelowPairs; ///< predictions of the next row
    uint32_t mPredictions = 0, mLastPredictions = 0, mRepeats = 0;
    uint32_t mIndex = 0, mAboveLeft = 0, mRun = 0;
};

Result<BasisLz> BasisLz::read(std::span<const std::byte> data, uint32_t imageCount) {
    constexpr uint64_t kHeader = 20, kImage = 20;
    if (data.size() < kHeader + kImage * imageCount) return damaged("its codebooks are cut short");
    const auto number = [&](size_t at, uint32_t bytes) { return static_cast<uint32_t>(loadLittle(&data[at], bytes)); };
    const uint32_t endCount = number(0, 2), selectorCount = number(2, 2);
    const uint64_t ends = number(4, 4), selectors = number(8, 4), tables = number(12, 4), extended = number(16, 4);
    uint64_t at = kHeader + kImage * imageCount;
    if (at + ends + selectors + tables + extended != data.size()) return damaged("its codebooks have a wrong length");
    if (endCount == 0 || selectorCount == 0) return damaged("its codebooks are empty");
    BasisLz books;
    for (uint32_t i = 0; i < imageCount; ++i) {
        const size_t from = kHeader + kImage * i;
        books.mImages.push_back({ number(from, 4), number(from + 4, 4), number(from + 8, 4), number(from + 12, 4),
                                  number(from + 16, 4) });
    }
    if (Result<void> read = books.readEnds(data.subspan(at, ends), endCount); !read) return read.error();
    if (Result<void> read = books.readSelectors(data.subspan(at + ends, selectors), selectorCount); !read)
        return read.error();
    if (Result<void> read = books.readTables(data.subspan(at + ends + selectors, tables)); !read) return read.error();
    return books;
}

Result<void> BasisLz::readEnds(std::span<const std::byte> bytes, uint32_t count) {
    BasisBits bits(bytes);
    std::array<BasisHuffman, 3> colorDeltas; // by the value before
    BasisHuffman tableDeltas;
    for (BasisHuffman& table : colorDeltas) {
        if (!table.read(bits)) return damaged("the prefix codes of its codebook of colours are damaged");
    }
    if (!tableDeltas.read(bits)) return damaged("the prefix codes of its codebook of colours are damaged");
    const bool isGrey = bits.take(1) != 0;
    std::array<uint32_t, 3> color{ 16, 16, 16 };
    uint32_t table = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t tableDelta = tableDeltas.take(bits);
        table = (table + tableDelta) & 7;
        uint32_t damage = tableDelta;
        for (size_t c = 0; c < (isGrey ? 1 : 3); ++c) {
            const uint32_t delta = colorDeltas[color[c] < 10 ? 0 : color[c] < 22 ? 1 : 2].take(bits);
            color[c] = (color[c] + delta) & 31;
            damage = std::max(damage, delta);
        }
        if (damage == BasisHuffman::kNoSymbol || bits.hasEnded()) return damaged("its codebook of colours is damaged");
        if (isGrey) color[1] = color[2] = color[0];
        mEnds.push_back({ static_cast<uint8_t>(color[0]), static_cast<uint8_t>(color[1]),
                          static_cast<uint8_t>(color[2]), static_cast<uint8_t>(table) });
    }
    return {};
}

Result<void> BasisLz::readSelectors(std::span<const std::byte> bytes, uint32_t count) {
    BasisBits bits(bytes);
    if (bits.take(2) != 0) return damaged("its codebook of selectors is of an unknown kind");
    const bool isPlain = bits.take(1) != 0;
    BasisHuffman deltas;
    if (!isPlain && !deltas.read(bits)) return damaged("the prefix codes of its codebook of selectors are damaged");
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t selectors = 0;
        for (uint32_t row = 0; row < 4; ++row) {
            const uint32_t value = isPlain || i == 0 ? bits.take(8) : deltas.take(bits);
            if (value > 255 || bits.hasEnded()) return damaged("its codebook of selectors is damaged");
            selectors |= value << (8 * row);
        }
        mSelectors.push_back(isPlain || i == 0 ? selectors : selectors ^ mSelectors.back());
    }
    return {};
}

Result<void> BasisLz::readTables(std::span<const std::byte> bytes) {
    BasisBits bits(bytes);
    for (BasisHuffman* table : { &mPredictions, &mEndDeltas, &mSelectorCodes, &mRuns }) {
        if (!table->read(bits)) return damaged("the prefix codes of its slices are damaged");
    }
    mHistorySize = bits.take(13);
    if (bits.hasEnded()) return damaged("the prefix codes of its slices are damaged");
    return {};
}

Result<void> BasisLz::decodeSlice(std::span<const std::byte> bytes, uint32_t width, uint32_t height,
                                  std::span<Texel8> texels) const {
    const uint32_t columns = (width + 3) / 4, rows = (height + 3) / 4;
    BasisSlice slice(*this, bytes, columns);
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const Ends* ends = slice.nextEnds(column, row);
            const uint32_t* selectors = ends ? slice.nextSelectors() : nullptr;
            if (!selectors || slice.hasEnded()) return damaged("a slice is damaged");
            auto const& sizes = kEtcIntensities[ends->table];
            const std::array<int32_t, 4> modifiers{ -sizes[1], -sizes[0], sizes[0], sizes[1] };
            const auto expanded = [](uint8_t value) { return static_cast<int32_t>(value << 3 | value >> 2); };
            const int32_t r = expanded(ends->r), g = expanded(ends->g), b = expanded(ends->b);
            std::array<Texel8, 4> colors;
            for (size_t i = 0; i < 4; ++i)
                colors[i] = { clampedTo8(r + modifiers[i]), clampedTo8(g + modifiers[i]), clampedTo8(b + modifiers[i]),
                              255 };
            for (uint32_t y = 0; y < std::min(4u, height - 4 * row); ++y) {
                Texel8* to = &texels[size_t{ 4 * row + y } * width + 4 * column];
                for (uint32_t x = 0; x < std::min(4u, width - 4 * column); ++x)
                    to[x] = colors[*selectors >> (8 * y + 2 * x) & 3];
            }
        }
    }
    return {};
}

} // namespace filament_core::assets::blocks
