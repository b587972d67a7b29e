// SPDX-License-Identifier: Apache-2.0
// jobTimeline(): events of the job system's trace, in seconds of the engine.
#include <filament_core/JobTimeline.h>

#include "filament_core/engine/EngineImpl.h"
#include "jobsystem/JobTrace.h"

#include <algorithm>
#include <limits>

namespace filament_core {
namespace {

JobSpan::Kind kindOf(jobs::TraceEvent::Kind kind) {
    switch (kind) {
    case jobs::TraceEvent::Kind::Job:
        return JobSpan::Kind::Job;
    case jobs::TraceEvent::Kind::StolenJob:
        return JobSpan::Kind::StolenJob;
    case jobs::TraceEvent::Kind::Span:
        return JobSpan::Kind::Phase;
    }
    return JobSpan::Kind::Job;
}

/// Events that end before this are too old, in nanoseconds.
int64_t oldestEnd(std::vector<jobs::TraceTrack> const& tracks, double seconds) {
    int64_t newest = std::numeric_limits<int64_t>::min();
    for (jobs::TraceTrack const& track : tracks)
        for (jobs::TraceEvent const& event : track.events) newest = std::max(newest, event.end);
    const double kept = std::max(seconds, 0.0) * 1e9;
    return kept >= static_cast<double>(newest) ? std::numeric_limits<int64_t>::min()
                                               : newest - static_cast<int64_t>(kept);
}

} // namespace

// Not a PublicCall: other threads than the engine's may call it.
std::vector<JobTrack> jobTimeline(Engine& engine, double seconds) {
    Engine::Impl& impl = engine.impl();
    std::vector<JobTrack> tracks;
    if (!impl.jobs.trace()) return tracks;
    const std::vector<jobs::TraceTrack> traced = impl.jobs.trace()->snapshot();
    const int64_t oldest = oldestEnd(traced, seconds);
    for (jobs::TraceTrack const& from : traced) {
        JobTrack track{ .name = from.name, .lost = from.dropped };
        for (jobs::TraceEvent const& event : from.events) {
            if (event.end < oldest) continue;
            track.spans.push_back({ event.name, impl.secondsSinceStart(event.begin), impl.secondsSinceStart(event.end),
                                    kindOf(event.kind), event.frame });
        }
        if (!track.spans.empty()) tracks.push_back(std::move(track));
    }
    return tracks;
}

} // namespace filament_core
