// SPDX-License-Identifier: Apache-2.0
/// Simd: eight floats at a time in two registers of four, on any CPU that GCC or Clang supports (SSE2 and NEON are the
/// baselines of their platforms).
///   Bits    an operation on lanes gives the same bits as the operation on each float alone: nothing is contracted
///           (-ffp-contract=off) or reordered. Comparisons with NaN are false.
///   Memory  loads and stores need no alignment.
///   Limits  8 lanes. AVX2 (one register of eight) was measured: it would save 1.4 of the 4 ns for culling a box, out
///           of about 30 ns per box and frame. That is not worth a second code path (bench/filament_core/prepare).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace filament_core::simd {

inline constexpr size_t kLanes = 8;

using Float4 [[gnu::vector_size(16)]] = float;
using Float2 [[gnu::vector_size(8)]] = float;
using Double2 [[gnu::vector_size(16)]] = double;
using Mask4 [[gnu::vector_size(16)]] = int32_t;

struct Float8 {
    Float4 low, high;

    friend Float8 operator+(Float8 const& a, Float8 const& b) { return { a.low + b.low, a.high + b.high }; }
    friend Float8 operator+(Float8 const& a, float b) { return { a.low + b, a.high + b }; }
    friend Float8 operator*(Float8 const& a, Float8 const& b) { return { a.low * b.low, a.high * b.high }; }
    friend Float8 operator/(Float8 const& a, Float8 const& b) { return { a.low / b.low, a.high / b.high }; }
    friend Float8 operator*(Float8 const& a, float b) { return { a.low * b, a.high * b }; }
    friend Float8 operator-(Float8 const& a) { return { -a.low, -a.high }; }
};

/// A lane has either all bits set or none.
struct Mask8 {
    Mask4 low, high;

    friend Mask8 operator|(Mask8 const& a, Mask8 const& b) { return { a.low | b.low, a.high | b.high }; }
};

inline Mask8 operator<(Float8 const& a, Float8 const& b) { return { a.low < b.low, a.high < b.high }; }

template <class V, class T>
void load(V& lanes, const T* from) {
    std::memcpy(&lanes, from, sizeof(V));
}

inline Float8 load8(const float* from) {
    Float8 lanes;
    load(lanes.low, from);
    load(lanes.high, from + 4);
    return lanes;
}

/// float(from[lane] - origin): subtracted in double precision, then rounded once.
inline Float4 loadRelative4(const double* from, double origin) {
    Double2 low, high;
    load(low, from);
    load(high, from + 2);
    const Float2 a = __builtin_convertvector(low - origin, Float2), b = __builtin_convertvector(high - origin, Float2);
    return Float4{ a[0], a[1], b[0], b[1] };
}

inline Float8 loadRelative8(const double* from, double origin) {
    return { loadRelative4(from, origin), loadRelative4(from + 4, origin) };
}

inline void store8(std::array<float, kLanes>& to, Float8 const& lanes) {
    std::memcpy(to.data(), &lanes.low, sizeof lanes.low);
    std::memcpy(to.data() + 4, &lanes.high, sizeof lanes.high);
}

/// x * x + y * y + z * z in this order, like glm::dot of each lane.
template <class Vector3>
Float8 dot(Vector3 const& a, std::array<Float8, 3> const& b) {
    return b[0] * a.x + b[1] * a.y + b[2] * a.z;
}

/// Bit i: lane i of a mask.
inline uint32_t bits4(Mask4 const& mask) {
#if defined(__SSE2__)
    __m128 lanes;
    std::memcpy(&lanes, &mask, sizeof lanes);
    return static_cast<uint32_t>(_mm_movemask_ps(lanes));
#else
    const Mask4 bits = mask & Mask4{ 1, 2, 4, 8 };
    return static_cast<uint32_t>(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
}

inline uint32_t bits8(Mask8 const& mask) { return bits4(mask.low) | bits4(mask.high) << 4; }

/// Bit i of the result is bit `bit` of byte i. The multiplication gathers the lowest bits of eight bytes in the top
/// byte.
inline uint32_t bitOfEachByte(uint64_t bytes, uint32_t bit) {
    return static_cast<uint32_t>((((bytes >> bit) & 0x0101'0101'0101'0101ull) * 0x0102'0408'1020'4080ull) >> 56);
}

} // namespace filament_core::simd
