// SPDX-License-Identifier: Apache-2.0
/// FrameTimingLog: when each frame was prepared, recorded and replayed, and the device time of its passes.
///   Thread  the app thread; results are polled from the stream.
///   Trace   with EngineOptions::traceJobs, frames and replays become spans beside the jobs.
///   Memory  the last 64 frames with all of their passes; older ones are overwritten. Room is made when a frame has
///   more
///           passes than any before it, for all 64 at once: after that, writing allocates nothing.
///   Fails   never; without memory for that a frame has no pass times.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/engine/EngineImpl.h"
#include "framegraph/CompiledGraph.h"

#include <filament_core/Renderer.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

namespace filament_core::engine {

class FrameTimingLog final : public Dependent {
public:
    explicit FrameTimingLog(Engine::Impl& engine);
    FrameTimingLog(FrameTimingLog const&) = delete;
    ~FrameTimingLog();
    void release() noexcept override { mIsListed = false; }

    /// Of CmdBeginFrame: the logs of an engine count their frames in ranges of their own, since whichever asks the
    /// stream for replays gets those of all. The first log's are the frames themselves.
    uint64_t numberInStream(uint64_t frame) const { return mRange << kFrameBits | frame; }

    using TimePoint = std::chrono::steady_clock::time_point;
    struct Stamps {
        TimePoint begin, prepared, acquired, recorded; ///< between prepared and acquired: waiting for the driver
        uint64_t workerBusyNanoseconds = 0;            ///< while the frame was prepared and recorded
        uint64_t packetHash = 0;
        float2 scale{ 1 }; ///< Resolution::scale that it was drawn with
    };

    /// After submit().
    void add(uint64_t frame, Stamps const& stamps, std::span<const framegraph::PassTimer> timers);
    /// Frames whose replay has finished and whose timers have results.
    std::vector<FrameTimings> take();
    /// Calls `visit(float2 scale, double milliseconds)` with the cost of each frame that has finished, once, oldest
    /// first: that of its passes on the device, if there are timers, or else of its replay. A steady state allocates
    /// nothing.
    template <class Visit>
    void visitFinished(bool hasTimers, Visit&& visit) {
        if (hasTimers)
            collectTimers();
        else
            collectReplays();
        const uint64_t newest = mNewest;
        for (uint64_t frame = std::max(mVisited + 1, newest >= mRecords.size() ? newest - mRecords.size() + 1 : 1);
             frame <= newest; ++frame) {
            Record const& record = mRecords[frame % mRecords.size()];
            if (record.frame != frame) continue;
            if (hasTimers ? record.waiting > 0 : !record.replayed) break;
            visit(record.stamps.scale, hasTimers ? deviceMilliseconds(record) : replayMilliseconds(record));
            mVisited = frame;
        }
    }
    /// Frames until now are not visited.
    void skip() { mVisited = mNewest; }
    /// Of the last frame whose timers have all been read, also if take() has returned it; empty: there is none.
    std::vector<PassTiming> latestPasses() const;

private:
    struct Pass {
        std::array<char, 64> name{}; ///< longer ones, of many merged passes, are cut
        backend::Ticket ticket;
        double milliseconds = -1; ///< < 0: no result yet
    };
    struct Record {
        uint64_t frame = 0;
        Stamps stamps{};
        std::vector<Pass> passes{};
        size_t waiting = 0; ///< passes without an answer
        backend::FrameTiming replay{};
        bool replayed = false;
        bool taken = true;
    };

    static constexpr uint32_t kFrameBits = 40;
    static uint64_t frameOf(uint64_t numberInStream) { return numberInStream & ((uint64_t{ 1 } << kFrameBits) - 1); }

    FrameTimingLog* logOf(uint64_t numberInStream);
    void keep(backend::FrameTiming const& replay);
    void traceFrame(Record const& record);
    void traceReplay(backend::FrameTiming const& replay);
    void collectReplays();
    bool makeRoom(size_t passes) noexcept;
    void collectTimers();
    FrameTimings publish(Record const& record) const;
    static double deviceMilliseconds(Record const& record);
    static double replayMilliseconds(Record const& record);

    Engine::Impl& mEngine; ///< while it is listed there
    bool mIsListed = false;
    uint64_t mRange = 0; ///< no other log of the engine has it
    std::array<Record, 64> mRecords{};
    size_t mPassRoom = 0;                       ///< of every record
    uint64_t mNewest = 0, mVisited = 0;         ///< frames
    std::vector<backend::FrameTiming> mReplays; ///< of the last collection
};

} // namespace filament_core::engine
