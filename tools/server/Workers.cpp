// SPDX-License-Identifier: Apache-2.0
#include "tools/server/Workers.h"

#include "base/Log.h"

#include <fmt/format.h>

#include <unistd.h>

#include <fstream>

namespace filament_core::server {
namespace {

constexpr std::chrono::milliseconds kInterval(50);
constexpr uint32_t kMostTries = 2;     // of a job, if processes end with it
constexpr uint32_t kMostQuickEnds = 5; // in a row, of workers without a job
constexpr double kQuick = 2;           // seconds

double secondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace

Result<void> Workers::startWorker(Slot& slot) {
    Result<tools::ChildProcess> process =
            tools::ChildProcess::start({ .words = mSettings.command, .environment = {}, .log = slot.log });
    if (!process) return process.error();
    slot.process = std::make_unique<tools::ChildProcess>(std::move(*process));
    slot.begin = Clock::now();
    slot.job.clear();
    mIds[static_cast<size_t>(&slot - mSlots.data())] = slot.process->id();
    return {};
}

Result<void> Workers::start() {
    mSlots.resize(mSettings.count);
    mIds = std::vector<std::atomic<long>>(mSettings.count);
    for (size_t i = 0; i < mSlots.size(); ++i) {
        mSlots[i].log = mSettings.logs / fmt::format("worker-{}.log", i);
        if (Result<void> done = startWorker(mSlots[i]); !done) return done;
    }
    mThread = std::thread([this] { watch(); });
    return {};
}

void Workers::stop() {
    mStops = true;
    if (mThread.joinable()) mThread.join();
    mSlots.clear();
}

void Workers::watch() {
    while (!mStops) {
        for (Slot& slot : mSlots) look(slot);
        std::this_thread::sleep_for(kInterval);
    }
}

/// Which job a worker has is in the name of its file.
void Workers::noteJob(Slot& slot) {
    const std::string job = mSpool.runningOf(slot.process->id());
    if (job == slot.job) return;
    slot.job = job;
    slot.jobBegin = Clock::now();
}

void Workers::end(Slot& slot, std::string const& reason, uint32_t mostTries, int status) {
    const bool hadJob = !slot.job.empty();
    const long process = mIds[static_cast<size_t>(&slot - mSlots.data())];
    if (Result<void> done = mSpool.release(process, true, mostTries, reason, status); !done)
        log(Severity::Error, "{}", done.error().message);
    log(Severity::Warning, "worker {}: {}{}{}", process, reason, hadJob ? ", with job " : "", slot.job);
    mQuickEnds = hadJob || secondsSince(slot.begin) > kQuick ? 0 : mQuickEnds + 1;
    if (mQuickEnds > kMostQuickEnds && !mIsBroken) {
        mIsBroken = true;
        log(Severity::Error, "workers end without a job: see {}", slot.log.string());
    }
    ++mRestarts;
    if (mIsBroken) std::this_thread::sleep_for(std::chrono::seconds(1));
    if (Result<void> done = startWorker(slot); !done) log(Severity::Error, "{}", done.error().message);
}

void Workers::look(Slot& slot) {
    if (!slot.process) return;
    if (const std::optional<tools::ChildEnd> ended = slot.process->poll()) {
        slot.job = mSpool.runningOf(mIds[static_cast<size_t>(&slot - mSlots.data())]);
        end(slot, fmt::format("the renderer ended: {}", ended->text()), kMostTries, 500);
        return;
    }
    noteJob(slot);
    if (!slot.job.empty()) mIsBroken = false;
    if (slot.job.empty() || secondsSince(slot.jobBegin) <= mSettings.mostSeconds) return;
    slot.process->kill();
    end(slot, fmt::format("drawing took longer than {} s", mSettings.mostSeconds), 1, 504);
}

uint64_t Workers::residentBytes() const {
    uint64_t bytes = 0;
    for (std::atomic<long> const& id : mIds) {
        std::ifstream file(fmt::format("/proc/{}/statm", id.load()));
        uint64_t pages = 0, resident = 0;
        if (file >> pages >> resident) bytes += resident * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
    }
    return bytes;
}

} // namespace filament_core::server
