// SPDX-License-Identifier: Apache-2.0
/// jobTimeline: what every thread of an engine did and when, for tools that draw it. The same events as those that
/// Engine::writeJobTrace() writes into a file.
///   In      an engine with EngineOptions::traceJobs; of one without it nothing is known. Recording costs two readings
///           of the clock for each job, and nothing without the option.
///   Time    seconds since the engine started, as in FrameTimings.
///   Thread  any, also while frames are drawn; the engine must not end or be moved meanwhile.
///   Cost    proportional to the events that a thread keeps, at most 65 535 each, not to `seconds`.
///   Fails   never.
#pragma once

#include <filament_core/Engine.h>

#include <cstdint>
#include <string>
#include <vector>

namespace filament_core {

struct JobSpan {
    enum class Kind : uint8_t {
        Job,       ///< a thread ran a job that it had made
        StolenJob, ///< that another one had made
        Phase,     ///< of a frame: "prepare frame", "wait for driver", "record frame", "replay frame"
    };
    const char* name = ""; ///< lives as long as the process
    double beginSeconds = 0, endSeconds = 0;
    Kind kind = Kind::Job;
    int64_t frame = -1; ///< of a phase; -1: none
};

/// One thread. The app thread has two of them: "app thread" for its phases, and one for its jobs under the name that
/// the system knows it by.
struct JobTrack {
    std::string name{};           ///< "worker 0", "app thread", "driver thread"
    std::vector<JobSpan> spans{}; ///< by their beginnings; a span precedes those that it contains
    uint64_t lost = 0;            ///< older ones that are not kept
};

/// What ended in the last `seconds` before the end of the newest span. Threads that did nothing then are absent.
std::vector<JobTrack> jobTimeline(Engine& engine, double seconds);

} // namespace filament_core
