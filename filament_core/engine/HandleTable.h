// SPDX-License-Identifier: Apache-2.0
/// HandleTable: the objects of one type behind their handles, each with a `name`. Addresses are stable.
///   Thread  the app thread.
///   Life    retire() ends a handle; what it named lives on until releaseRetired() finds that nothing uses it.
///   Fails   add(): std::bad_alloc, and the table is unchanged. A handle that is null, of another engine, or of
///           something that was destroyed ends the process (ObjectHandles::refuse()).
#pragma once

#include "filament_core/scene/ObjectHandles.h"

#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::engine {

template <class Tag, class State>
class HandleTable {
public:
    explicit HandleTable(uint16_t owner) : mHandles(owner) {}

    template <class... Args>
    ObjectHandle<Tag> add(Args&&... args) {
        auto state = std::make_unique<State>(std::forward<Args>(args)...);
        reserveOne();
        const ObjectHandle<Tag> handle = mHandles.allocate(); // nothing below can fail
        if (handle.index() >= mSlots.size()) mSlots.resize(handle.index() + 1);
        mSlots[handle.index()] = { handle, std::move(state), {} };
        ++mLive;
        return handle;
    }

    State& get(ObjectHandle<Tag> handle) {
        if (!mHandles.isLive(handle)) refuse(handle);
        return *mSlots[handle.index()].state;
    }
    State const& get(ObjectHandle<Tag> handle) const { return const_cast<HandleTable*>(this)->get(handle); }

    bool isLive(ObjectHandle<Tag> handle) const { return mHandles.isLive(handle); }

    /// Live or retired, for those that use it and keep it.
    State& held(ObjectHandle<Tag> handle) {
        if (mHandles.isLive(handle)) return *mSlots[handle.index()].state;
        const auto found = std::ranges::find(mRetired, handle, &Slot::handle);
        if (found == mRetired.end()) refuse(handle);
        return *found->state;
    }

    void remove(ObjectHandle<Tag> handle) { end(handle); }

    /// Never fails: add() reserved the memory.
    void retire(ObjectHandle<Tag> handle) { mRetired.push_back(end(handle)); }
    bool hasRetired() const { return !mRetired.empty(); }

    /// Destroys retired objects that are unused, after release(handle, state).
    template <class IsUsed, class Release>
    void releaseRetired(IsUsed&& isUsed, Release&& release) {
        std::erase_if(mRetired, [&](Slot& slot) {
            if (isUsed(std::as_const(*slot.state))) return false;
            release(slot.handle, *slot.state);
            return true;
        });
    }

    /// visit(state) for every live object, in order of index.
    template <class F>
    void forEach(F&& visit) const {
        for (Slot const& slot : mSlots) {
            if (slot.state) visit(*slot.state);
        }
    }

    /// visit(handle, state) for every object, live ones in order of index, then those retired.
    template <class F>
    void forEachHeld(F&& visit) {
        for (std::vector<Slot>* slots : { &mSlots, &mRetired }) {
            for (Slot& slot : *slots) {
                if (slot.state) visit(slot.handle, *slot.state);
            }
        }
    }

private:
    struct Slot {
        ObjectHandle<Tag> handle{}; ///< the last one of this index
        std::unique_ptr<State> state;
        std::string lastName; ///< of the former object, for messages
    };

    Slot end(ObjectHandle<Tag> handle) {
        get(handle);
        Slot& slot = mSlots[handle.index()];
        keepName(slot);
        mHandles.free(handle);
        --mLive;
        return { handle, std::move(slot.state), {} };
    }

    static void keepName(Slot& slot) {
        try {
            slot.lastName = slot.state->name;
        } catch (std::bad_alloc const&) { // messages do without it
            slot.lastName.clear();
        }
    }

    [[noreturn]] void refuse(ObjectHandle<Tag> handle) const {
        const bool isLastOfIndex = handle.index() < mSlots.size() && mSlots[handle.index()].handle == handle;
        mHandles.refuse(handle, isLastOfIndex ? std::string_view(mSlots[handle.index()].lastName) : std::string_view());
    }

    /// For one object more, and for all of them to be retired.
    void reserveOne() {
        reserve(mSlots, mSlots.size() + 1);
        reserve(mRetired, mRetired.size() + mLive + 1);
    }
    static void reserve(std::vector<Slot>& slots, size_t count) {
        if (slots.capacity() < count) slots.reserve(std::max<size_t>({ 16, count, 2 * slots.capacity() }));
    }

    scene::ObjectHandles<Tag> mHandles;
    std::vector<Slot> mSlots, mRetired; // by handle index; in the order of their ends
    size_t mLive = 0;
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
    ObjectHandle<Tag> handle() const { return mHandle; }
    ObjectHandle<Tag> keep() { return std::exchange(mHandle, {}); }

private:
    HandleTable<Tag, State>& mTable;
    ObjectHandle<Tag> mHandle;
};

} // namespace filament_core::engine
