// SPDX-License-Identifier: Apache-2.0
// KHR_meshopt_compression, appendix A, "Mode 1: triangles" and "Mode 2: indices".
#include "filament_core/assets/gltf/MeshoptStreams.h"

#include <algorithm>
#include <array>

namespace filament_core::assets {
namespace {

/// Unsigned LEB128, at most five bytes, all of which may be read. Bits beyond 32 are ignored.
[[gnu::always_inline]] inline bool readVarint(const uint8_t*& at, uint32_t& value) {
    value = *at++;
    if (value < 128) return true; // nearly always
    value &= 127;
    for (uint32_t shift = 7; shift < 35; shift += 7) {
        const uint8_t byte = *at++;
        value |= uint32_t{ byte & 127u } << shift;
        if (byte < 128) return true;
    }
    return false;
}

/// Signed numbers by their distance from 0, the sign in the lowest bit.
uint32_t zigzagDelta(uint32_t value) { return (value >> 1) ^ (0u - (value & 1)); }

/// The last 16 entries; 0 is the newest. Reading one that was never written breaks the stream. The entries are outside,
/// so that the compiler keeps the rest in registers: a third of the time.
template <class Entry>
class Fifo {
public:
    using Entries = std::array<Entry, 16>;

    explicit Fifo(Entries& entries) : mEntries(entries.data()) {}

    void push(Entry entry) { mEntries[mCount++ % 16] = entry; }

    Entry read(size_t index) {
        mIsBroken |= index >= mCount;
        return mEntries[(mCount - 1 - index) % 16];
    }

    bool isBroken() const { return mIsBroken; }

private:
    Entry* mEntries;
    size_t mCount = 0;
    bool mIsBroken = false;
};

template <class Index>
class TriangleReader {
public:
    /// `data` and the 16 bytes of `aux` behind it may be read.
    TriangleReader(const uint8_t* data, const uint8_t* aux, Fifo<uint64_t> edges, Fifo<uint32_t> vertices)
            : mData(data), mAux(aux), mEdges(edges), mVertices(vertices) {}

    [[gnu::always_inline]] void read(uint8_t code, Index* triangle) {
        const uint32_t high = code >> 4, low = code & 15;
        return high < 15 ? edgeAndVertex(high, low, triangle) : threeVertices(low, triangle);
    }

    const uint8_t* data() const { return mData; }
    bool isBroken() const { return mIsBroken || mEdges.isBroken() || mVertices.isBroken(); }

private:
    /// Vertices a and b in one word, which the CPU forwards from the store to the load.
    static uint64_t edge(uint32_t a, uint32_t b) { return a | uint64_t{ b } << 32; }

    /// decodeIndex() of the specification, with the bytes that it reads.
    [[gnu::always_inline]] uint32_t explicitIndex() {
        uint32_t value = 0;
        mIsBroken |= !readVarint(mData, value);
        return mLast += zigzagDelta(value);
    }

    /// Codes 0xX0 to 0xXf, X < 0xf.
    [[gnu::always_inline]] void edgeAndVertex(uint32_t index, uint32_t code, Index* triangle) {
        const uint64_t ab = mEdges.read(index);
        const auto a = static_cast<uint32_t>(ab), b = static_cast<uint32_t>(ab >> 32);
        uint32_t c = 0;
        if (code == 0)
            c = mNext++;
        else if (code < 13)
            c = mVertices.read(code);
        else if (code < 15)
            c = mLast = mLast + (code == 13 ? ~0u : 1u);
        else
            c = explicitIndex();
        mEdges.push(edge(c, b));
        mEdges.push(edge(a, c));
        if (code == 0 || code >= 13) mVertices.push(c);
        emit(a, b, c, triangle);
    }

    /// Codes 0xf0 to 0xff.
    [[gnu::always_inline]] void threeVertices(uint32_t code, Index* triangle) {
        const bool isExplicit = code >= 14;
        const uint8_t pair = isExplicit ? *mData++ : mAux[code];
        if (isExplicit && pair == 0) mNext = 0;
        const uint32_t z = pair >> 4, w = pair & 15; // 15 occurs in explicit pairs alone
        const uint32_t a = code == 15 ? explicitIndex() : mNext++;
        const uint32_t b = corner(z), c = corner(w);
        mEdges.push(edge(b, a));
        mEdges.push(edge(c, b));
        mEdges.push(edge(a, c));
        mVertices.push(a);
        if (z == 0 || z == 15) mVertices.push(b);
        if (w == 0 || w == 15) mVertices.push(c);
        emit(a, b, c, triangle);
    }

