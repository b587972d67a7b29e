// SPDX-License-Identifier: Apache-2.0
/// BoundsColumns: axis-aligned boxes in world space, by component, so that SIMD can load neighbours. Centres are
/// double; after subtracting the camera the result fits a float.
///   Memory  36 B a box. Four neighbours lie together, in three cache lines of one page: a view that tests a few of a
///           million boxes waits for these lines, not for those of six arrays.
#pragma once

#include "base/math/Math.h"
#include "filament_core/scene/DenseIndex.h"

#include <filament_core/Box.h>

#include <array>
#include <vector>

namespace filament_core::scene {

class BoundsColumns {
public:
    static constexpr size_t kLanes = 4;
    struct alignas(16) Four {
        std::array<std::array<double, kLanes>, 3> center{};
        std::array<std::array<float, kLanes>, 3> halfExtent{};
    };
    static_assert(sizeof(Four) == 144);

    double3 centerAt(size_t i) const {
        auto const& center = mFours[i / kLanes].center;
        return { center[0][i % kLanes], center[1][i % kLanes], center[2][i % kLanes] };
    }
    float3 halfExtentAt(size_t i) const {
        auto const& half = mFours[i / kLanes].halfExtent;
        return { half[0][i % kLanes], half[1][i % kLanes], half[2][i % kLanes] };
    }
    Box at(size_t i) const {
        return { centerAt(i) - double3(halfExtentAt(i)), centerAt(i) + double3(halfExtentAt(i)) };
    }
    /// Boxes 4 i to 4 i + 3. There is an even number of fours.
    Four const& four(size_t i) const { return mFours[i]; }
    size_t size() const { return mSize; }

    void set(size_t i, double3 const& center, float3 halfExtent) {
        Four& four = mFours[i / kLanes];
        for (int axis = 0; axis < 3; ++axis) {
            four.center[static_cast<size_t>(axis)][i % kLanes] = center[axis];
            four.halfExtent[static_cast<size_t>(axis)][i % kLanes] = halfExtent[axis];
        }
    }
    /// At the end, at the origin.
    void add() {
        while (mFours.size() < foursOf(mSize + 1)) append(mFours, {});
        set(mSize++, double3(0.0), float3(0.0f));
    }
    /// The last box takes the place of `gap`.
    void remove(size_t gap) {
        const size_t last = mSize - 1;
        set(gap, centerAt(last), halfExtentAt(last));
        --mSize;
        while (mFours.size() > foursOf(mSize)) mFours.pop_back();
    }
    void resize(size_t size) {
        mFours.resize(foursOf(size));
        mSize = size;
    }

private:
    static size_t foursOf(size_t size) { return (size + 2 * kLanes - 1) / (2 * kLanes) * 2; }

    std::vector<Four> mFours;
    size_t mSize = 0;
};

} // namespace filament_core::scene
