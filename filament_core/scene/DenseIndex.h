// SPDX-License-Identifier: Apache-2.0
/// DenseIndex: handles for the user, dense arrays for the frame.
///   Thread  the app thread between frames; at() on any number of threads while nothing is added or removed.
///   Memory  8 bytes an element; adding and removing is O(1), removal moves the last element into the gap.
///   Fails   a handle that names nothing (any more) ends the process: ObjectHandles::refuse().
#pragma once

#include "filament_core/scene/ObjectHandles.h"

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace filament_core::scene {

/// Grows by a quarter: a scene has many columns, and half of each in reserve would be more than most need.
template <class T>
void append(std::vector<T>& column, std::type_identity_t<T> const& value) {
    if (column.size() == column.capacity()) column.reserve(column.size() + column.size() / 4 + 16);
    column.push_back(value);
}

/// Moves the last element of a column into the gap and drops the last.
template <class T>
void closeGap(std::vector<T>& column, uint32_t gap) {
    if (gap + 1 != column.size()) column[gap] = std::move(column.back());
    column.pop_back();
}

/// Maps handles to positions in dense arrays and back.
template <class Tag>
class DenseIndex {
public:
    explicit DenseIndex(uint16_t owner = 0) : mHandles(owner) {}

    ObjectHandle<Tag> add() {
        const ObjectHandle<Tag> handle = mHandles.allocate();
        while (handle.index() >= mDense.size()) append(mDense, 0u);
        mDense[handle.index()] = static_cast<uint32_t>(mOwners.size());
        append(mOwners, handle);
        return handle;
    }

    /// The position that the last element must be moved into; the caller then drops the last element.
    uint32_t remove(ObjectHandle<Tag> handle) {
        const uint32_t gap = at(handle);
        const ObjectHandle<Tag> last = mOwners.back();
        mOwners[gap] = last;
        mDense[last.index()] = gap;
        mOwners.pop_back();
        mHandles.free(handle);
        return gap;
    }

    uint32_t at(ObjectHandle<Tag> handle) const {
        const uint32_t position = handle && handle.index() < mDense.size() ? mDense[handle.index()] : size();
        if (position >= size() || mOwners[position] != handle) mHandles.refuse(handle);
        return position;
    }

    /// The handle of the element at `position`.
    ObjectHandle<Tag> handleAt(uint32_t position) const { return mOwners[position]; }

    bool contains(ObjectHandle<Tag> handle) const {
        if (!handle || handle.index() >= mDense.size()) return false;
        const uint32_t position = mDense[handle.index()];
        return position < size() && mOwners[position] == handle;
    }

    uint32_t size() const { return static_cast<uint32_t>(mOwners.size()); }

private:
    ObjectHandles<Tag> mHandles;
    std::vector<uint32_t> mDense;           // by handle index
    std::vector<ObjectHandle<Tag>> mOwners; // by dense position
};

} // namespace filament_core::scene