    /// 16-bit indices "with wraparound".
    static void emit(uint32_t a, uint32_t b, uint32_t c, Index* triangle) {
        triangle[0] = static_cast<Index>(a);
        triangle[1] = static_cast<Index>(b);
        triangle[2] = static_cast<Index>(c);
    }

    [[gnu::always_inline]] uint32_t corner(uint32_t code) {
        if (code == 0) return mNext++;
        return code < 15 ? mVertices.read(code - 1) : explicitIndex();
    }

    const uint8_t* mData;
    const uint8_t* mAux;
    uint32_t mNext = 0, mLast = 0;
    Fifo<uint64_t> mEdges;
    Fifo<uint32_t> mVertices;
    bool mIsBroken = false;
};

template <class Index>
std::string_view decodeTriangles(const uint8_t* codes, const uint8_t* tail, std::span<Index> out) {
    const size_t triangles = out.size() / 3;
    Fifo<uint64_t>::Entries edges{};
    Fifo<uint32_t>::Entries vertices{};
    TriangleReader<Index> reader(codes + triangles, tail, Fifo(edges), Fifo(vertices));
    for (size_t i = 0; i < triangles; ++i) {
        if (reader.data() > tail) return kMeshoptTooShort; // a triangle takes at most 16 bytes, as many as the tail has
        reader.read(codes[i], &out[i * 3]);
    }
    if (reader.data() > tail) return kMeshoptTooShort;
    if (reader.data() < tail) return kMeshoptLeftOver;
    return reader.isBroken() ? "it names an edge or vertex that it did not write before" : std::string_view{};
}

template <class Index>
std::string_view decodeIndices(const uint8_t* at, const uint8_t* tail, std::span<Index> out) {
    std::array<uint32_t, 2> last{}; // of the two baselines
    for (Index& index : out) {
        uint32_t value = 0;
        if (at >= tail) return kMeshoptTooShort; // a number takes at most 5 bytes, one more than the tail has
        if (!readVarint(at, value)) return "it has a number of more than five bytes";
        index = static_cast<Index>(last[value & 1] += zigzagDelta(value >> 1));
    }
    if (at > tail) return kMeshoptTooShort;
    return at == tail ? std::string_view{} : kMeshoptLeftOver;
}

/// The elements as indices of 2 or 4 bytes, "with wraparound"; vectors of bytes have the alignment of any type.
template <class Index>
std::span<Index> indicesIn(std::span<std::byte> bytes) {
    return { reinterpret_cast<Index*>(bytes.data()), bytes.size() / sizeof(Index) };
}

} // namespace

std::string_view decodeMeshoptTriangles(std::span<const std::byte> bytes, size_t stride, std::span<std::byte> out) {
    constexpr uint8_t kHeader = 0xE1;
    constexpr size_t kTail = 16;
    const auto* begin = reinterpret_cast<const uint8_t*>(bytes.data());
    if (bytes.empty() || begin[0] != kHeader) return "its first byte is not 0xE1, that of TRIANGLES";
    if (bytes.size() < 1 + out.size() / (3 * stride) + kTail) return kMeshoptTooShort;
    const uint8_t* tail = begin + bytes.size() - kTail;
    const bool isTable = std::all_of(tail, tail + kTail, [](uint8_t x) { return x < 0xF0 && (x & 15) < 15; });
    if (!isTable || tail[14] != 0 || tail[15] != 0) return "its tail is not a table of vertex pairs";
    return stride == 2 ? decodeTriangles(begin + 1, tail, indicesIn<uint16_t>(out))
                       : decodeTriangles(begin + 1, tail, indicesIn<uint32_t>(out));
}

std::string_view decodeMeshoptIndices(std::span<const std::byte> bytes, size_t stride, std::span<std::byte> out) {
    constexpr uint8_t kHeader = 0xD1;
    constexpr size_t kTail = 4; // "should be set to 0", which nothing depends on
    const auto* begin = reinterpret_cast<const uint8_t*>(bytes.data());
    if (bytes.empty() || begin[0] != kHeader) return "its first byte is not 0xD1, that of INDICES";
    if (bytes.size() < 1 + out.size() / stride + kTail) return kMeshoptTooShort;
    const uint8_t* tail = begin + bytes.size() - kTail;
    return stride == 2 ? decodeIndices(begin + 1, tail, indicesIn<uint16_t>(out))
                       : decodeIndices(begin + 1, tail, indicesIn<uint32_t>(out));
}

} // namespace filament_core::assets
