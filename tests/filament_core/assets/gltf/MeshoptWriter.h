// SPDX-License-Identifier: Apache-2.0
/// MeshoptWriter: streams of KHR_meshopt_compression (appendix A) for tests, which use every mode that the format has,
/// by chance instead of by size.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <vector>

namespace filament_core::assets::test {

class MeshoptWriter {
public:
    using Bytes = std::vector<std::byte>;

    explicit MeshoptWriter(uint32_t seed) : mRandom(seed) {}

    uint32_t below(uint32_t end) { return static_cast<uint32_t>(mRandom() % end); }

    /// "Mode 0: attributes".
    Bytes attributes(std::span<const std::byte> elements, size_t stride, uint32_t version) {
        mStream.clear();
        put(0xA0 + version);
        const size_t count = elements.size() / stride, maxBlock = std::min<size_t>(8192 / stride & ~size_t{ 15 }, 256);
        Bytes last(stride), modes;
        for (std::byte& byte : last) byte = std::byte(below(256));
        const Bytes baseline = last;
        for (size_t i = 0; i < stride / 4; ++i) {
            const uint32_t mode = version > 0 ? below(3) : 0;
            modes.push_back(std::byte(mode < 2 ? mode : 2 | below(16) << 4));
        }
        for (size_t first = 0; first < count; first += maxBlock) {
            const size_t n = std::min(maxBlock, count - first);
            block(elements.subspan(first * stride, n * stride), stride, version, modes, last);
        }
        const size_t tail = stride + (version > 0 ? modes.size() : 0);
        mStream.resize(mStream.size() + std::max<size_t>(tail, version > 0 ? 24 : 32) - tail);
        mStream.insert(mStream.end(), baseline.begin(), baseline.end());
        if (version > 0) mStream.insert(mStream.end(), modes.begin(), modes.end());
        return mStream;
    }

    /// "Mode 2: indices".
    Bytes indices(std::span<const uint32_t> values) {
        mStream.clear();
        put(0xD1);
        std::array<uint32_t, 2> last{};
        for (const uint32_t value : values) {
            uint32_t baseline = below(2);
            if (!fits(value - last[baseline])) baseline ^= 1; // deltas have 31 bits
            varint(zigzag(value - last[baseline]) << 1 | baseline);
            last[baseline] = value;
        }
        mStream.resize(mStream.size() + 4);
        return mStream;
    }

    /// "Mode 1: triangles": codes by chance, and in `out` what they stand for.
    Bytes triangles(size_t count, std::vector<uint32_t>& out) {
        Bytes codes{ std::byte{ 0xE1 } };
        mStream.clear();
        mEdges.clear();
        mVertices.clear();
        mNext = mLast = 0;
        std::array<uint8_t, 16> table{};
        for (size_t i = 0; i < 14; ++i) table[i] = static_cast<uint8_t>(below(15) << 4 | below(15));
        for (size_t i = 0; i < count; ++i) {
            const std::array<uint32_t, 3> t = triangle(table, codes);
            out.insert(out.end(), t.begin(), t.end());
        }
        codes.insert(codes.end(), mStream.begin(), mStream.end());
        for (const uint8_t byte : table) codes.push_back(std::byte(byte));
        return codes;
    }

private:
    void put(uint32_t byte) { mStream.push_back(std::byte(byte)); }

    static uint32_t zigzag(uint32_t delta) { return delta >> 31 ? ~(delta << 1) : delta << 1; }
    static bool fits(uint32_t delta) { return delta + (1u << 30) < 1u << 31; }

    void varint(uint32_t value) {
        for (; value > 127; value >>= 7) put((value & 127) | 128);
        put(value);
    }

    static uint32_t load(std::span<const std::byte> bytes, size_t at) {
        uint32_t value;
        std::memcpy(&value, &bytes[at], 4);
        return value;
    }

    /// The delta of one channel; a part is a byte, a word or all of it.
    static uint32_t delta(uint32_t mode, uint32_t value, uint32_t before) {
        if (mode >= 2) return std::rotl(value ^ before, static_cast<int>(mode >> 4));
        uint32_t result = 0;
        const uint32_t bits = mode == 0 ? 8 : 16, mask = (1u << bits) - 1;
        for (uint32_t shift = 0; shift < 32; shift += bits) {
            const uint32_t d = ((value >> shift) - (before >> shift)) & mask;
            result |= ((d >> (bits - 1) ? ~(d << 1) : d << 1) & mask) << shift;
        }
        return result;
    }

    void block(std::span<const std::byte> elements, size_t stride, uint32_t version, Bytes const& modes, Bytes& last) {
        const size_t header = mStream.size(), count = elements.size() / stride;
        if (version > 0) mStream.resize(header + stride / 4);
        for (size_t channel = 0; channel < stride / 4; ++channel) {
            std::array<std::vector<uint8_t>, 4> planes;
            uint32_t before = load(last, channel * 4);
            for (size_t i = 0; i < count; ++i) {
                const uint32_t value = load(elements, i * stride + channel * 4);
                const uint32_t d = delta(std::to_integer<uint32_t>(modes[channel]), value, before);
                for (uint32_t k = 0; k < 4; ++k) planes[k].push_back(static_cast<uint8_t>(d >> 8 * k));
                before = value;
            }
            std::memcpy(&last[channel * 4], &before, 4);
            for (uint32_t k = 0; k < 4; ++k) {
                const uint32_t control = plane(planes[k], version);
                if (version > 0) mStream[header + channel] |= std::byte(control << 2 * k);
            }
        }
    }

