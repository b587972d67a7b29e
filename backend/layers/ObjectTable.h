// SPDX-License-Identifier: Apache-2.0
/// ObjectTable: the live objects of one type and their descriptions; the changes of one stream can be undone.
///   Thread  one.
///   Memory  live objects, plus those destroyed since the last commit().
///   Cost    one hash look-up per call.
#pragma once

#include "base/Handle.h"

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace filament_core::backend {

template <class Tag, class Object>
class ObjectTable {
public:
    Object const* find(Handle<Tag> handle) const {
        const auto it = mLive.find(handle);
        return it == mLive.end() ? nullptr : &it->second;
    }

    /// Whether an object is alive at this index, with any generation.
    bool occupied(Handle<Tag> handle) const {
        const auto it = mGenerations.find(handle.index());
        return it != mGenerations.end() && it->second != 0;
    }

    /// Whether a handle was created and destroyed, as opposed to never created.
    bool wasDestroyed(Handle<Tag> handle) const {
        const auto it = mLastDead.find(handle.index());
        return it != mLastDead.end() && it->second == handle;
    }

    /// The index must be free.
    void create(Handle<Tag> handle, Object object) {
        mLive.emplace(handle, std::move(object));
        mGenerations[handle.index()] = handle.generation();
        mChanges.push_back({ handle, std::nullopt });
    }

    /// The object must be alive.
    void destroy(Handle<Tag> handle) {
        const auto it = mLive.find(handle);
        mChanges.push_back({ handle, std::move(it->second) });
        mLive.erase(it);
        mGenerations[handle.index()] = 0;
        mLastDead[handle.index()] = handle;
    }

    void commit() { mChanges.clear(); }

    /// Undoes everything since the last commit().
    void rollback() {
        for (auto it = mChanges.rbegin(); it != mChanges.rend(); ++it) {
            if (it->destroyed) {
                mLive.emplace(it->handle, std::move(*it->destroyed));
                mGenerations[it->handle.index()] = it->handle.generation();
                mLastDead.erase(it->handle.index());
            } else {
                mLive.erase(it->handle);
                mGenerations[it->handle.index()] = 0;
            }
        }
        mChanges.clear();
    }

private:
    struct Change {
        Handle<Tag> handle;
        std::optional<Object> destroyed; ///< nothing: it was created
    };
    std::unordered_map<Handle<Tag>, Object> mLive;
    std::unordered_map<uint32_t, uint32_t> mGenerations; // index -> live generation, 0: none
    std::unordered_map<uint32_t, Handle<Tag>> mLastDead; // index -> last destroyed object
    std::vector<Change> mChanges;
};

} // namespace filament_core::backend
