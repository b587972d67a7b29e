// SPDX-License-Identifier: Apache-2.0
/// IndexStack: a lock-free stack of the numbers below its capacity, used as a free list by any number of threads.
///   Source  Treiber 1986, "Systems programming: coping with parallelism". The upper half of the head counts changes,
///           so that a head that returns to an old value (ABA) is recognised. Links are atomic, because a thread that
///           is about to lose the race still reads them.
///   Thread  any. Writes before push() are visible after the pop() that returns the number.
///   Memory  4 bytes per number, allocated by the constructor.
///   Limits  a number is on the stack at most once. Fails if a thread sleeps inside pop() for exactly 2^32 changes.
///   Fails   pop() returns kNone when the stack is empty.  Cost: one compare-and-swap.
///   Proof   tests/jobsystem/IndexStackModelTest.cpp
#pragma once

#include "jobsystem/Atomics.h"
#include "jobsystem/Contention.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace filament_core::jobs {

template <class Policy = StdAtomics>
class IndexStack {
public:
    static constexpr uint32_t kNone = ~0u;

    explicit IndexStack(uint32_t capacity) : mNext(std::make_unique<Atomic<uint32_t>[]>(capacity)) {}

    void push(uint32_t index) {
        uint64_t head = mHead.load(std::memory_order_relaxed);
        for (;; countLostRace<Policy>()) {
            mNext[index].store(static_cast<uint32_t>(head), std::memory_order_relaxed);
            if (mHead.compare_exchange_weak(head, follow(head, index), std::memory_order_release,
                                            std::memory_order_relaxed))
                return;
        }
    }

    uint32_t pop() {
        uint64_t head = mHead.load(std::memory_order_acquire);
        for (;; countLostRace<Policy>()) {
            const auto index = static_cast<uint32_t>(head);
            if (index == kNone) return kNone;
            const uint32_t next = mNext[index].load(std::memory_order_relaxed);
            if (mHead.compare_exchange_weak(head, follow(head, next), std::memory_order_acquire,
                                            std::memory_order_acquire))
                return index;
        }
    }

private:
    template <class T>
    using Atomic = typename Policy::template Atomic<T>;

    static uint64_t follow(uint64_t head, uint32_t top) { return (((head >> 32) + 1) << 32) | top; }

    const std::unique_ptr<Atomic<uint32_t>[]> mNext;
    alignas(64) Atomic<uint64_t> mHead{ kNone }; // changes << 32 | top
};

} // namespace filament_core::jobs
