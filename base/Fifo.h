// SPDX-License-Identifier: Apache-2.0
/// Fifo: a queue that keeps its memory. std::deque frees and allocates blocks as it moves along.
///   Memory  one array, doubled when full; a queue that is emptied as fast as it fills allocates nothing.
///   Limits  T is default-constructible and movable; popped elements are replaced by T().
///   Thread  one at a time.
#pragma once

#include "base/Assert.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace filament_core {

template <class T>
class Fifo {
public:
    bool empty() const { return mSize == 0; }
    size_t size() const { return mSize; }

    T& front() { return (*this)[0]; }
    T& back() { return (*this)[mSize - 1]; }
    /// 0 is the oldest.
    T& operator[](size_t index) {
        FILAMENT_DEBUG_ASSERT(index < mSize, "an element of the queue");
        return mItems[(mFirst + index) % mItems.size()];
    }

    void push_back(T item) {
        if (mSize == mItems.size()) grow();
        mItems[(mFirst + mSize) % mItems.size()] = std::move(item);
        ++mSize;
    }

    void pop_front() {
        front() = T();
        mFirst = (mFirst + 1) % mItems.size();
        --mSize;
    }

private:
    void grow() {
        std::vector<T> larger(mItems.empty() ? 8 : mItems.size() * 2);
        for (size_t i = 0; i < mSize; ++i) larger[i] = std::move((*this)[i]);
        mItems = std::move(larger);
        mFirst = 0;
    }

    std::vector<T> mItems;
    size_t mFirst = 0, mSize = 0;
};

} // namespace filament_core
