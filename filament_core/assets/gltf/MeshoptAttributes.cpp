// SPDX-License-Identifier: Apache-2.0
// KHR_meshopt_compression, appendix A, "Mode 0: attributes". Elements are split into channels of four bytes, and the
// bytes of a channel into four planes, each with the deltas of up to 256 elements in groups of 16.
#include "filament_core/assets/gltf/MeshoptStreams.h"

#include "base/math/Simd.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace filament_core::assets {
namespace {

using Bytes16 [[gnu::vector_size(16)]] = uint8_t;
using Words8 [[gnu::vector_size(16)]] = uint16_t;
using Dwords4 [[gnu::vector_size(16)]] = uint32_t;
using Qwords2 [[gnu::vector_size(16)]] = uint64_t;

constexpr size_t kGroup = 16, kMaxBlock = 256, kMaxStride = 256;
using Plane = std::array<Bytes16, kMaxBlock / kGroup>;

/// How eight literal bytes in a row move to the lanes whose bit is set: by 4 lanes, then 2, then 1 (the inverse of
/// "compress", Warren, "Hacker's Delight", section 7-5). Without branches, because nothing predicts sentinels.
struct Spread {
    uint64_t keep = 0, by4 = 0, by2 = 0, by1 = 0;
};

struct SpreadTable {
    std::array<Spread, 256> of;
    std::array<uint8_t, 256> count{};
};

constexpr SpreadTable makeSpreadTable() {
    SpreadTable table{};
    for (uint32_t mask = 0; mask < 256; ++mask) {
        Spread& spread = table.of[mask];
        uint32_t literal = 0;
        for (uint32_t lane = 0; lane < 8; ++lane) {
            if ((mask >> lane & 1) == 0) continue;
            const uint32_t way = lane - literal;
            const auto byteAt = [](uint32_t position) { return uint64_t{ 0xFF } << 8 * position; };
            spread.keep |= byteAt(literal);
            if (way & 4) spread.by4 |= byteAt(literal);
            if (way & 2) spread.by2 |= byteAt(literal + (way & 4));
            if (way & 1) spread.by1 |= byteAt(literal + (way & 6));
            ++literal;
        }
        table.count[mask] = static_cast<uint8_t>(literal);
    }
    return table;
}

constexpr SpreadTable kSpread = makeSpreadTable();

template <class T>
T loadFrom(const uint8_t* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

uint64_t spreadLiterals(const uint8_t* at, uint32_t mask) {
    Spread const& spread = kSpread.of[mask];
    uint64_t bytes = loadFrom<uint64_t>(at) & spread.keep, moved = bytes & spread.by4;
    bytes = (bytes ^ moved) | moved << 32;
    moved = bytes & spread.by2;
    bytes = (bytes ^ moved) | moved << 16;
    moved = bytes & spread.by1;
    return (bytes ^ moved) | moved << 8;
}

/// Bit i: whether lane i, which is 0 or 255, is set.
uint32_t maskOf(Bytes16 lanes) {
#if defined(__SSE2__)
    return static_cast<uint32_t>(_mm_movemask_epi8(std::bit_cast<__m128i>(lanes)));
#else
    const auto halves = std::bit_cast<std::array<uint64_t, 2>>(lanes);
    return simd::bitOfEachByte(halves[0], 0) | simd::bitOfEachByte(halves[1], 0) << 8;
#endif
}

/// The lower halves of both, lane by lane in turns.
Bytes16 zipLow(Bytes16 a, Bytes16 b) {
    return __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
}

Bytes16 zipHigh(Bytes16 a, Bytes16 b) {
    return __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
}

/// Lanes that hold the sentinel take their values from the literals at `at`, in order; returns what follows them.
const uint8_t* fillSentinels(const uint8_t* at, Bytes16& values, Bytes16 isSentinel, uint32_t mask) {
    const uint32_t low = mask & 255, high = mask >> 8;
    const uint8_t* second = at + kSpread.count[low];
    const Qwords2 literals{ spreadLiterals(at, low), spreadLiterals(second, high) };
    values = (values & ~isSentinel) | std::bit_cast<Bytes16>(literals);
    return second + kSpread.count[high];
}

/// The 16 deltas of a group in 0, 1, 2, 4 or 8 bits each. Reads at most 24 bytes; returns what follows the group.
const uint8_t* readGroup(const uint8_t* at, uint32_t bits, Bytes16& deltas) {
    switch (bits) {
    case 0:
        deltas = Bytes16{};
        return at;
    case 1:
        deltas = Bytes16{};
        return fillSentinels(at + 2, deltas, Bytes16{}, loadFrom<uint16_t>(at));
    case 2: {
        const auto packed = std::bit_cast<Bytes16>(Qwords2{ loadFrom<uint32_t>(at), 0 });
        const Bytes16 pairs = zipLow(packed >> 4, packed & 15);
        deltas = zipLow(pairs >> 2, pairs & 3);
        const auto isSentinel = std::bit_cast<Bytes16>(deltas == 3);
        return fillSentinels(at + 4, deltas, isSentinel, maskOf(isSentinel));
    }
    case 4: {
        const auto packed = std::bit_cast<Bytes16>(Qwords2{ loadFrom<uint64_t>(at), 0 });
        deltas = zipLow(packed >> 4, packed & 15);
        const auto isSentinel = std::bit_cast<Bytes16>(deltas == 15);
        return fillSentinels(at + 8, deltas, isSentinel, maskOf(isSentinel));
    }
    default:
        deltas = loadFrom<Bytes16>(at);
        return at + kGroup;
    }
}

/// The blocks of a stream, and what goes from one to the next.
struct Reader {
    const uint8_t* at;
    const uint8_t* tail; ///< at least 24 bytes, so that a group that begins before it may be read
    uint32_t version;
    const uint8_t* channelModes;
    std::array<uint32_t, kMaxStride / 4> last; ///< the last element, by channel

    bool readPlane(uint32_t control, size_t elements, Plane& plane);
    bool readBlock(size_t stride, size_t elements, std::byte* out);
};

bool Reader::readPlane(uint32_t control, size_t elements, Plane& plane) {
    constexpr uint32_t kZeros = 2, kLiteral = 3;
    const size_t groups = (elements + kGroup - 1) / kGroup;
    const auto left = static_cast<size_t>(tail - at);
    if (control == kZeros) {
        std::fill_n(plane.begin(), groups, Bytes16{});
        return true;
    }
    if (control == kLiteral) {
        if (left < elements) return false;
        std::memcpy(plane.data(), at, elements);
        at += elements;
        return true;
    }
    constexpr uint8_t kBits[3][4] = { { 0, 1, 2, 4 }, { 1, 2, 4, 8 }, { 0, 2, 4, 8 } };
    const auto& bits = kBits[version == 0 ? 2 : control];
    const uint8_t* header = at;
    if (left < (groups + 3) / 4) return false;
    at += (groups + 3) / 4;
    for (size_t i = 0; i < groups; ++i) {
        at = readGroup(at, bits[header[i / 4] >> i % 4 * 2 & 3], plane[i]);
        if (at > tail) return false;
    }
    return true;
}

template <class Lanes>
Lanes decodeZigzag(Lanes lanes) {
    return (lanes >> 1) ^ -(lanes & 1);
}

/// "Channel mode 0 (byte deltas)", "1 (2-byte deltas)" and "2 (4-byte XOR deltas)": deltas of four elements, and the
/// sum of two values.
struct ByteDeltas {
    Dwords4 decode(Dwords4 deltas) const {
        return std::bit_cast<Dwords4>(decodeZigzag(std::bit_cast<Bytes16>(deltas)));
    }
    static Dwords4 sum(Dwords4 a, Dwords4 b) {
        return std::bit_cast<Dwords4>(std::bit_cast<Bytes16>(a) + std::bit_cast<Bytes16>(b));
    }
};

struct WordDeltas {
    Dwords4 decode(Dwords4 deltas) const { return std::bit_cast<Dwords4>(decodeZigzag(std::bit_cast<Words8>(deltas))); }
    static Dwords4 sum(Dwords4 a, Dwords4 b) {
        return std::bit_cast<Dwords4>(std::bit_cast<Words8>(a) + std::bit_cast<Words8>(b));
    }
};

struct XorDeltas {
    uint32_t turn; ///< rotate() of the specification is the encoder's; here it is undone
    Dwords4 decode(Dwords4 deltas) const { return deltas >> turn | deltas << ((32 - turn) & 31); }
    static Dwords4 sum(Dwords4 a, Dwords4 b) { return a ^ b; }
};

/// Elements 0..n of one channel: the running sum of their deltas, from the last element of the block before.
template <class Deltas>
void restoreChannel(std::array<Plane, 4> const& planes, size_t groups, Deltas deltas, uint32_t& last, Dwords4* values) {
    Dwords4 carry = Dwords4{} + last;
    const auto four = [&](Words8 interleaved) {
        constexpr Dwords4 kZero{};
        Dwords4 v = deltas.decode(std::bit_cast<Dwords4>(interleaved));
        // The running sum of four lanes in two steps (Hillis and Steele 1986, "Data Parallel Algorithms"). All three
        // sums are associative and exact, so this equals the sum one by one.
        v = Deltas::sum(v, __builtin_shufflevector(v, kZero, 4, 0, 1, 2));
        v = Deltas::sum(v, __builtin_shufflevector(v, kZero, 4, 4, 0, 1));
        v = Deltas::sum(v, carry);
        carry = __builtin_shufflevector(v, v, 3, 3, 3, 3);
        *values++ = v;
    };
    for (size_t i = 0; i < groups; ++i) {
        const auto low01 = std::bit_cast<Words8>(zipLow(planes[0][i], planes[1][i]));
        const auto high01 = std::bit_cast<Words8>(zipHigh(planes[0][i], planes[1][i]));
        const auto low23 = std::bit_cast<Words8>(zipLow(planes[2][i], planes[3][i]));
        const auto high23 = std::bit_cast<Words8>(zipHigh(planes[2][i], planes[3][i]));
        four(__builtin_shufflevector(low01, low23, 0, 8, 1, 9, 2, 10, 3, 11));
        four(__builtin_shufflevector(low01, low23, 4, 12, 5, 13, 6, 14, 7, 15));
        four(__builtin_shufflevector(high01, high23, 0, 8, 1, 9, 2, 10, 3, 11));
        four(__builtin_shufflevector(high01, high23, 4, 12, 5, 13, 6, 14, 7, 15));
    }
    last = carry[0];
}

bool Reader::readBlock(size_t stride, size_t elements, std::byte* out) {
    const size_t groups = (elements + kGroup - 1) / kGroup;
    const uint8_t* controls = at;
    if (version > 0) {
        if (static_cast<size_t>(tail - at) < stride / 4) return false;
        at += stride / 4;
    }
    std::array<Plane, 4> planes;
    std::array<Dwords4, kMaxBlock / 4> values;
    for (size_t channel = 0; channel < stride / 4; ++channel) {
        const uint32_t control = version > 0 ? controls[channel] : 0;
        for (uint32_t i = 0; i < 4; ++i) {
            if (!readPlane(control >> 2 * i & 3, elements, planes[i])) return false;
        }
        const uint32_t mode = version > 0 ? channelModes[channel] : 0;
        if (mode == 0) restoreChannel(planes, groups, ByteDeltas{}, last[channel], values.data());
        if (mode == 1) restoreChannel(planes, groups, WordDeltas{}, last[channel], values.data());
        if (mode > 1) restoreChannel(planes, groups, XorDeltas{ mode >> 4 }, last[channel], values.data());
        const auto* from = reinterpret_cast<const std::byte*>(values.data());
        std::byte* to = out + channel * 4;
        for (size_t i = 0; i < elements; ++i) std::memcpy(to + i * stride, from + i * 4, 4);
    }
    return true;
}

} // namespace

std::string_view decodeMeshoptAttributes(std::span<const std::byte> bytes, uint32_t maxVersion, size_t stride,
                                         size_t count, std::span<std::byte> out) {
    constexpr uint8_t kHeader = 0xA0;
    const auto* begin = reinterpret_cast<const uint8_t*>(bytes.data());
    if (bytes.empty() || (begin[0] & 0xF0) != kHeader || begin[0] > kHeader + 1) {
        return "its first byte is not that of ATTRIBUTES in version 0 or 1";
    }
    const uint32_t version = begin[0] - kHeader;
    if (version > maxVersion) return "its codec version 1 needs KHR_meshopt_compression";
    const size_t tailSize = version == 0 ? stride : stride + stride / 4; // baseline element, channel modes
    const size_t paddedTail = std::max<size_t>(tailSize, version == 0 ? 32 : 24);
    if (bytes.size() < 1 + paddedTail) return kMeshoptTooShort;
    const uint8_t* end = begin + bytes.size();
    Reader reader{ begin + 1, end - paddedTail, version, end - stride / 4, {} };
    std::memcpy(reader.last.data(), end - tailSize, stride);
    for (size_t i = 0; i < stride / 4 && version > 0; ++i) {
        const uint32_t mode = reader.channelModes[i];
        if ((mode & 15) > 2 || ((mode & 15) < 2 && mode > 1)) return "its tail has an unknown channel mode";
    }
    const size_t maxElements = std::min<size_t>((8192 / stride) & ~size_t{ 15 }, kMaxBlock);
    for (size_t first = 0; first < count; first += maxElements) {
        const size_t elements = std::min(maxElements, count - first);
        if (!reader.readBlock(stride, elements, out.data() + first * stride)) return kMeshoptTooShort;
    }
    return reader.at == reader.tail ? std::string_view{} : kMeshoptLeftOver;
}

} // namespace filament_core::assets
