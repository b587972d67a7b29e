// SPDX-License-Identifier: Apache-2.0
// KHR_meshopt_compression, appendix B. Four elements at a time. Results of the exponential filter are exact; the others
// are rounded once from a float that is closer to the exact value than the specification asks (one unit).
#include "filament_core/assets/gltf/MeshoptStreams.h"

#include "base/math/Simd.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core::assets {
namespace {

using simd::Float4;
using Int4 [[gnu::vector_size(16)]] = int32_t;

/// Component k of four elements.
using Components = std::array<Int4, 4>;

/// Four elements of four components: of 8 bits in 16 bytes, or of 16 bits in 32.
template <uint32_t Bits>
struct Quad {
    static constexpr size_t kSize = Bits * 2;
    static constexpr float kSignedMax = Bits == 8 ? 127 : 32767, kUnsignedMax = Bits == 8 ? 255 : 65535;
    static constexpr int32_t kMask = (1 << Bits) - 1;

    static Components load(const std::byte* from) {
        Components c;
        if constexpr (Bits == 8) {
            Int4 words;
            std::memcpy(&words, from, sizeof words);
            for (int k = 0; k < 4; ++k) c[static_cast<size_t>(k)] = words << (24 - 8 * k) >> 24;
        } else {
            Int4 first, second;
            std::memcpy(&first, from, sizeof first);
            std::memcpy(&second, from + 16, sizeof second);
            const Int4 low = __builtin_shufflevector(first, second, 0, 2, 4, 6);
            const Int4 high = __builtin_shufflevector(first, second, 1, 3, 5, 7);
            c = { low << 16 >> 16, low >> 16, high << 16 >> 16, high >> 16 };
        }
        return c;
    }

