// SPDX-License-Identifier: Apache-2.0
/// HandleTable: the objects of one type behind their handles. Addresses are stable.
///   Thread  the app thread.
///   Fails   add(): std::bad_alloc, and the table is unchanged. A handle that was destroyed or never created is an
///           assertion that names the type.
#pragma once

#include "base/Handle.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace filament::engine {

template <class Tag, class State>
class HandleTable {
public:
    template <class... Args>
    Handle<Tag> add(Args&&... args) {
        auto state = std::make_unique<State>(std::forward<Args>(args)...);
        reserveOne();
        const Handle<Tag> handle = mHandles.allocate(); // nothing below can fail
        if (handle.index() >= mStates.size()) mStates.resize(handle.index() + 1);
        mGiven.resize(mStates.size());
        mGiven[handle.index()] = handle;
        mStates[handle.index()] = std::move(state);
        return handle;
    }

    State& get(Handle<Tag> handle) {
        FILAMENT_ASSERT(mHandles.isLive(handle), "a handle is used only between create() and destroy()");
        return *mStates[handle.index()];
    }
    State const& get(Handle<Tag> handle) const { return const_cast<HandleTable*>(this)->get(handle); }

    void remove(Handle<Tag> handle) {
        get(handle);
        mStates[handle.index()].reset();
        mHandles.free(handle);
    }

    /// visit(state) for every live object, in order of index.
    template <class F>
    void forEach(F&& visit) const {
        for (auto const& state : mStates) {
            if (state) visit(*state);
        }
    }

    /// visit(handle, state) for every live object, in order of index.
    template <class F>
    void forEachHandle(F&& visit) {
        for (size_t i = 0; i < mStates.size(); ++i) {
            if (mStates[i]) visit(mGiven[i], *mStates[i]);
        }
    }

private:
    void reserveOne() {
        if (mStates.size() < mStates.capacity() && mStates.size() < mGiven.capacity()) return;
        const size_t capacity = std::max<size_t>(16, 2 * mStates.size());
        mStates.reserve(capacity);
        mGiven.reserve(capacity);
    }

    HandleAllocator<Tag> mHandles;
    std::vector<std::unique_ptr<State>> mStates;
    std::vector<Handle<Tag>> mGiven; // parallel to mStates: the last handle allocated
};

/// An incomplete object: removed from its table at the end of the scope unless it is kept.
template <class Tag, class State>
class Draft {
public:
    explicit Draft(HandleTable<Tag, State>& table) : mTable(table), mHandle(table.add()) {}
    ~Draft() {
        if (mHandle) mTable.remove(mHandle);
    }
    Draft(Draft const&) = delete;
    Draft& operator=(Draft const&) = delete;

    State& state() { return mTable.get(mHandle); }
    Handle<Tag> handle() const { return mHandle; }
    Handle<Tag> keep() { return std::exchange(mHandle, {}); }

private:
    HandleTable<Tag, State>& mTable;
    Handle<Tag> mHandle;
};

} // namespace filament::engine
