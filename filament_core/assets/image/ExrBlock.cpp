// SPDX-License-Identifier: Apache-2.0
// The simpler compressions of OpenEXR: "Technical Introduction to OpenEXR", section "Data Compression", and the notes
// in OpenEXR's ImfPxr24Compressor.cpp and ImfB44Compressor.cpp (openexr.com).
#include "filament_core/assets/image/ExrBlock.h"

#include "base/math/Elementary.h"
#include "base/math/Half.h"
#include "filament_core/assets/image/HdrDecoders.h"
#include "filament_core/assets/image/Zlib.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::assets {
namespace {

/// Big-endian differences to the sample on the left, the most significant bytes of a row first; of floats 24 bits.
bool expandPxr24(ExrBlock const& block, std::span<const std::byte> packed, std::span<std::byte> out) {
    const auto storedBytes = [](ExrChannel const& channel) {
        return channel.type == ExrType::Float ? size_t{ 3 } : channel.bytes();
    };
    size_t rowBytes = 0;
    for (ExrChannel const& channel : block.channels) rowBytes += storedBytes(channel) * block.width;
    std::vector<std::byte> planes(rowBytes * block.rows);
    if (!inflateZlib(packed, planes)) return false;
    const std::byte* plane = planes.data();
    std::byte* sample = out.data();
    for (size_t y = 0; y < block.rows; ++y) {
        for (ExrChannel const& channel : block.channels) {
            const size_t stored = storedBytes(channel), bytes = channel.bytes();
            uint32_t value = 0;
            for (size_t x = 0; x < block.width; ++x) {
                uint32_t difference = 0;
                for (size_t i = 0; i < stored; ++i)
                    difference = difference << 8 | static_cast<uint32_t>(plane[i * block.width + x]);
                value += channel.type == ExrType::Float ? difference << 8 : difference;
                std::memcpy(sample, &value, bytes); // little-endian: the low bytes
                sample += bytes;
            }
            plane += stored * block.width;
        }
    }
    return true;
}

using B44Square = std::array<uint16_t, 16>; // 4 x 4 halves

/// A word, and differences of six bits each, which all have the same shift; or one word for all (B44A).
std::optional<B44Square> readSquare(ByteCursor& cursor) {
    constexpr size_t kFlatBytes = 3, kBytes = 14;
    constexpr unsigned kFlatShift = 13;
    if (cursor.remaining() < kFlatBytes) return std::nullopt;
    const auto at = [&](size_t i) { return static_cast<uint32_t>(cursor.rest()[i]); };
    const unsigned shift = at(2) >> 2;
    const bool isFlat = shift >= kFlatShift;
    if (!isFlat && cursor.remaining() < kBytes) return std::nullopt;
    B44Square square;
    square.fill(static_cast<uint16_t>(at(0) << 8 | at(1)));
    if (!isFlat) {
        const uint32_t bias = 0x20u << shift;
        const auto difference = [&](size_t index) { // in steps of six bits, from bit 22 on
            const size_t bit = 22 + 6 * index;
            const uint32_t two = at(bit / 8) << 8 | (bit / 8 + 1 < kBytes ? at(bit / 8 + 1) : 0u);
            return ((two >> (10 - bit % 8) & 0x3F) << shift) - bias;
        };
        // The first column downwards, then the other columns, each from the one on its left.
        for (size_t y = 1; y < 4; ++y) square[4 * y] = static_cast<uint16_t>(square[4 * (y - 1)] + difference(y - 1));
        for (size_t x = 1; x < 4; ++x)
            for (size_t y = 0; y < 4; ++y)
                square[4 * y + x] = static_cast<uint16_t>(square[4 * y + x - 1] + difference(3 + 4 * (x - 1) + y));
    }
    for (uint16_t& word : square) // ordered words become sign and magnitude
        word = static_cast<uint16_t>((word & 0x8000u) != 0 ? word & 0x7FFFu : ~unsigned{ word });
    cursor.take(isFlat ? kFlatBytes : kBytes);
    return square;
}

/// Of perceptual channels, exp(x / 8) is stored.
uint16_t withoutExponential(uint16_t half) {
    const float value = floatFromHalf(half);
    const bool isStored = std::isfinite(value) && value > 0;
    return isStored ? halfFromFloat(static_cast<float>(8 * elementary::log(double{ value }))) : uint16_t{ 0 };
}

bool expandHalves(ExrBlock const& block, ExrChannel const& channel, ByteCursor& cursor, std::byte* first) {
    const size_t pitch = block.rowBytes();
    for (size_t y = 0; y < block.rows; y += 4) {
        for (size_t x = 0; x < block.width; x += 4) {
            std::optional<B44Square> square = readSquare(cursor);
            if (!square) return false;
            for (size_t row = 0; row < std::min<size_t>(4, block.rows - y); ++row) {
                for (size_t column = 0; column < std::min<size_t>(4, block.width - x); ++column) {
                    uint16_t word = (*square)[4 * row + column];
                    if (channel.isPerceptual) word = withoutExponential(word);
                    std::memcpy(first + (y + row) * pitch + (x + column) * 2, &word, 2);
                }
            }
        }
    }
    return true;
}

/// Halves in squares; other channels as they are.
bool expandB44(ExrBlock const& block, std::span<const std::byte> packed, std::span<std::byte> out) {
    ByteCursor cursor(packed);
    size_t column = 0;
    for (ExrChannel const& channel : block.channels) {
        const size_t bytes = channel.bytes() * block.width;
        if (channel.type == ExrType::Half) {
            if (!expandHalves(block, channel, cursor, &out[column])) return false;
        } else {
            for (size_t y = 0; y < block.rows; ++y) {
                const auto row = cursor.take(bytes);
                if (!row) return false;
                std::ranges::copy(*row, out.begin() + static_cast<std::ptrdiff_t>(y * block.rowBytes() + column));
            }
        }
        column += bytes;
    }
    return true;
}

} // namespace

