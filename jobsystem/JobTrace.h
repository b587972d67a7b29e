// SPDX-License-Identifier: Apache-2.0
/// JobTrace: records which thread ran what and when, for chrome://tracing, Perfetto or the project's plot tool.
///   In      jobs as the seats of a scheduler run them; spans of other threads, reported by the code that measured
///           them.
///   Out     tracks of events, or Chrome trace-event JSON.
///   Time    nanoseconds of std::chrono::steady_clock.
///   Names   of events: text that lives as long as the process, such as literals. Of tracks: copied.
///   Thread  recordJob(): the occupant of that seat. All others: any, also while jobs are recorded. A snapshot has all
///           events that were complete when it began, and no torn ones.
///   Memory  32 bytes per event, up to 2 MiB per track; its address space is reserved at the first event, the pages are
///           used as it fills.
///   Limits  a track keeps its newest 65535 events; lost ones are counted, and the count is written into the file.
///   Fails   writing: Unreadable, naming the file. Recording: never.
///   Cost    bench/jobsystem/TraceBench.cpp. A system without a trace pays one predicted branch per job.
///   Source  "Trace Event Format", Google 2016: complete events ("X") and thread names ("M").
#pragma once

#include <filament_core/Result.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace filament_core::jobs {

struct TraceEvent {
    enum class Kind : uint8_t { Job, StolenJob, Span };
    const char* name = "";
    int64_t begin = 0;
    int64_t end = 0;
    Kind kind = Kind::Span;
    int64_t frame = -1; ///< for spans: the number of the frame; -1: none
};

struct TraceTrack {
    std::string name{};
    std::vector<TraceEvent> events{}; ///< sorted by begin, longer ones first: an event precedes those it contains
    uint64_t dropped = 0;             ///< older events that were overwritten
};

class JobTrace {
public:
    static constexpr uint32_t kEventsPerTrack = 65536;

    using Track = uint32_t;

    explicit JobTrace(uint32_t seats, uint32_t eventsPerTrack = kEventsPerTrack);
    ~JobTrace();
    JobTrace(JobTrace const&) = delete;
    JobTrace& operator=(JobTrace const&) = delete;

    static int64_t now() {
        const auto time = std::chrono::steady_clock::now().time_since_epoch();
        return std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
    }

    void nameSeat(uint32_t seat, std::string name);
    void recordJob(uint32_t seat, const char* name, int64_t begin, int64_t end, bool stolen);
    /// For a thread without a seat: takes a lock, and records on a track named like the thread at its first job.
    void recordJobHere(const char* name, int64_t begin, int64_t end, bool stolen);

    /// A track for spans; the same name returns the same track.
    Track track(std::string const& name);
    void span(Track track, const char* name, int64_t begin, int64_t end, int64_t frame = -1);

    /// Tracks that have events: seats in their order, then the others in theirs.
    std::vector<TraceTrack> snapshot() const;

private:
    class Ring;
    Track trackLocked(std::string const& name);

    const uint64_t mId; // unique among the traces of the process
    std::unique_ptr<Ring[]> mSeats;
    uint32_t mSeatCount;
    uint32_t mEventsPerTrack;
    mutable std::mutex mMutex; // protects everything below, and the names of seats
    std::vector<std::unique_ptr<Ring>> mSpans;
};

/// The same tracks give the same bytes. Times are microseconds since the first event.
void writeChromeTrace(std::vector<TraceTrack> const& tracks, std::ostream& out);
Result<void> writeChromeTrace(std::vector<TraceTrack> const& tracks, std::filesystem::path const& file);

} // namespace filament_core::jobs
