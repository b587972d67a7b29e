// SPDX-License-Identifier: Apache-2.0
/// Handle: a small typed name for something that lives in a table. Zero is none.
///   Bits    20 bits of index, 12 bits of generation; the generation tells a stale handle from a live one.
///   Thread  a plain value.
/// HandleAllocator: gives handles out and takes them back; 64 live allocators cost nothing but their table.
///   Thread  any; one short lock per call. Never waits for a driver or a device.
///   Limits  2^20 live handles; beyond it allocate() asserts, naming the type's limit.
#pragma once

#include "filament_core/base/Assert.h"

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace filament {

template <class Tag>
struct Handle {
    static constexpr uint32_t kIndexBits = 20;
    static constexpr uint32_t kIndexMask = (1u << kIndexBits) - 1;
    static constexpr uint32_t kMaxGeneration = (1u << (32 - kIndexBits)) - 1;

    uint32_t bits = 0;

    static Handle make(uint32_t index, uint32_t generation) { return { (generation << kIndexBits) | index }; }
    uint32_t index() const { return bits & kIndexMask; }
    uint32_t generation() const { return bits >> kIndexBits; }
    explicit operator bool() const { return bits != 0; }
    friend bool operator==(Handle, Handle) = default;
    friend auto operator<=>(Handle, Handle) = default;
};

template <class Tag>
class HandleAllocator {
public:
    Handle<Tag> allocate() {
        const std::lock_guard lock(mMutex);
        if (mFree.empty()) {
            FILAMENT_ASSERT(mGenerations.size() <= Handle<Tag>::kIndexMask, "at most 2^20 handles of one type");
            mGenerations.push_back(1);
            return Handle<Tag>::make(static_cast<uint32_t>(mGenerations.size() - 1), 1);
        }
        const uint32_t index = mFree.back();
        mFree.pop_back();
        return Handle<Tag>::make(index, mGenerations[index]);
    }

    /// Takes a handle back; its index is given out again under another generation.
    void free(Handle<Tag> handle) {
        const std::lock_guard lock(mMutex);
        FILAMENT_ASSERT(isLiveLocked(handle), "a handle is freed once, and only by whoever allocated it");
        uint32_t& generation = mGenerations[handle.index()];
        generation = generation == Handle<Tag>::kMaxGeneration ? 1 : generation + 1;
        mFree.push_back(handle.index());
    }

    bool isLive(Handle<Tag> handle) const {
        const std::lock_guard lock(mMutex);
        return isLiveLocked(handle);
    }

    uint32_t liveCount() const {
        const std::lock_guard lock(mMutex);
        return static_cast<uint32_t>(mGenerations.size() - mFree.size());
    }

private:
    bool isLiveLocked(Handle<Tag> handle) const {
        return handle && handle.index() < mGenerations.size() &&
                mGenerations[handle.index()] == handle.generation();
    }

    mutable std::mutex mMutex;
    std::vector<uint32_t> mGenerations; // of the handle given out last, or of the next one
    std::vector<uint32_t> mFree;
};

} // namespace filament

template <class Tag>
struct std::hash<filament::Handle<Tag>> {
    size_t operator()(filament::Handle<Tag> handle) const noexcept { return std::hash<uint32_t>{}(handle.bits); }
};
