// SPDX-License-Identifier: Apache-2.0
/// FrameTimingLog: when each frame was prepared, recorded and replayed, and the device time of its passes.
///   Thread  the app thread; results are polled from the stream.
///   Trace   with EngineOptions::traceJobs, frames and replays become spans beside the jobs.
///   Memory  the last 64 frames, 16 passes each, in place: writing allocates nothing. Older frames are overwritten.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/engine/EngineImpl.h"
#include "framegraph/CompiledGraph.h"

#include <filament/Renderer.h>

#include <array>
#include <chrono>

namespace filament::engine {

class FrameTimingLog {
public:
    explicit FrameTimingLog(Engine::Impl& engine) : mEngine(engine) {}

    using TimePoint = std::chrono::steady_clock::time_point;
    struct Stamps {
        TimePoint begin, prepared, acquired, recorded; ///< between prepared and acquired: waiting for the driver
        uint64_t workerBusyNanoseconds = 0;            ///< while the frame was prepared and recorded
        uint64_t packetHash = 0;
    };

    /// After submit().
    void add(uint64_t frame, Stamps const& stamps, std::span<const framegraph::PassTimer> timers);
    /// Frames whose replay has finished and whose timers have results.
    std::vector<FrameTimings> take();

private:
    struct Pass {
        std::array<char, 32> name{};
        backend::Ticket ticket;
        double milliseconds = -1; ///< < 0: no result yet
    };
    struct Record {
        uint64_t frame = 0;
        Stamps stamps{};
        std::array<Pass, 16> passes{};
        uint32_t passCount = 0;
        backend::FrameTiming replay{};
        bool replayed = false;
        bool taken = true;
    };

    void traceFrame(Record const& record);
    void traceReplay(backend::FrameTiming const& replay);
    void collectReplays();
    bool isComplete(Record& record);
    FrameTimings publish(Record const& record) const;

    Engine::Impl& mEngine;
    std::array<Record, 64> mRecords{};
};

} // namespace filament::engine
