// SPDX-License-Identifier: Apache-2.0
/// WorkStealingDeque: one thread pushes and takes at the bottom, every other thread steals from the top.
///   Source  Chase and Lev 2005, "Dynamic circular work-stealing deque"; the orderings follow Le, Pop, Cohen and Zappa
///           Nardelli 2013, "Correct and efficient work-stealing for weak memory models", with sequentially consistent
///           accesses in place of their fences: thread sanitizers understand those, and push() needs one anyway.
///   Thread  push(), take(): the owner. steal(), isEmpty(): any.
///   Memory  8 bytes a slot, never grows: a full deque refuses, and its owner runs the job itself. So no buffer is
///           ever replaced under a thief's hands, and a recursion that forks without end stays in bounded memory.
///   Order   push() is one point in the single total order of seq_cst operations. A thread that pushes and then asks
///           "does anybody sleep?" and a thread that announces its sleep and then looks in here cannot both miss.
///   Proof   tests/jobsystem/DequeModelTest.cpp goes through all interleavings of a few operations.
#pragma once

#include "jobsystem/Atomics.h"
#include "jobsystem/Job.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace filament::jobs {

template <class T, uint32_t kSlots, class Policy = StdAtomics>
class WorkStealingDeque {
    static_assert((kSlots & (kSlots - 1)) == 0, "slots are addressed with a mask");

public:
    /// False if the deque is full.
    bool push(T* item) {
        const int64_t bottom = mBottom.load(std::memory_order_relaxed);
        if (bottom - mTop.load(std::memory_order_acquire) >= kSlots) return false;
        slot(bottom).store(item, std::memory_order_relaxed);
        mBottom.exchange(bottom + 1, std::memory_order_seq_cst); // publishes the item; see Order
        return true;
    }

    /// The item pushed last, or null.
    T* take() {
        const int64_t bottom = mBottom.load(std::memory_order_relaxed) - 1;
        int64_t top = mTop.load(std::memory_order_relaxed);
        if (top > bottom) return nullptr;                    // top never passes bottom: surely empty
        if (top == bottom) return claim(top);                // the last item: as one of the thieves
        mBottom.exchange(bottom, std::memory_order_seq_cst); // reserves the item before looking who else does
        top = mTop.load(std::memory_order_seq_cst);
        if (top < bottom) return slot(bottom).load(std::memory_order_relaxed);
        mBottom.store(bottom + 1, std::memory_order_release); // thieves took all others meanwhile
        return top == bottom ? claim(top) : nullptr;
    }

    /// The oldest item, or null. Null means empty: a race lost to another thief is retried.
    T* steal() {
        int64_t top = mTop.load(std::memory_order_seq_cst);
        while (top < mBottom.load(std::memory_order_seq_cst)) {
            T* item = slot(top).load(std::memory_order_relaxed);
            if (mTop.compare_exchange_strong(top, top + 1, std::memory_order_seq_cst)) return item;
        }
        return nullptr;
    }

    /// The places of the items that are in here: [oldest, end). A place is used again only after a take().
    struct Extent {
        int64_t oldest, end;
        bool isEmpty() const { return oldest >= end; }
    };
    Extent extent() const {
        const int64_t top = mTop.load(std::memory_order_seq_cst);
        return { top, mBottom.load(std::memory_order_seq_cst) };
    }

    bool isEmpty() const { return extent().isEmpty(); }

private:
    template <class V>
    using Atomic = typename Policy::template Atomic<V>;

    // Whoever moves top owns the item.
    T* claim(int64_t top) {
        T* item = slot(top).load(std::memory_order_relaxed);
        return mTop.compare_exchange_strong(top, top + 1, std::memory_order_seq_cst) ? item : nullptr;
    }

    Atomic<T*>& slot(int64_t at) { return mSlots[static_cast<uint64_t>(at) & (kSlots - 1)]; }

    // In one cache line: both sides read both, so apart they would cost a look and a theft a second transfer.
    alignas(kCacheLineBytes) Atomic<int64_t> mTop{ 0 }; // moved by thieves, and by the owner for the last item
    Atomic<int64_t> mBottom{ 0 };                       // moved by the owner
    alignas(kCacheLineBytes) std::array<Atomic<T*>, kSlots> mSlots{};
};

} // namespace filament::jobs
