// SPDX-License-Identifier: Apache-2.0
/// ModelMemory: what a program may read under the C++20 memory model, one step at a time.
///   In      operations on atomics, by thread.  Out: the stores that an operation may read from or follow; the caller
///           picks one. All picks over all interleavings are all behaviours.
///   Source  the view machine of Kang, Hur, Lahav, Vafeiadis and Dreyer 2017, "A promising semantics for relaxed-memory
///           concurrency", section 3, without promises; seq_cst accesses and release sequences as in [atomics.order]
///           and [intro.races] of C++20. A store has a place in the modification order of its object; a thread has a
///           view: the oldest store of each object that it may still read. Release stores carry the view of their
///           thread, and acquire loads adopt it.
///   Shows   store buffering, stale reads, writes seen in different orders by different threads, modification orders
///           that differ from the order of execution. This covers all behaviours of x86, and all of ARMv8 except:
///   Limits  a load never reads from a store that is later in its own thread's future (load buffering), and the order
///           of seq_cst operations is the order of execution, hence consistent with happens-before, which does not hold
///           on POWER. No fences. 20 threads, 416 objects, 1024 stores to each.
///   Thread  one.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

namespace filament_core::jobs::model {

inline constexpr int kMaxThreads = 20; // sixteen workers and what they work for
inline constexpr int kMaxLocations = 416;
inline constexpr uint32_t kMaxStores = 1024;

/// A store to an object, by the order of execution.
using StoreIndex = uint16_t;

/// A thread's knowledge: by location the oldest store it may read, and by thread how far the others have come.
struct View {
    std::array<StoreIndex, kMaxLocations> seen{};
    std::array<uint16_t, kMaxThreads> clock{};
};

/// The stores to pick from, newest first.
struct Choices {
    std::array<StoreIndex, kMaxStores> stores;
    uint32_t count = 0;
};

constexpr bool isAcquire(std::memory_order order) {
    return order == std::memory_order_acquire || order == std::memory_order_acq_rel ||
           order == std::memory_order_seq_cst || order == std::memory_order_consume;
}
constexpr bool isRelease(std::memory_order order) {
    return order == std::memory_order_release || order == std::memory_order_acq_rel ||
           order == std::memory_order_seq_cst;
}

class ModelMemory {
public:
    /// Before every run.
    void clear();
    /// Of the run, before any of them makes a step.
    void setThreads(int threads) { mThreads = threads; }

    /// `thread` < 0: before all threads. Negative if there are too many locations.
    int create(int thread, uint64_t initial);
    /// False if some access does not happen before the end of the object's life.
    bool destroy(int thread, int location);
    bool isAlive(int location) const { return mLocations[location].alive; }
    bool isConstructedFor(int thread, int location) const;

    /// The thread's own time advances: later writes are invisible to threads that synchronised with it before.
    void tick(int thread) { ++mViews[thread].clock[thread]; }

    Choices readable(int thread, int location, std::memory_order order) const;
    /// The stores that a new store may directly follow in the modification order.
    Choices followable(int thread, int location, std::memory_order order) const;
    /// True if a read-modify-write may read this store.
    bool mayBeModified(int location, StoreIndex store) const;

    uint64_t load(int thread, int location, StoreIndex from, std::memory_order order);
    /// False if the location is full.
    bool store(int thread, int location, StoreIndex after, uint64_t value, std::memory_order order);
    bool modify(int thread, int location, StoreIndex from, uint64_t value, std::memory_order order);

    /// True if a seq_cst load can read nothing but the last store.
    bool isSettled(int location) const;

    /// What the kernel may find in a futex word: nothing older than what came before a wake-up that it has handled.
    Choices readableByKernel(int thread, int location) const;
    void notePassedThroughKernel(int thread, int location);

    bool hasUnseenStores(int thread) const;
    void seeEverything(int thread); ///< without synchronising

    uint64_t value(int location, StoreIndex store) const { return mLocations[location].stores[store].value; }
    uint64_t latest(int location) const;
    void replaceLatest(int location, uint64_t value); ///< before and after all threads
    View const& view(int thread) const { return mViews[thread]; }
    bool happenedBefore(int thread, uint16_t time, int before) const { return time <= mViews[thread].clock[before]; }

private:
    struct Store {
        uint64_t value;
        View released; // what an acquire load that reads this store learns
        bool isModification;
        bool isInitial = false; // its view is empty
    };
    struct Location {
        std::vector<Store> stores;
        std::vector<StoreIndex> order;               // store by rank in the modification order
        std::vector<StoreIndex> rank;                // and back
        std::array<uint16_t, kMaxThreads> touchedAt; // the last access of each thread, in its own time
        int creator;                                 // negative: before all threads
        uint16_t createdAt;
        StoreIndex seqCstFloor; // the latest store that a seq_cst operation wrote or read
        StoreIndex kernelFloor; // the latest store known to a thread that was in the kernel with this word
        bool alive;

        int count() const { return static_cast<int>(stores.size()); }
    };

    bool insert(int thread, int location, StoreIndex after, Store const& store, std::memory_order order);
    void raise(int location, StoreIndex& floor, StoreIndex store) const;
    void join(View& into, View const& from) const;
    bool hasUnseenStores(int thread, int location) const;
    StoreIndex floor(int thread, int location, std::memory_order order) const;

    std::array<Location, kMaxLocations> mLocations;
    std::array<View, kMaxThreads> mViews;
    int mLocationCount = 0, mThreads = kMaxThreads;
    int mLastStored = 0; // the location of the last store
};

} // namespace filament_core::jobs::model
