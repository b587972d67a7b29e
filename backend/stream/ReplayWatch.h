// SPDX-License-Identifier: Apache-2.0
/// ReplayWatch: describes what the driver thread is doing, and warns when it is stuck.
///   In      the driver thread reports what it begins and ends; replay() reports the current command (ReplayProgress).
///   Out     describe(): "in command DrawIndexed (number 1234 of frame 17, pass 'color', after pipeline 'helmet') for
///           10.2 s". check(): the same as a warning in the log, once for each stall.
///   Thread  begin...(), end(): the driver thread. The rest: any. There is no watchdog thread: a thread that waits for
///           the driver thread calls check() every period(). A stall is timed from the first such check.
///   Memory  the names of live pipelines.
///   Fails   never.
///   Cost    a short lock at the start and the end of a stream. A description walks the stream up to the command.
#pragma once

#include "backend/api/ReplayProgress.h"
#include "backend/stream/CommandBuffer.h"

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <unordered_map>

namespace filament_core::backend {

class ReplayWatch {
public:
    using PipelineNames = std::unordered_map<PipelineHandle, std::string>;

    /// `limit`: check() warns if nothing changes for this long; zero: never.
    explicit ReplayWatch(std::chrono::milliseconds limit) : mLimit(limit) {}

    // ---- the driver thread
    void beginMakingDriver() { begin(Activity::MakingDriver); }
    void beginEndingDriver() { begin(Activity::EndingDriver); }
    /// Waiting for the device.
    void beginSettling() { begin(Activity::Settling); }
    /// `commands` must not change until end().
    void beginReplay(CommandBuffer const& commands, uint64_t frame);
    void end();
    ReplayProgress& progress() { return mProgress; }

    // ---- any thread
    bool warns() const { return mLimit.count() > 0; }
    /// Interval between checks.
    std::chrono::milliseconds period() const;
    void check();
    std::string describe();

private:
    using Clock = std::chrono::steady_clock;
    enum class Activity : uint8_t { None, MakingDriver, Replaying, Settling, EndingDriver };

    void begin(Activity activity);
    void look(Clock::time_point now);
    std::string describe(Clock::time_point now);
    std::string describeReplay();
    std::string frameText() const;

    const std::chrono::milliseconds mLimit;
    ReplayProgress mProgress;

    std::mutex mMutex;
    Activity mActivity = Activity::None;
    CommandView mCommands; // while it replays
    uint64_t mFrame = 0;
    bool mIsNumberedByApp = false, mChangesPipelines = false;
    const std::byte* mSeenCommand = nullptr;
    Clock::time_point mSince{}; // start of the activity, or of the first check of mSeenCommand
    bool mHasWarned = false;
    PipelineNames mPipelineNames;
};

} // namespace filament_core::backend
