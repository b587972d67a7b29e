// SPDX-License-Identifier: Apache-2.0
#include "tests/jobsystem/ModelMemory.h"

#include <algorithm>

namespace filament_core::jobs::model {

void ModelMemory::clear() {
    mLocationCount = mLastStored = 0;
    mViews = {};
}

int ModelMemory::create(int thread, uint64_t initial) {
    if (mLocationCount == kMaxLocations) return -1;
    Location& made = mLocations[mLocationCount];
    made.stores.assign(1, { initial, View{}, false, true });
    made.order.assign(1, 0);
    made.rank.assign(1, 0);
    made.touchedAt = {};
    made.creator = thread;
    made.createdAt = thread < 0 ? uint16_t{ 0 } : mViews[thread].clock[thread];
    made.seqCstFloor = made.kernelFloor = 0;
    made.alive = true;
    return mLocationCount++;
}

bool ModelMemory::destroy(int thread, int location) {
    Location& ended = mLocations[location];
    ended.alive = false;
    if (thread < 0) return true; // after all threads
    for (int other = 0; other < mThreads; ++other) {
        if (other != thread && !happenedBefore(thread, ended.touchedAt[other], other)) return false;
    }
    return true;
}

bool ModelMemory::isConstructedFor(int thread, int location) const {
    Location const& at = mLocations[location];
    return at.creator < 0 || happenedBefore(thread, at.createdAt, at.creator);
}

void ModelMemory::raise(int location, StoreIndex& floor, StoreIndex store) const {
    std::vector<StoreIndex> const& rank = mLocations[location].rank;
    if (rank[store] > rank[floor]) floor = store;
}

void ModelMemory::join(View& into, View const& from) const {
    for (int i = 0; i < mLocationCount; ++i) {
        if (into.seen[i] != from.seen[i]) raise(i, into.seen[i], from.seen[i]);
    }
    for (int i = 0; i < mThreads; ++i) into.clock[i] = std::max(into.clock[i], from.clock[i]);
}

// Coherence: nothing older than what the thread has seen. Total order: otherwise a seq_cst operation would be
// coherence-ordered before what an earlier seq_cst operation on the same object read or wrote.
StoreIndex ModelMemory::floor(int thread, int location, std::memory_order order) const {
    StoreIndex floor = mViews[thread].seen[location];
    if (order == std::memory_order_seq_cst) raise(location, floor, mLocations[location].seqCstFloor);
    return floor;
}

Choices ModelMemory::readable(int thread, int location, std::memory_order order) const {
    Location const& at = mLocations[location];
    Choices choices;
    for (int rank = at.count() - 1; rank >= at.rank[floor(thread, location, order)]; --rank) {
        choices.stores[choices.count++] = at.order[rank];
    }
    return choices;
}

bool ModelMemory::mayBeModified(int location, StoreIndex store) const {
    Location const& at = mLocations[location];
    const int next = at.rank[store] + 1;
    return next == at.count() ||
           !at.stores[at.order[next]].isModification; // which would no longer follow its own store
}

Choices ModelMemory::followable(int thread, int location, std::memory_order order) const {
    const Choices all = readable(thread, location, order);
    Choices choices;
    for (uint32_t i = 0; i < all.count; ++i) {
        if (mayBeModified(location, all.stores[i])) choices.stores[choices.count++] = all.stores[i];
    }
    return choices;
}

uint64_t ModelMemory::load(int thread, int location, StoreIndex from, std::memory_order order) {
    Location& at = mLocations[location];
    View& view = mViews[thread];
    raise(location, view.seen[location], from);
    if (isAcquire(order) && !at.stores[from].isInitial) join(view, at.stores[from].released);
    if (order == std::memory_order_seq_cst) raise(location, at.seqCstFloor, from);
    at.touchedAt[thread] = view.clock[thread];
    return at.stores[from].value;
}

bool ModelMemory::insert(int thread, int location, StoreIndex after, Store const& store, std::memory_order order) {
    Location& at = mLocations[location];
    if (at.stores.size() == kMaxStores) return false;
    const auto made = static_cast<StoreIndex>(at.stores.size());
    const int rank = at.rank[after] + 1;
    at.order.insert(at.order.begin() + rank, made);
    at.rank.push_back(made);
    for (int i = rank; i <= made; ++i) at.rank[at.order[i]] = static_cast<StoreIndex>(i);

    mLastStored = location;
    View& view = mViews[thread];
    view.seen[location] = made;
    at.touchedAt[thread] = view.clock[thread];
    at.stores.push_back(store);
    if (isRelease(order)) join(at.stores[made].released, view);
    at.stores[made].released.seen[location] = made;
    if (order == std::memory_order_seq_cst) raise(location, at.seqCstFloor, made);
    return true;
}

bool ModelMemory::store(int thread, int location, StoreIndex after, uint64_t value, std::memory_order order) {
    return insert(thread, location, after, { value, View{}, false }, order);
}

// A modification passes on what the store that it read had released: it continues that release sequence.
bool ModelMemory::modify(int thread, int location, StoreIndex from, uint64_t value, std::memory_order order) {
    load(thread, location, from, order);
    return insert(thread, location, from, { value, mLocations[location].stores[from].released, true }, order);
}

bool ModelMemory::isSettled(int location) const {
    Location const& at = mLocations[location];
    return at.rank[at.seqCstFloor] == at.count() - 1;
}

Choices ModelMemory::readableByKernel(int thread, int location) const {
    Location const& at = mLocations[location];
    StoreIndex floor = mViews[thread].seen[location];
    raise(location, floor, at.kernelFloor);
    Choices choices;
    for (int rank = at.count() - 1; rank >= at.rank[floor]; --rank) choices.stores[choices.count++] = at.order[rank];
    return choices;
}

void ModelMemory::notePassedThroughKernel(int thread, int location) {
    raise(location, mLocations[location].kernelFloor, mViews[thread].seen[location]);
}

bool ModelMemory::hasUnseenStores(int thread, int location) const {
    Location const& at = mLocations[location];
    return at.alive && at.rank[mViews[thread].seen[location]] != at.count() - 1;
}

bool ModelMemory::hasUnseenStores(int thread) const {
    if (mLocationCount == 0) return false;
    if (hasUnseenStores(thread, mLastStored)) return true; // most often
    for (int i = 0; i < mLocationCount; ++i) {
        if (hasUnseenStores(thread, i)) return true;
    }
    return false;
}

void ModelMemory::seeEverything(int thread) {
    for (int i = 0; i < mLocationCount; ++i) mViews[thread].seen[i] = mLocations[i].order[mLocations[i].count() - 1];
}

uint64_t ModelMemory::latest(int location) const {
    Location const& at = mLocations[location];
    return at.stores[at.order[at.count() - 1]].value;
}

void ModelMemory::replaceLatest(int location, uint64_t value) {
    Location& at = mLocations[location];
    at.stores[at.order[at.count() - 1]].value = value;
}

} // namespace filament_core::jobs::model
