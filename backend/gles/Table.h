// SPDX-License-Identifier: Apache-2.0
/// Table: what a handle names, indexed by the handle's index; the generation tells a stale handle from a live one.
///   Thread  the driver thread.
///   Memory  one heap object per resource, so that pointers stay valid while others come and go.
#pragma once

#include "base/Handle.h"

#include <memory>
#include <utility>
#include <vector>

namespace filament::backend::gles {

template <class Tag, class T>
class Table {
public:
    T& insert(Handle<Tag> handle, T value) {
        FILAMENT_ASSERT(handle, "a resource is created under a handle");
        if (handle.index() >= mSlots.size()) mSlots.resize(handle.index() + 1);
        Slot& slot = mSlots[handle.index()];
        slot = { handle, std::make_unique<T>(std::move(value)) };
        return *slot.value;
    }

    /// Null for none and for a handle whose resource is gone.
    T* find(Handle<Tag> handle) const {
        if (handle.index() >= mSlots.size()) return nullptr;
        Slot const& slot = mSlots[handle.index()];
        return slot.handle == handle ? slot.value.get() : nullptr;
    }

    /// The resource, taken out; null as for find().
    std::unique_ptr<T> remove(Handle<Tag> handle) {
        if (!find(handle)) return nullptr;
        Slot& slot = mSlots[handle.index()];
        slot.handle = {};
        return std::move(slot.value);
    }

    void clear() { mSlots.clear(); }

    template <class F>
    void forEach(F&& function) {
        for (Slot& slot : mSlots) {
            if (slot.value) function(*slot.value);
        }
    }

private:
    struct Slot {
        Handle<Tag> handle;
        std::unique_ptr<T> value;
    };
    std::vector<Slot> mSlots;
};

} // namespace filament::backend::gles
