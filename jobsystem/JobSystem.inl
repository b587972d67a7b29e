// SPDX-License-Identifier: Apache-2.0
/// The templates of JobSystem.h.
#pragma once

namespace filament::jobs {

// The five doors of the scheduler that the templates need; everything else about it stays in Scheduler.h.
namespace detail {
Job* tryAllocate(Scheduler& scheduler); // null: run the job yourself
void submit(Scheduler& scheduler, Job& job);
std::unique_ptr<Job> allocateBackground(Scheduler& scheduler); // null: run the job yourself
void submitBackground(Scheduler& scheduler, std::unique_ptr<Job> job);
Completion& backgroundCompletion(Scheduler& scheduler); // of background jobs without a group
bool isHungry(Scheduler& scheduler);                    // the calling thread has nothing left for thieves

template <class F>
void runBackground(Scheduler& scheduler, Completion& completion, F&& function) {
    std::unique_ptr<Job> job = allocateBackground(scheduler);
    if (!job) {
        function();
        return;
    }
    completion.add();
    job->set(std::forward<F>(function), completion);
    submitBackground(scheduler, std::move(job));
}
} // namespace detail

template <class F>
void JobSystem::runBackground(F&& function) {
    detail::runBackground(*mScheduler, detail::backgroundCompletion(*mScheduler), std::forward<F>(function));
}

template <class F>
void JobGroup::runBackground(F&& function) {
    detail::runBackground(mJobs.scheduler(), mCompletion, std::forward<F>(function));
}

template <class F>
void JobGroup::run(F&& function) {
    Scheduler& scheduler = mJobs.scheduler();
    Job* job = detail::tryAllocate(scheduler);
    if (!job) {
        function();
        return;
    }
    mCompletion.add();
    job->set(std::forward<F>(function), mCompletion);
    detail::submit(scheduler, *job);
}

namespace detail {

template <class Body>
struct ParallelLoop {
    JobSystem& jobs;
    size_t count, grain;
    Body& body;
    JobGroup group;

    void runChunk(size_t chunk) {
        const size_t begin = chunk * grain;
        body(begin, count - begin < grain ? count : begin + grain);
    }

    // Lazy binary splitting (Tzannes, Caragea, Barua, Vishkin 2010): the upper half becomes a job only when this
    // thread has nothing left to steal, so a loop makes a few jobs per worker, not one per chunk.
    void runChunks(size_t first, size_t last) {
        while (last - first > 1) {
            if (isHungry(jobs.scheduler())) {
                const size_t middle = first + (last - first) / 2;
                group.run([this, middle, last] { runChunks(middle, last); });
                last = middle;
            } else {
                runChunk(first++);
            }
        }
        runChunk(first);
    }
};

} // namespace detail

template <class Body>
void parallelFor(JobSystem& jobs, size_t count, size_t grain, Body&& body) {
    FILAMENT_ASSERT(grain > 0, "parallelFor: a range holds at least one index");
    const size_t chunks = count / grain + (count % grain != 0);
    if (chunks == 0) return;
    detail::ParallelLoop<std::remove_reference_t<Body>> loop{ jobs, count, grain, body, JobGroup(jobs) };
    if (jobs.workerCount() == 0 || chunks == 1) {
        for (size_t chunk = 0; chunk < chunks; ++chunk) loop.runChunk(chunk);
        return;
    }
    loop.group.run([&loop, chunks] { loop.runChunks(0, chunks); });
    loop.group.wait();
}

} // namespace filament::jobs
