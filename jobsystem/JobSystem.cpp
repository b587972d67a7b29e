// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/JobSystem.h"

#include "jobsystem/Scheduler.h"

namespace filament_core::jobs {
namespace {

Occupant occupantHere(Scheduler const& scheduler) {
    Seat const* seat = tThread.seatOf(scheduler);
    return seat ? seat->occupant : 0;
}

} // namespace

JobSystem::JobSystem(JobSystemOptions options) : mScheduler(std::make_unique<Scheduler>(options)) {}
JobSystem::~JobSystem() = default;

uint32_t JobSystem::workerCount() const { return mScheduler->workerCount(); }
uint64_t JobSystem::busyNanoseconds() const { return mScheduler->busyNanoseconds(); }
JobTrace* JobSystem::trace() const { return mScheduler->trace(); }

ContentionCounts contentionOf(JobSystem& jobs) { return jobs.scheduler().contention(); }

AdoptedThread::AdoptedThread(Scheduler& scheduler) : mSeat(scheduler.adoptThread()) {}
AdoptedThread::~AdoptedThread() {
    if (mSeat) mSeat->scheduler->releaseThread(*mSeat);
}

JobGroup::JobGroup(JobSystem& jobs) : JobGroup(jobs, tThread.priority) {}
JobGroup::JobGroup(JobSystem& jobs, Priority priority)
        : mScheduler(jobs.scheduler()), mCompletion(occupantHere(mScheduler), priority) {}

void JobGroup::waitInside() { mScheduler.wait(mCompletion); }

} // namespace filament_core::jobs
