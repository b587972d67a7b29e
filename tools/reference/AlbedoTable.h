// SPDX-License-Identifier: Apache-2.0
/// AlbedoTable: a smooth function of cosine and roughness, computed once on a grid and interpolated cubically.
///   Grid    rows are uniform in the logarithm of roughness, columns in the cube root of the cosine: most of the table
///           covers smooth surfaces at grazing angles, where albedos change fastest.
///   In      cosine in [0, 1], perceptualRoughness in [0.045, 1].
///   Thread  read-only after construction. Memory: sizeof(Value) per node.
#pragma once

#include "base/math/Math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace filament_core::reference {

template <class Value>
class AlbedoTable {
public:
    /// `valueAt(cosine, perceptualRoughness)` computes the nodes.
    template <class F>
    AlbedoTable(int cosines, int roughnesses, F const& valueAt)
            : mCosines(cosines), mRoughnesses(roughnesses), mEntries(static_cast<size_t>(cosines * roughnesses)) {
        for (int row = 0; row < roughnesses; ++row) {
            const double share = static_cast<double>(row) / (roughnesses - 1);
            const double roughness = std::exp(kLeastLog * (1 - share));
            for (int column = 0; column < cosines; ++column) {
                const double root = (column + 1.0) / cosines;
                mEntries[static_cast<size_t>(row * cosines + column)] = valueAt(root * root * root, roughness);
            }
        }
    }

    Value lookUp(double cosine, double perceptualRoughness) const {
        const double x = std::cbrt(std::clamp(cosine, 1e-4, 1.0)) * mCosines - 1;
        const double y = (1 - std::log(perceptualRoughness) / kLeastLog) * (mRoughnesses - 1);
        const auto wx = weights(x), wy = weights(y);
        const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
        Value sum(0.0);
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i < 4; ++i) {
                sum += at(x0 + i - 1, y0 + j - 1) * (wx[static_cast<size_t>(i)] * wy[static_cast<size_t>(j)]);
            }
        }
        return sum;
    }

    /// Mean over the hemisphere, weighted by twice the cosine: the value for a uniform sky.
    Value average(double perceptualRoughness) const {
        constexpr int kSteps = 64;
        Value sum(0.0);
        for (int i = 0; i < kSteps; ++i)
            sum += lookUp(std::sqrt((i + 0.5) / kSteps), perceptualRoughness) * (1.0 / kSteps);
        return sum;
    }

private:
    inline static const double kLeastLog = std::log(0.045); // kMinPerceptualRoughness

    // Catmull and Rom 1974: interpolates the entries, with a continuous slope.
    static std::array<double, 4> weights(double x) {
        const double t = x - std::floor(x);
        return { ((2 - t) * t - 1) * t / 2, ((3 * t - 5) * t * t + 2) / 2, ((4 - 3 * t) * t + 1) * t / 2,
                 (t - 1) * t * t / 2 };
    }

    // Beyond the border, the table continues for one entry as the parabola through its last three entries.
    Value at(int x, int y) const {
        const int column = std::clamp(x, 0, mCosines - 1), row = std::clamp(y, 0, mRoughnesses - 1);
        const int dx = column - x, dy = row - y;
        if (dx != 0) return 3.0 * (at(column, y) - at(column + dx, y)) + at(column + 2 * dx, y);
        if (dy != 0) return 3.0 * (at(x, row) - at(x, row + dy)) + at(x, row + 2 * dy);
        return mEntries[static_cast<size_t>(row * mCosines + column)];
    }

    int mCosines, mRoughnesses;
    std::vector<Value> mEntries;
};

} // namespace filament_core::reference
