// SPDX-License-Identifier: Apache-2.0
/// MaterialNumbers: the ids of materials, which sort keys and caches have 20 bits for.
///   Order   ascending, as materials are created, because draws of equal depth are sorted by them: objects destroyed
///           before must not change an image. A number is used again only once all have been used.
///   Thread  one at a time.   Memory: a bit for each number up to the largest.
///   Fails   take(): std::bad_alloc; OutOfHandles if 2^20 materials live.
#pragma once

#include "base/Handle.h"

#include <cstdint>
#include <vector>

namespace filament_core::engine {

class MaterialNumbers {
public:
    static constexpr uint32_t kCount = 1u << 20;

    uint32_t take() {
        if (mLive == kCount) throw OutOfHandles();
        while (mNext < mIsTaken.size() && mIsTaken[mNext]) mNext = (mNext + 1) % kCount;
        if (mNext == mIsTaken.size()) mIsTaken.push_back(false);
        mIsTaken[mNext] = true;
        ++mLive;
        const uint32_t number = mNext;
        mNext = (mNext + 1) % kCount;
        return number;
    }
    void giveBack(uint32_t number) {
        FILAMENT_ASSERT(number < mIsTaken.size() && mIsTaken[number], "a number is given back once");
        mIsTaken[number] = false;
        --mLive;
    }

private:
    std::vector<bool> mIsTaken;
    uint32_t mNext = 0, mLive = 0;
};

} // namespace filament_core::engine
