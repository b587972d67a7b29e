// SPDX-License-Identifier: Apache-2.0
/// HandleAllocator: allocates and frees handles, of devices or of apps. It knows no owners: who gives out handles of
/// apps adds its own, and looks at it.
///   Thread  any; one short lock per call. Never waits for a driver or a device.
///   Limits  2^20 live handles: files, too, decide how many there are, so that more of them is an error.
///   Fails   allocate() throws std::bad_alloc, or OutOfHandles, and changes nothing; free() never fails.
#pragma once

#include "base/Assert.h"

#include <filament_core/Handle.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <new>
#include <vector>

namespace filament_core {

/// As many objects of one type as can have handles. Code that handles missing memory handles this; OutOfMemory.h tells
/// them apart.
class OutOfHandles : public std::bad_alloc {
public:
    const char* what() const noexcept override { return "2^20 objects of one type"; }
};

/// `H`: Handle or ObjectHandle.
template <class Tag, template <class> class H = Handle>
class HandleAllocator {
public:
    H<Tag> allocate() {
        const std::lock_guard lock(mMutex);
        if (mFree.empty()) {
            if (mGenerations.size() > H<Tag>::kIndexMask) throw OutOfHandles();
            reserveFree(mGenerations.size() + 1);
            mGenerations.push_back(1);
            return H<Tag>::make(static_cast<uint32_t>(mGenerations.size() - 1), 1);
        }
        const uint32_t index = mFree.back();
        mFree.pop_back();
        return H<Tag>::make(index, mGenerations[index]);
    }

    /// Frees a handle; its index is reused with another generation.
    void free(H<Tag> handle) {
        const std::lock_guard lock(mMutex);
        FILAMENT_ASSERT(isLiveLocked(handle), "a handle is freed once, and only by whoever allocated it");
        uint32_t& generation = mGenerations[handle.index()];
        generation = generation == H<Tag>::kMaxGeneration ? 1 : generation + 1;
        mFree.push_back(handle.index());
    }

    bool isLive(H<Tag> handle) const {
        const std::lock_guard lock(mMutex);
        return isLiveLocked(handle);
    }

    uint32_t liveCount() const {
        const std::lock_guard lock(mMutex);
        return static_cast<uint32_t>(mGenerations.size() - mFree.size());
    }

private:
    bool isLiveLocked(H<Tag> handle) const {
        return handle && handle.index() < mGenerations.size() && mGenerations[handle.index()] == handle.generation();
    }

    // Reserves room for every handle to be freed.
    void reserveFree(size_t count) {
        if (mFree.capacity() < count) mFree.reserve(std::max(count, 2 * mFree.capacity()));
    }

    mutable std::mutex mMutex;
    std::vector<uint32_t> mGenerations; // of the handle allocated last, or of the next one
    std::vector<uint32_t> mFree;
};

} // namespace filament_core