size_t ExrBlock::rowBytes() const {
    size_t sum = 0;
    for (ExrChannel const& channel : channels) sum += channel.bytes() * width;
    return sum;
}

// Signed run lengths: n < 0 copies -n bytes, n >= 0 repeats the next byte n + 1 times.
bool expandRuns(std::span<const std::byte> packed, std::span<std::byte> out) {
    ByteCursor cursor(packed);
    while (!out.empty()) {
        const auto code = cursor.read<int8_t>();
        if (!code) return false;
        const size_t count = *code < 0 ? static_cast<size_t>(-*code) : static_cast<size_t>(*code) + 1;
        if (count > out.size()) return false;
        if (*code < 0) {
            const auto values = cursor.take(count);
            if (!values) return false;
            std::ranges::copy(*values, out.begin());
        } else {
            const auto value = cursor.read<std::byte>();
            if (!value) return false;
            std::ranges::fill(out.first(count), *value);
        }
        out = out.subspan(count);
    }
    return true;
}

void undoPredictor(std::span<std::byte> bytes) {
    for (size_t i = 1; i < bytes.size(); ++i) {
        bytes[i] = static_cast<std::byte>(static_cast<int>(bytes[i - 1]) + static_cast<int>(bytes[i]) - 128);
    }
    const std::vector<std::byte> apart(bytes.begin(), bytes.end());
    const size_t half = (bytes.size() + 1) / 2;
    for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = apart[(i & 1) ? half + i / 2 : i / 2];
}

bool unpackExrBlock(ExrCompression compression, ExrBlock const& block, std::span<const std::byte> packed,
                    std::span<std::byte> out) {
    using enum ExrCompression;
    if (packed.size() == out.size()) { // compressing would not have made it smaller
        std::ranges::copy(packed, out.begin());
        return true;
    }
    if (packed.size() > out.size()) return false;
    switch (compression) {
    case Rle:
    case Zips:
    case Zip:
        if (!(compression == Rle ? expandRuns(packed, out) : inflateZlib(packed, out))) return false;
        undoPredictor(out);
        return true;
    case Piz:
        return expandPiz(block, packed, out);
    case Pxr24:
        return expandPxr24(block, packed, out);
    case B44:
    case B44a:
        return expandB44(block, packed, out);
    case Dwaa:
    case Dwab:
        return expandDwa(block, packed, out);
    case None:
    case Count:
        break;
    }
    return false;
}

} // namespace filament_core::assets
