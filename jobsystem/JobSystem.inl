// SPDX-License-Identifier: Apache-2.0
/// The templates of JobSystem.h.
#pragma once

namespace filament_core::jobs {

// The scheduler functions that the templates need; the rest of the scheduler is private.
namespace detail {

Job* allocate(Scheduler& scheduler, Priority priority); // null: run the job in place
void submit(Scheduler& scheduler, Job& job);
Job* allocateBackground(Scheduler& scheduler); // null: run the job in place
void submitBackground(Scheduler& scheduler, Job& job);
Completion& backgroundCompletion(Scheduler& scheduler); // for background jobs without a group
void continueWith(Scheduler& scheduler, Completion& before, Job& job);
Seat* seatHere(Scheduler& scheduler);
Priority inheritedPriority();
bool isHungry(Scheduler& scheduler, Seat* seat, Priority priority); // thieves would find no work at the calling thread
// Returns false if memory ran out.
bool runInline(Scheduler& scheduler, const char* name, void (*call)(void*), void* function);
[[noreturn]] void endUnattended(const char* name); // out of memory, and nobody waits for the job

template <JobName kName, class F>
[[nodiscard]] bool runInline(Scheduler& scheduler, F& function) {
    return runInline(
            scheduler, kName.text, [](void* erased) { (*static_cast<F*>(erased))(); },
            const_cast<void*>(static_cast<const void*>(std::addressof(function))));
}

/// Runs a job in place if there is no memory or no worker for it, together with its successors.
template <JobName kName, class F>
void runAtOnce(Scheduler& scheduler, Completion& completion, F&& function) {
    bool isComplete = true;
    if constexpr (std::is_void_v<std::invoke_result_t<F&>>) {
        isComplete = runInline<kName>(scheduler, function);
    } else {
        Job job;
        job.set<kName>(std::forward<F>(function));
        auto run = [&job] {
            do tAssertContext = job.type->name;
            while (job.type->call(job));
        };
        isComplete = runInline<kName>(scheduler, run);
    }
    if (isComplete) return;
    if (&completion == &backgroundCompletion(scheduler)) endUnattended(kName.text);
    completion.markOutOfMemory();
}

template <JobName kName, class F>
void runBackground(Scheduler& scheduler, Completion& completion, F&& function) {
    Job* job = allocateBackground(scheduler);
    if (!job) return runAtOnce<kName>(scheduler, completion, std::forward<F>(function));
    job->set<kName>(std::forward<F>(function));
    job->completion = &completion;
    submitBackground(scheduler, *job);
}

template <class F>
auto unlessCancelled(Cancellation const& cancellation, F&& function) {
    return [&cancellation, function = std::forward<F>(function)]() mutable {
        if (!cancellation.isRequested()) function();
    };
}

} // namespace detail

template <JobName kName, class F>
void JobSystem::runBackground(F&& function) {
    detail::runBackground<kName>(*mScheduler, detail::backgroundCompletion(*mScheduler), std::forward<F>(function));
}

template <JobName kName, class F>
void JobSystem::runBackground(Cancellation const& cancellation, F&& function) {
    runBackground<kName>(detail::unlessCancelled(cancellation, std::forward<F>(function)));
}

template <JobName kName, class F>
void JobGroup::runBackground(F&& function) {
    detail::runBackground<kName>(mScheduler, mCompletion, std::forward<F>(function));
}

template <JobName kName, class F>
void JobGroup::runBackground(Cancellation const& cancellation, F&& function) {
    runBackground<kName>(detail::unlessCancelled(cancellation, std::forward<F>(function)));
}

template <JobName kName, class F>
void JobGroup::run(F&& function) {
    Job* job = detail::allocate(mScheduler, mCompletion.priority());
    if (!job) return detail::runAtOnce<kName>(mScheduler, mCompletion, std::forward<F>(function));
    job->set<kName>(std::forward<F>(function));
    job->completion = &mCompletion;
    detail::submit(mScheduler, *job);
}

template <JobName kName, class F>
void JobGroup::then(JobGroup& next, F&& function) {
    FILAMENT_ASSERT(&next.mScheduler == &mScheduler, "JobGroup::then: both groups are of one system");
    FILAMENT_ASSERT(next.mCompletion.priority() >= mCompletion.priority(),
                    "JobGroup::then: what comes next is not more urgent than what it waits for");
    Job* job = detail::allocate(next.mScheduler, next.mCompletion.priority());
    if (!job) {
        waitForEnd();
        if (mCompletion.isOutOfMemory()) next.mCompletion.markOutOfMemory();
        return detail::runAtOnce<kName>(mScheduler, next.mCompletion, std::forward<F>(function));
    }
    job->set<kName>(std::forward<F>(function));
    job->completion = &next.mCompletion;
    detail::continueWith(mScheduler, mCompletion, *job);
}

namespace detail {

template <JobName kName, class Body>
struct ParallelLoop {
    Scheduler& scheduler;
    size_t count, grain;
    Body& body;
    Priority priority;
    JobGroup group;

    void runChunk(size_t chunk) {
        const size_t begin = chunk * grain;
        body(begin, count - begin < grain ? count : begin + grain);
    }

    void runSerially(size_t chunks) {
        for (size_t chunk = 0; chunk < chunks; ++chunk) runChunk(chunk);
    }

    // Lazy binary splitting (Tzannes, Caragea, Barua, Vishkin 2010): the upper half becomes a job only if this thread
    // has nothing left to steal, so that a loop creates a few jobs per worker, not one per chunk.
    void runChunks(size_t first, size_t last) {
        Seat* seat = seatHere(scheduler);
        while (last - first > 1) {
            if (isHungry(scheduler, seat, priority)) {
                const size_t middle = first + (last - first) / 2;
                group.template run<kName>([this, middle, last] { runChunks(middle, last); });
                last = middle;
            } else {
                runChunk(first++);
            }
        }
        runChunk(first);
    }
};

} // namespace detail

template <JobName kName, class Body>
void parallelFor(JobSystem& jobs, Priority priority, size_t count, size_t grain, Body&& body) {
    FILAMENT_ASSERT(grain > 0, "parallelFor: a range holds at least one index");
    const size_t chunks = count / grain + (count % grain != 0);
    if (chunks == 0) return;
    const AdoptedThread seat(jobs);
    using Loop = detail::ParallelLoop<kName, std::remove_reference_t<Body>>;
    Loop loop{ jobs.scheduler(), count, grain, body, priority, JobGroup(jobs, priority) };
    const bool alone = chunks == 1 || jobs.workerCount() == 0;
    auto run = [&loop, chunks, alone] { alone ? loop.runSerially(chunks) : loop.runChunks(0, chunks); };
    const bool isComplete = detail::runInline<kName>(jobs.scheduler(), run);
    loop.group.wait();
    if (!isComplete) [[unlikely]]
        detail::throwOutOfMemory();
}

template <JobName kName, class Body>
void parallelFor(JobSystem& jobs, size_t count, size_t grain, Body&& body) {
    parallelFor<kName>(jobs, detail::inheritedPriority(), count, grain, std::forward<Body>(body));
}

} // namespace filament_core::jobs
