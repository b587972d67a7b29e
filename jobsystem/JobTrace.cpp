// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/JobTrace.h"

#include "base/Assert.h"
#include "jobsystem/Affinity.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <tuple>

namespace filament_core::jobs {
namespace {

uint64_t nextId() {
    static std::atomic<uint64_t> last{ 0 };
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

} // namespace

/// The newest events of one track. Only one thread writes at a time; any thread may read.
/// The writer publishes event n after writing its fields, and overwrites a slot only after publishing all earlier
/// events. A reader copies the events and then reads the published count again: only copies that are a whole ring
/// behind that count may have been overwritten meanwhile.
class JobTrace::Ring {
public:
    std::string name;

    void setCapacity(uint32_t events) { mCapacity = events; }
    bool isEmpty() const { return mCount.load(std::memory_order_acquire) == 0; }
    void push(TraceEvent const& event);
    TraceTrack read() const;

private:
    // Memory from calloc, so that pages are touched only when events reach them; accessed as atomics.
    struct Slot {
        const char* name;
        int64_t begin;
        int64_t end;
        int64_t kindAndFrame; // kind + 4 frame
    };
    struct Free {
        void operator()(Slot* slots) const { std::free(slots); }
    };

    template <class T>
    // Released and acquired, not relaxed: a reader that sees a field of a new event must also see the count of all
    // events before it, by which it discards the copy. Boehm 2012, "Can Seqlocks Get Along With Programming Language
    // Memory Models?".
    static void store(T& field, T value) {
        std::atomic_ref<T>(field).store(value, std::memory_order_release);
    }
    template <class T>
    static T load(T& field) {
        return std::atomic_ref<T>(field).load(std::memory_order_acquire);
    }
    Slot& slot(uint64_t event) const { return mSlots[event & (mCapacity - 1)]; }

    uint32_t mCapacity = 0;               // a power of two
    std::unique_ptr<Slot[], Free> mSlots; // written before the first count, read after it
    std::atomic<uint64_t> mCount{ 0 };    // events published since the start
};

void JobTrace::Ring::push(TraceEvent const& event) {
    const uint64_t count = mCount.load(std::memory_order_relaxed);
    if (count == 0) mSlots.reset(static_cast<Slot*>(std::calloc(mCapacity, sizeof(Slot))));
    if (mSlots) {
        Slot& target = slot(count);
        store(target.name, event.name);
        store(target.begin, event.begin);
        store(target.end, event.end);
        store(target.kindAndFrame, static_cast<int64_t>(event.kind) + event.frame * 4);
    }
    mCount.store(count + 1, std::memory_order_release);
}

TraceTrack JobTrace::Ring::read() const {
    TraceTrack track{ .name = name };
    const auto firstIntact = [this](uint64_t count) { return count < mCapacity ? 0 : count - mCapacity + 1; };
    const uint64_t count = mCount.load(std::memory_order_acquire);
    const uint64_t first = firstIntact(count);
    if (count == 0) return track;
    if (!mSlots) { // no memory for the ring: all events are lost
        track.dropped = count;
        return track;
    }
    track.events.reserve(count - first);
    for (uint64_t i = first; i < count; ++i) {
        Slot& source = slot(i);
        const int64_t kindAndFrame = load(source.kindAndFrame);
        track.events.push_back({ load(source.name), load(source.begin), load(source.end),
                                 static_cast<TraceEvent::Kind>(kindAndFrame & 3), kindAndFrame >> 2 });
    }
    track.dropped = std::min(firstIntact(mCount.load(std::memory_order_acquire)), count);
    track.events.erase(track.events.begin(), track.events.begin() + static_cast<ptrdiff_t>(track.dropped - first));
    // If events begin and end together, the one recorded last encloses the others.
    std::reverse(track.events.begin(), track.events.end());
    std::stable_sort(track.events.begin(), track.events.end(), [](TraceEvent const& a, TraceEvent const& b) {
        return std::tuple(a.begin, b.end) < std::tuple(b.begin, a.end);
    });
    return track;
}

JobTrace::JobTrace(uint32_t seats, uint32_t eventsPerTrack)
        : mId(nextId()), mSeats(std::make_unique<Ring[]>(seats)), mSeatCount(seats), mEventsPerTrack(eventsPerTrack) {
    FILAMENT_ASSERT(eventsPerTrack >= 2 && std::has_single_bit(eventsPerTrack),
                    "JobTrace keeps a power of two of events, at least 2");
    for (uint32_t i = 0; i < seats; ++i) {
        mSeats[i].setCapacity(eventsPerTrack);
        mSeats[i].name = "seat " + std::to_string(i);
    }
}

JobTrace::~JobTrace() = default;

void JobTrace::nameSeat(uint32_t seat, std::string name) {
    FILAMENT_ASSERT(seat < mSeatCount, "a seat of the traced job system");
    const std::lock_guard lock(mMutex);
    mSeats[seat].name = std::move(name);
}

void JobTrace::recordJob(uint32_t seat, const char* name, int64_t begin, int64_t end, bool stolen) {
    FILAMENT_DEBUG_ASSERT(seat < mSeatCount, "a seat of the traced job system");
    mSeats[seat].push({ name, begin, end, stolen ? TraceEvent::Kind::StolenJob : TraceEvent::Kind::Job });
}

void JobTrace::recordJobHere(const char* name, int64_t begin, int64_t end, bool stolen) {
    static thread_local struct {
        uint64_t trace = 0;
        Track track = 0;
    } tLast; // cached: asking the system for the name costs more than everything else here
    const std::lock_guard lock(mMutex);
    if (tLast.trace != mId) tLast = { mId, trackLocked(nameOfThisThread()) };
    mSpans[tLast.track]->push({ name, begin, end, stolen ? TraceEvent::Kind::StolenJob : TraceEvent::Kind::Job });
}

JobTrace::Track JobTrace::track(std::string const& name) {
    const std::lock_guard lock(mMutex);
    return trackLocked(name);
}

JobTrace::Track JobTrace::trackLocked(std::string const& name) {
    const auto known = std::find_if(mSpans.begin(), mSpans.end(), [&](auto const& ring) { return ring->name == name; });
    if (known != mSpans.end()) return static_cast<Track>(known - mSpans.begin());
    mSpans.push_back(std::make_unique<Ring>());
    mSpans.back()->setCapacity(mEventsPerTrack);
    mSpans.back()->name = name;
    return static_cast<Track>(mSpans.size() - 1);
}

void JobTrace::span(Track track, const char* name, int64_t begin, int64_t end, int64_t frame) {
    FILAMENT_ASSERT(begin <= end, "a span ends after it has begun");
    const std::lock_guard lock(mMutex);
    FILAMENT_ASSERT(track < mSpans.size(), "a track that JobTrace::track() gave");
    mSpans[track]->push({ name, begin, end, TraceEvent::Kind::Span, frame });
}

std::vector<TraceTrack> JobTrace::snapshot() const {
    const std::lock_guard lock(mMutex);
    std::vector<TraceTrack> tracks;
    for (uint32_t i = 0; i < mSeatCount; ++i) {
        if (!mSeats[i].isEmpty()) tracks.push_back(mSeats[i].read());
    }
    for (auto const& ring : mSpans) {
        if (!ring->isEmpty()) tracks.push_back(ring->read());
    }
    return tracks;
}

} // namespace filament_core::jobs
