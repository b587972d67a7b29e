// SPDX-License-Identifier: Apache-2.0
/// Workers: processes that draw, kept alive by a thread of the server.
///   Ends      one that ends is replaced, and its job tried by another; a job with which two ended has failed. One that
///             draws longer than the limit is killed, and its job has failed.
///   Broken    if workers end again and again without a job, the machine cannot draw: isBroken(), with the last lines
///             of their log.
///   Thread    start() and stop() of one; the rest any.
#pragma once

#include "toolkit/program/ChildProcess.h"
#include "tools/server/Spool.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace filament_core::server {

struct WorkerSettings {
    std::vector<std::string> command; ///< of a worker
    std::filesystem::path logs;       ///< a folder
    uint32_t count = 1;
    double mostSeconds = 60; ///< of a job
};

class Workers {
public:
    Workers(Spool spool, WorkerSettings settings) : mSpool(std::move(spool)), mSettings(std::move(settings)) {}
    ~Workers() { stop(); }

    Result<void> start();
    void stop(); ///< kills them; what they draw is drawn after the next start

    uint32_t count() const { return mSettings.count; }
    uint32_t restarts() const { return mRestarts; }
    uint64_t residentBytes() const; ///< of all together
    bool isBroken() const { return mIsBroken; }

private:
    using Clock = std::chrono::steady_clock;
    struct Slot {
        std::unique_ptr<tools::ChildProcess> process;
        std::filesystem::path log;
        Clock::time_point begin;
        std::string job; ///< that it has; empty: none
        Clock::time_point jobBegin;
    };
    Result<void> startWorker(Slot& slot);
    void watch();
    void look(Slot& slot);
    void noteJob(Slot& slot);
    void end(Slot& slot, std::string const& reason, uint32_t mostTries, int status);

    Spool mSpool;
    WorkerSettings mSettings;
    std::vector<Slot> mSlots;
    std::thread mThread;
    std::atomic<bool> mStops{ false }, mIsBroken{ false };
    std::atomic<uint32_t> mRestarts{ 0 };
    std::vector<std::atomic<long>> mIds; ///< of the processes, for residentBytes()
    uint32_t mQuickEnds = 0;
};

} // namespace filament_core::server
