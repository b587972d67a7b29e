// SPDX-License-Identifier: Apache-2.0
// OpenEXR's PIZ: the 16-bit words of each channel are renumbered without gaps, transformed by a Haar wavelet, and
// Huffman-coded with run lengths. "Technical Introduction to OpenEXR", section "Data Compression", and the
// implementation notes in OpenEXR's ImfPizCompressor.cpp, ImfHuf.cpp and ImfWav.cpp (openexr.com).
#include "filament_core/assets/image/ExrBlock.h"
#include "filament_core/assets/image/HdrDecoders.h"

#include <algorithm>
#include <array>
#include <vector>

namespace filament_core::assets {
namespace {

constexpr size_t kWords = 1 << 16;
constexpr uint32_t kMaxCodeBits = 58;

/// Bits from the most significant one of each byte on.
class BitCursor {
public:
    BitCursor(std::span<const std::byte> bytes, size_t bits) : mBytes(bytes), mEnd(bits) {}

    size_t left() const { return mEnd - mAt; }
    /// The byte behind the bits read so far.
    size_t nextByte() const { return (mAt + 7) / 8; }

    std::optional<uint32_t> read(uint32_t count) {
        if (count > left()) return std::nullopt;
        uint32_t value = 0;
        for (uint32_t i = 0; i < count; ++i) value = value << 1 | next();
        return value;
    }
    uint32_t next() {
        const uint32_t byte = static_cast<uint32_t>(mBytes[mAt / 8]);
        return byte >> (7 - mAt++ % 8) & 1u;
    }

private:
    std::span<const std::byte> mBytes;
    size_t mAt = 0, mEnd;
};

/// A canonical Huffman code in which longer codes have smaller values. Codes that overlap, in a damaged file, decode to
/// some of their symbols.
class HuffmanCode {
public:
    explicit HuffmanCode(std::vector<uint8_t> const& lengths) {
        for (const uint8_t length : lengths) ++mCount[length];
        mCount[0] = 0;
        uint64_t code = 0;
        for (uint32_t length = kMaxCodeBits; length > 0; --length) {
            mFirst[length] = code;
            code = (code + mCount[length]) >> 1;
        }
        std::array<size_t, kMaxCodeBits + 1> at{};
        for (uint32_t length = 1; length <= kMaxCodeBits; ++length) at[length] = mStart[length] = total(length);
        mSymbols.resize(total(kMaxCodeBits + 1));
        for (uint32_t symbol = 0; symbol < lengths.size(); ++symbol) {
            if (lengths[symbol] > 0) mSymbols[at[lengths[symbol]]++] = symbol;
        }
    }

    std::optional<uint32_t> read(BitCursor& bits) const {
        uint64_t code = 0;
        for (uint32_t length = 1; length <= kMaxCodeBits && bits.left() > 0; ++length) {
            code = code << 1 | bits.next();
            if (code >= mFirst[length] && code - mFirst[length] < mCount[length])
                return mSymbols[mStart[length] + static_cast<size_t>(code - mFirst[length])];
        }
        return std::nullopt;
    }

private:
    size_t total(uint32_t below) const {
        size_t sum = 0;
        for (uint32_t length = 1; length < below; ++length) sum += mCount[length];
        return sum;
    }

    std::array<uint64_t, kMaxCodeBits + 1> mFirst{};
    std::array<size_t, kMaxCodeBits + 1> mCount{}, mStart{};
    std::vector<uint32_t> mSymbols; // by length, then by value
};

/// Six bits a length; 59 to 62 stand for 2 to 5 zeros, 63 for 6 and as many as the next eight bits say.
std::optional<std::vector<uint8_t>> readLengths(BitCursor& bits, uint32_t first, uint32_t last) {
    constexpr uint32_t kShortRun = 59, kLongRun = 63;
    std::vector<uint8_t> lengths(kWords + 1);
    for (uint32_t symbol = first; symbol <= last;) {
        const auto length = bits.read(6);
        if (!length) return std::nullopt;
        if (*length < kShortRun) {
            lengths[symbol++] = static_cast<uint8_t>(*length);
            continue;
        }
        const auto more = *length == kLongRun ? bits.read(8) : std::optional<uint32_t>(0);
        if (!more) return std::nullopt;
        symbol += *length - kShortRun + 2 + *more;
        if (symbol > last + 1) return std::nullopt;
    }
    return lengths;
}

/// The symbol `run` repeats the last word as often as the next eight bits say.
bool decodeWords(HuffmanCode const& code, BitCursor bits, uint32_t run, std::span<uint16_t> words) {
    for (size_t i = 0; i < words.size();) {
        const auto symbol = code.read(bits);
        if (!symbol) return false;
        if (*symbol != run) {
            if (*symbol >= kWords) return false;
            words[i++] = static_cast<uint16_t>(*symbol);
            continue;
        }
        const auto count = bits.read(8);
        if (!count || i == 0 || *count > words.size() - i) return false;
        std::fill_n(words.begin() + static_cast<std::ptrdiff_t>(i), *count, words[i - 1]);
        i += *count;
    }
    return true;
}

struct Pair {
    uint16_t low, high;
};

// The average and the difference of two words. The first form is exact for words below 2^14.
Pair undoSmall(uint16_t average, uint16_t difference) {
    const int delta = static_cast<int16_t>(difference);
    const int low = static_cast<int16_t>(average) + (delta & 1) + (delta >> 1);
    return { static_cast<uint16_t>(low), static_cast<uint16_t>(low - delta) };
}
Pair undoLarge(uint16_t average, uint16_t difference) {
    const int high = (average - (difference >> 1)) & 0xFFFF;
    return { static_cast<uint16_t>(difference + high - 0x8000), static_cast<uint16_t>(high) };
}

/// `width` x `height` words with `step` between neighbours in a row and `pitch` between rows.
struct WordPlane {
    std::span<uint16_t> words;
    size_t width, height, step, pitch;