    /// Returns its control mode.
    uint32_t plane(std::vector<uint8_t>& deltas, uint32_t version) {
        static constexpr uint32_t kBits[3][4] = { { 0, 1, 2, 4 }, { 1, 2, 4, 8 }, { 0, 2, 4, 8 } };
        const bool isZero = std::ranges::all_of(deltas, [](uint8_t d) { return d == 0; });
        uint32_t control = version > 0 ? below(4) : 0;
        if (control == 2 && !isZero) control = below(2);
        if (control == 2) return control;
        if (control == 3) {
            for (const uint8_t d : deltas) put(d);
            return control;
        }
        deltas.resize((deltas.size() + 15) & ~size_t{ 15 });
        const size_t header = mStream.size(), groups = deltas.size() / 16;
        mStream.resize(header + (groups + 3) / 4);
        for (size_t g = 0; g < groups; ++g) {
            const std::span<const uint8_t> group = std::span(deltas).subspan(g * 16, 16);
            uint32_t code = below(4);
            const uint32_t* bits = kBits[version == 0 ? 2 : control];
            if (bits[code] == 0 && std::ranges::any_of(group, [](uint8_t d) { return d != 0; })) code = 1 + below(3);
            mStream[header + g / 4] |= std::byte(code << g % 4 * 2);
            groupOf(group, bits[code]);
        }
        return control;
    }

    void groupOf(std::span<const uint8_t> deltas, uint32_t bits) {
        if (bits == 0) return;
        const uint32_t sentinel = (1u << bits) - 1, perByte = 8 / bits;
        std::vector<uint8_t> literals;
        for (uint32_t i = 0; i < 16; i += perByte) {
            uint32_t byte = 0;
            for (uint32_t k = 0; k < perByte; ++k) {
                const uint8_t d = deltas[i + k];
                const bool isLiteral = bits < 8 && (d >= sentinel || below(16) == 0);
                if (isLiteral) literals.push_back(d);
                byte |= (isLiteral ? sentinel : d) << (bits == 1 ? k : 8 - bits * (k + 1));
            }
            put(byte);
        }
        for (const uint8_t d : literals) put(d);
    }

    /// Index i of the decoder's FIFO: 0 is the newest.
    template <class Entry>
    static Entry recent(std::vector<Entry> const& entries, size_t i) {
        return entries[entries.size() - 1 - i];
    }

    uint32_t explicitIndex() {
        const uint32_t value = below(4) == 0 ? below(~0u) : mLast + below(200) - 100;
        varint(zigzag(value - mLast));
        return mLast = value;
    }

    std::array<uint32_t, 3> triangle(std::array<uint8_t, 16> const& table, Bytes& codes) {
        const size_t edges = std::min<size_t>(mEdges.size(), 15), vertices = std::min<size_t>(mVertices.size(), 14);
        if (edges > 0 && below(3) > 0) {
            const uint32_t x = below(static_cast<uint32_t>(edges));
            uint32_t y = below(16);
            if (y > 0 && y < 13 && y >= vertices) y = 0;
            codes.push_back(std::byte(x << 4 | y));
            const auto [a, b] = recent(mEdges, x);
            const uint32_t c = y == 0    ? mNext++
                               : y < 13  ? recent(mVertices, y)
                               : y == 13 ? --mLast
                               : y == 14 ? ++mLast
                                         : explicitIndex();
            mEdges.insert(mEdges.end(), { { c, b }, { a, c } });
            if (y == 0 || y > 12) mVertices.push_back(c);
            return { a, b, c };
        }
        uint32_t y = below(16), pair = table[y];
        if (y < 14 && (pair >> 4 > vertices || (pair & 15) > vertices)) y = 14;
        if (y > 13) {
            const auto corner = [&] { return below(3) == 0 ? 15 : below(static_cast<uint32_t>(vertices) + 1); };
            pair = corner() << 4;
            pair |= corner();
            put(pair);
            if (pair == 0) mNext = 0;
        }
        codes.push_back(std::byte(0xF0 | y));
        const auto cornerOf = [&](uint32_t z) {
            return z == 0 ? mNext++ : z == 15 ? explicitIndex() : recent(mVertices, z - 1);
        };
        const uint32_t a = y == 15 ? explicitIndex() : mNext++;
        const uint32_t b = cornerOf(pair >> 4), c = cornerOf(pair & 15);
        mEdges.insert(mEdges.end(), { { b, a }, { c, b }, { a, c } });
        mVertices.push_back(a);
        if (pair >> 4 == 0 || pair >> 4 == 15) mVertices.push_back(b);
        if ((pair & 15) == 0 || (pair & 15) == 15) mVertices.push_back(c);
        return { a, b, c };
    }

    std::mt19937 mRandom;
    Bytes mStream;
    std::vector<std::array<uint32_t, 2>> mEdges;
    std::vector<uint32_t> mVertices;
    uint32_t mNext = 0, mLast = 0;
};

} // namespace filament_core::assets::test
