// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/JobSystem.h"

#include "jobsystem/Scheduler.h"

namespace filament::jobs {

JobSystem::JobSystem(JobSystemOptions options) : mScheduler(std::make_unique<Scheduler>(options)) {}
JobSystem::~JobSystem() = default;

uint32_t JobSystem::workerCount() const { return mScheduler->workerCount(); }
uint64_t JobSystem::busyNanoseconds() const { return mScheduler->busyNanoseconds(); }

void JobGroup::wait() { mJobs.scheduler().wait(mCompletion); }

namespace detail {

Job* tryAllocate(Scheduler& scheduler) { return scheduler.tryAllocate(); }
void submit(Scheduler& scheduler, Job& job) { scheduler.submit(job); }

std::unique_ptr<Job> allocateBackground(Scheduler& scheduler) {
    return scheduler.workerCount() == 0 ? nullptr : std::make_unique_for_overwrite<Job>();
}
void submitBackground(Scheduler& scheduler, std::unique_ptr<Job> job) { scheduler.submitBackground(std::move(job)); }
Completion& backgroundCompletion(Scheduler& scheduler) { return scheduler.backgroundCompletion(); }

bool isHungry(Scheduler& scheduler) { return scheduler.isHungry(); }

} // namespace detail
} // namespace filament::jobs