    static void store(Components const& c, std::byte* to) {
        if constexpr (Bits == 8) {
            const Int4 words = (c[0] & 255) | (c[1] & 255) << 8 | (c[2] & 255) << 16 | c[3] << 24;
            std::memcpy(to, &words, sizeof words);
        } else {
            const Int4 low = (c[0] & 65535) | c[1] << 16, high = (c[2] & 65535) | c[3] << 16;
            const Int4 first = __builtin_shufflevector(low, high, 0, 4, 1, 5);
            const Int4 second = __builtin_shufflevector(low, high, 2, 6, 3, 7);
            std::memcpy(to, &first, sizeof first);
            std::memcpy(to + 16, &second, sizeof second);
        }
    }
};

Float4 toFloat(Int4 value) { return __builtin_convertvector(value, Float4); }

Float4 squareRoot(Float4 value) {
#if defined(__SSE2__)
    return std::bit_cast<Float4>(_mm_sqrt_ps(std::bit_cast<__m128>(value)));
#else
    return { std::sqrt(value[0]), std::sqrt(value[1]), std::sqrt(value[2]), std::sqrt(value[3]) };
#endif
}

/// The nearest integer, halfway cases away from zero, as round() of the specification.
Int4 roundAway(Float4 value) {
    const Int4 sign = std::bit_cast<Int4>(value) & std::numeric_limits<int32_t>::min();
    const Float4 half = std::bit_cast<Float4>(sign | std::bit_cast<Int4>(Float4{} + 0.5f));
    return __builtin_convertvector(value + half, Int4);
}

Int4 magnitude(Int4 value) { return value < 0 ? -value : value; }
Int4 atLeast(Int4 value, int32_t least) { return value < least ? Int4{} + least : value; }

/// "Filter 1: octahedral". The division by the encoded 1.0 is left out: it cancels with the normalisation, and without
/// it the vector consists of exact integers.
template <uint32_t Bits>
void decodeOctahedral(std::byte* elements) {
    Components c = Quad<Bits>::load(elements);
    c[2] -= magnitude(c[0]) + magnitude(c[1]);
    const Int4 fold = c[2] < 0 ? c[2] : Int4{}; // the lower hemisphere
    c[0] += c[0] < 0 ? -fold : fold;
    c[1] += c[1] < 0 ? -fold : fold;
    const Float4 x = toFloat(c[0]), y = toFloat(c[1]), z = toFloat(c[2]);
    const Float4 squared = x * x + y * y + z * z;
    const Float4 scale = Quad<Bits>::kSignedMax / squareRoot(squared < 1 ? Float4{} + 1 : squared); // 0: invalid
    c[0] = roundAway(x * scale);
    c[1] = roundAway(y * scale);
    c[2] = roundAway(z * scale);
    Quad<Bits>::store(c, elements);
}

/// "Filter 2: quaternion".
void decodeQuaternion(std::byte* elements) {
    constexpr float kRange = 0.70710678f; // 1 / sqrt(2)
    constexpr float kMax = Quad<16>::kSignedMax;
    const Components c = Quad<16>::load(elements);
    const Float4 scale = kRange / toFloat(c[3] | 3);
    const Float4 x = toFloat(c[0]) * scale, y = toFloat(c[1]) * scale, z = toFloat(c[2]) * scale;
    const Float4 rest = 1.0f - x * x - y * y - z * z;
    const Float4 w = squareRoot(rest < 0 ? Float4{} : rest);
    const Components q{ roundAway(w * kMax), roundAway(x * kMax), roundAway(y * kMax), roundAway(z * kMax) };
    Quad<16>::store(q, elements);
    for (size_t i = 0; i < 4; ++i) { // the largest component, w here, belongs at index c[3] & 3, the others behind it
        uint64_t element;
        std::memcpy(&element, elements + i * 8, sizeof element);
        element = std::rotl(element, (c[3][i] & 3) * 16);
        std::memcpy(elements + i * 8, &element, sizeof element);
    }
}

/// "Filter 3: exponential". Exponents beyond those of normal floats are invalid.
void decodeExponential(std::byte* elements) {
    Int4 words;
    std::memcpy(&words, elements, sizeof words);
    const Int4 exponent = atLeast((words >> 24) + 127, 1);
    const Float4 value = toFloat(words << 8 >> 8) * std::bit_cast<Float4>(exponent << 23);
    std::memcpy(elements, &value, sizeof value);
}

/// "Filter 4: color". The highest bit of alpha tells the number of bits; `ones` are all of these.
template <uint32_t Bits>
void decodeColor(std::byte* elements) {
    constexpr int32_t kMask = Quad<Bits>::kMask;
    const Components c = Quad<Bits>::load(elements);
    const Int4 luma = c[0] & kMask, encodedAlpha = c[3] & kMask;
    Int4 ones = encodedAlpha | encodedAlpha >> 1;
    ones |= ones >> 2;
    ones |= ones >> 4;
    ones = atLeast(ones | ones >> 8, 1); // 0: invalid
    const Int4 alpha = encodedAlpha & ones >> 1;
    const Float4 scale = Quad<Bits>::kUnsignedMax / toFloat(ones);
    const auto scaled = [&](Int4 value) { return roundAway(toFloat(value) * scale); };
    Quad<Bits>::store({ scaled(luma + c[1] - c[2]), scaled(luma + c[2]), scaled(luma - c[1] - c[2]),
                        scaled(alpha << 1 | (alpha & 1)) },
                      elements);
}

template <size_t Size, void (*Decode)(std::byte*)>
void forEachQuad(std::span<std::byte> elements) {
    size_t at = 0;
    for (; at + Size <= elements.size(); at += Size) Decode(&elements[at]);
    if (at == elements.size()) return;
    std::array<std::byte, Size> rest{};
    std::copy(elements.begin() + static_cast<std::ptrdiff_t>(at), elements.end(), rest.begin());
    Decode(rest.data());
    std::copy_n(rest.begin(), elements.size() - at, elements.begin() + static_cast<std::ptrdiff_t>(at));
}

} // namespace

void applyMeshoptFilter(MeshoptFilter filter, size_t stride, std::span<std::byte> elements) {
    const bool isNarrow = stride == 4;
    switch (filter) {
    case MeshoptFilter::None:
        break;
    case MeshoptFilter::Octahedral:
        return isNarrow ? forEachQuad<16, decodeOctahedral<8>>(elements)
                        : forEachQuad<32, decodeOctahedral<16>>(elements);
    case MeshoptFilter::Quaternion:
        return forEachQuad<32, decodeQuaternion>(elements);
    case MeshoptFilter::Exponential:
        return forEachQuad<16, decodeExponential>(elements);
    case MeshoptFilter::Color:
        return isNarrow ? forEachQuad<16, decodeColor<8>>(elements) : forEachQuad<32, decodeColor<16>>(elements);
    }
}

} // namespace filament_core::assets
