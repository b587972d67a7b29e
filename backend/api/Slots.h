// SPDX-License-Identifier: Apache-2.0
/// Slots: a driver's objects, by handles of one type.
///   A handle finds its object only if index and generation agree; otherwise it finds nothing.
///   Thread  the driver thread.
///   Memory  one heap block per object, so addresses are stable; 16 bytes per slot, as many slots as handles were ever
///           alive at once.
///   Cost    one index and one comparison per look-up.
#pragma once

#include "base/Handle.h"

#include <memory>
#include <utility>
#include <vector>

namespace filament_core::backend {

template <class H, class T>
class Slots {
public:
    T* find(H handle) const {
        if (!handle || handle.index() >= mSlots.size()) return nullptr;
        Slot const& slot = mSlots[handle.index()];
        return slot.handle == handle ? slot.object.get() : nullptr;
    }

    /// A null object (its creation failed) cannot be found.
    void put(H handle, std::unique_ptr<T> object) {
        if (handle.index() >= mSlots.size()) mSlots.resize(handle.index() + size_t{ 1 });
        mSlots[handle.index()] = { handle, std::move(object) };
    }

    std::unique_ptr<T> take(H handle) {
        if (!find(handle)) return nullptr;
        return std::exchange(mSlots[handle.index()], {}).object;
    }

    void clear() { mSlots.clear(); }

    template <class F>
    void forEach(F&& visit) {
        for (Slot& slot : mSlots) {
            if (slot.object) visit(*slot.object);
        }
    }

private:
    struct Slot {
        H handle{};
        std::unique_ptr<T> object;
    };
    std::vector<Slot> mSlots;
};

} // namespace filament_core::backend
