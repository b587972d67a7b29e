// SPDX-License-Identifier: Apache-2.0
/// WorkStealingDeque: one thread pushes and takes at the bottom, every other thread steals from the top.
///   Source  Chase and Lev 2005, "Dynamic circular work-stealing deque"; the orderings follow Le, Pop, Cohen and Zappa
///           Nardelli 2013, "Correct and efficient work-stealing for weak memory models", with sequentially consistent
///           accesses instead of their fences: thread sanitizers understand those, and push() needs one anyway.
///   Thread  push(), take(): the owner. steal(), isEmpty(): any.
///   Memory  8 bytes per slot. It never grows: if the deque is full, its owner runs the job itself. No buffer is ever
///           replaced while a thief uses it, and an endlessly forking recursion stays in bounded memory.
///   Order   push() is one point in the single total order of seq_cst operations. A thread that pushes and then checks
///           for sleepers, and a thread that announces its sleep and then checks this deque, cannot both miss each
///           other.
///   Proof   tests/jobsystem/DequeModelTest.cpp checks all interleavings of a few operations.
#pragma once

#include "jobsystem/Atomics.h"
#include "jobsystem/Contention.h"
#include "jobsystem/Job.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace filament_core::jobs {

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

    /// The last item pushed, or null.
    T* take() {
        const int64_t bottom = mBottom.load(std::memory_order_relaxed) - 1;
        // Thieves may have moved top on since: then fewer items are left than this shows. The compare-and-swap, or the
        // second load below, notices.
        int64_t top = mTop.load(std::memory_order_relaxed);
        if (top > bottom) return nullptr;                    // top never passes bottom: certainly empty
        if (top == bottom) return claim(top);                // the last item: compete with the thieves
        mBottom.exchange(bottom, std::memory_order_seq_cst); // reserves the item before checking for thieves
        top = mTop.load(std::memory_order_seq_cst);
        if (top < bottom) return slot(bottom).load(std::memory_order_relaxed);
        mBottom.store(bottom + 1, std::memory_order_release); // thieves took all others meanwhile
        return top == bottom ? claim(top) : nullptr;
    }

    /// The oldest item, or null if empty; a race lost to another thief is retried.
    T* steal() {
        int64_t top = mTop.load(std::memory_order_seq_cst);
        while (top < mBottom.load(std::memory_order_seq_cst)) {
            // Read before it is claimed: afterwards the owner may push another item into the slot. An item that is
            // outdated by then fails the claim.
            T* item = slot(top).load(std::memory_order_relaxed);
            if (mTop.compare_exchange_strong(top, top + 1, std::memory_order_seq_cst)) return item;
            countLostRace<Policy>();
        }
        return nullptr;
    }

    /// The slots that hold items: [oldest, end). A slot is reused only after a take().
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

    // The thread that moves top owns the item.
    T* claim(int64_t top) {
        T* item = slot(top).load(std::memory_order_relaxed);
        if (mTop.compare_exchange_strong(top, top + 1, std::memory_order_seq_cst)) return item;
        countLostRace<Policy>();
        return nullptr;
    }

    Atomic<T*>& slot(int64_t at) { return mSlots[static_cast<uint64_t>(at) & (kSlots - 1)]; }

    // In one cache line: both sides read both, so separate lines would cost a look and a theft a second transfer.
    alignas(kCacheLineBytes) Atomic<int64_t> mTop{ 0 }; // moved by thieves, and by the owner for the last item
    Atomic<int64_t> mBottom{ 0 };                       // moved by the owner
    alignas(kCacheLineBytes) std::array<Atomic<T*>, kSlots> mSlots{};
};

} // namespace filament_core::jobs