    uint16_t& at(size_t x, size_t y) const { return words[x * step + y * pitch]; }
};

template <class Undo>
void undoLevel(WordPlane const& plane, size_t half, Undo undo) {
    const size_t whole = 2 * half;
    const auto combine = [&](uint16_t& a, uint16_t& b) {
        const Pair pair = undo(a, b);
        a = pair.low;
        b = pair.high;
    };
    const size_t right = plane.width / whole * whole, bottom = plane.height / whole * whole;
    const bool hasColumn = (plane.width & half) != 0, hasRow = (plane.height & half) != 0;
    for (size_t y = 0; y < bottom; y += whole) {
        for (size_t x = 0; x < right; x += whole) {
            combine(plane.at(x, y), plane.at(x, y + half));
            combine(plane.at(x + half, y), plane.at(x + half, y + half));
            combine(plane.at(x, y), plane.at(x + half, y));
            combine(plane.at(x, y + half), plane.at(x + half, y + half));
        }
        if (hasColumn) combine(plane.at(right, y), plane.at(right, y + half));
    }
    for (size_t x = 0; hasRow && x < right; x += whole) combine(plane.at(x, bottom), plane.at(x + half, bottom));
}

void undoWavelet(WordPlane const& plane, size_t largest) {
    const size_t side = std::min(plane.width, plane.height);
    for (size_t half = std::bit_floor(side) / 2; half >= 1; half /= 2) {
        if (largest < 1 << 14)
            undoLevel(plane, half, undoSmall);
        else
            undoLevel(plane, half, undoLarge);
    }
}

/// The words that occur, ascending: a bit for each, of which only the bytes from the first to the last that is not zero
/// are stored. Word 0 always occurs.
std::optional<std::vector<uint16_t>> readOccurring(ByteCursor& cursor) {
    const auto first = cursor.read<uint16_t>(), last = cursor.read<uint16_t>();
    if (!last || *last >= kWords / 8) return std::nullopt;
    std::vector<uint16_t> words{ 0 };
    if (*first > *last) return words;
    const auto bits = cursor.take(size_t{ *last } - *first + 1);
    if (!bits) return std::nullopt;
    for (size_t i = 0; i < bits->size() * 8; ++i) {
        const size_t word = size_t{ *first } * 8 + i;
        const bool occurs = (static_cast<uint32_t>((*bits)[i / 8]) >> (i % 8) & 1u) != 0;
        if (occurs && word != 0) words.push_back(static_cast<uint16_t>(word));
    }
    return words;
}

} // namespace

bool expandHuffman(std::span<const std::byte> packed, std::span<uint16_t> words) {
    ByteCursor cursor(packed);
    const auto first = cursor.read<uint32_t>(), last = cursor.read<uint32_t>();
    cursor.read<uint32_t>(); // the size of the table, which says itself where it ends
    const auto dataBits = cursor.read<uint32_t>(), reserved = cursor.read<uint32_t>();
    if (!reserved || *first > *last || *last > kWords) return false;
    BitCursor table(cursor.rest(), cursor.remaining() * 8);
    const auto lengths = readLengths(table, *first, *last);
    if (!lengths) return false;
    const auto data = cursor.rest().subspan(table.nextByte());
    if (*dataBits > data.size() * 8) return false;
    return decodeWords(HuffmanCode(*lengths), BitCursor(data, *dataBits), *last, words);
}

bool expandPiz(ExrBlock const& block, std::span<const std::byte> packed, std::span<std::byte> out) {
    ByteCursor cursor(packed);
    const auto occurring = readOccurring(cursor);
    const auto size = occurring ? cursor.read<uint32_t>() : std::nullopt;
    const auto coded = size ? cursor.take(*size) : std::nullopt;
    std::vector<uint16_t> words(out.size() / 2);
    if (!coded || !expandHuffman(*coded, words)) return false;

    const size_t rowWords = block.rowBytes() / 2;
    size_t start = 0, column = 0; // of a channel: all its rows are together here, and its part of each row in `out`
    for (ExrChannel const& channel : block.channels) {
        const size_t count = channel.bytes() / 2, pitch = count * block.width;
        const auto plane = std::span(words).subspan(start, pitch * block.rows);
        for (size_t i = 0; i < count; ++i)
            undoWavelet({ plane.subspan(i), block.width, block.rows, count, pitch }, occurring->size() - 1);
        for (uint16_t& word : plane) word = word < occurring->size() ? (*occurring)[word] : uint16_t{ 0 };
        for (size_t y = 0; y < block.rows; ++y)
            std::memcpy(&out[(y * rowWords + column) * 2], &plane[y * pitch], pitch * 2);
        start += pitch * block.rows;
        column += pitch;
    }
    return true;
}

} // namespace filament_core::assets
