// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/LoadTask.h"

#include "base/OutOfMemory.h"
#include "base/Result.h"
#include "jobsystem/JobSystem.h"

#include <filament_core/LoadTicket.h>

#include <chrono>
#include <exception>
#include <utility>

namespace filament_core {
namespace {

/// One poll() begins no step after this; a step takes well below a millisecond.
constexpr std::chrono::milliseconds kLongestSlice(4);

} // namespace

namespace engine {

LoadTask::LoadTask(std::string name) : mName(std::move(name)), mStage(LoadStage::Waiting) {}
LoadTask::~LoadTask() = default;

void LoadTask::start(std::shared_ptr<LoadTask> const& task, jobs::JobSystem& jobs) {
    jobs.runBackground<"load">([task] { task->run(); });
}

bool LoadTask::enter(LoadStage stage, LoadStage expected) {
    return mStage.compare_exchange_strong(expected, stage, std::memory_order_acq_rel);
}

void LoadTask::run() noexcept {
    // The stage changes by compare-and-swap: the app may cancel at the same time, and whichever comes first decides.
    if (enter(LoadStage::Decoding, LoadStage::Waiting)) {
        Result<void> worked;
        try {
            worked = work();
        } catch (std::bad_alloc const& cause) {
            worked = outOfMemory("loading", mName, cause);
        } catch (std::exception const& exception) { // of a caller's function
            worked = Error{ ErrorCode::Internal, mName + ": " + exception.what() };
        }
        if (worked)
            enter(LoadStage::Creating, LoadStage::Decoding);
        else if (!mCancellation.isRequested())
            endWith(worked.error());
    }
    const std::scoped_lock lock(mMutex);
    // Even if the load was cancelled before it began: a waiting thread must wake.
    mHasEnded = true;
    mWorkEnded.notify_all();
}

void LoadTask::endWith(Error error) {
    // Before the stage, by which the app's thread learns that there is an error to read.
    mError = std::move(error);
    enter(LoadStage::Failed, LoadStage::Decoding);
}

void LoadTask::setProgress(size_t done, size_t total) {
    mTotal.store(total, std::memory_order_relaxed);
    mDone.store(done, std::memory_order_relaxed);
}

LoadStatus LoadTask::status() const {
    const LoadStage stage = mStage.load(std::memory_order_acquire);
    return { stage, mDone.load(std::memory_order_relaxed), mTotal.load(std::memory_order_relaxed) };
}

LoadStatus LoadTask::poll(size_t sliceBytes) {
    if (mStage.load(std::memory_order_acquire) != LoadStage::Creating) return status();
    try {
        if (createSlice(sliceBytes)) {
            finish();
            mStage.store(LoadStage::Ready, std::memory_order_release);
        } else {
            sendSlice();
        }
    } catch (std::bad_alloc const& cause) {
        drop();
        mError = outOfMemory("loading", mName, cause);
        mStage.store(LoadStage::Failed, std::memory_order_release);
    }
    return status();
}

bool LoadTask::createSlice(size_t sliceBytes) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + kLongestSlice;
    size_t bytes = 0;
    do {
        if (mNextStep < stepCount()) bytes += step(mNextStep++);
        setProgress(mNextStep, stepCount());
    } while (mNextStep < stepCount() && bytes < sliceBytes && Clock::now() < end);
    return mNextStep == stepCount();
}

void LoadTask::cancel() {
    LoadStage stage = mStage.load(std::memory_order_acquire);
    while (stage < LoadStage::Ready) {
        if (!mStage.compare_exchange_weak(stage, LoadStage::Cancelled, std::memory_order_acq_rel)) continue;
        // After the stage: work that ends because of the request finds that it is cancelled, and reports no error.
        mCancellation.request();
        drop();
        return;
    }
}

void LoadTask::abandon() {
    cancel();
    drop();
    enter(LoadStage::Cancelled, LoadStage::Ready);
}

void LoadTask::discard() noexcept {
    cancel();
    drop();
}

void LoadTask::waitForWork() {
    std::unique_lock lock(mMutex);
    mWorkEnded.wait(lock, [&] { return mHasEnded || mStage.load(std::memory_order_acquire) >= LoadStage::Creating; });
}

std::optional<Error> LoadTask::error() const {
    switch (mStage.load(std::memory_order_acquire)) {
    case LoadStage::Ready:
        return {};
    case LoadStage::Failed:
        return mError;
    case LoadStage::Cancelled:
        return filament_core::fail(ErrorCode::Cancelled, "loading '{}' was cancelled, or its engine ended", mName);
    case LoadStage::Waiting:
    case LoadStage::Decoding:
    case LoadStage::Creating:
        break;
    }
    return filament_core::fail(ErrorCode::InvalidArgument,
                               "'{}' is still being loaded; poll() its ticket until isFinished()", mName);
}

void LoadTasks::add(std::shared_ptr<LoadTask> const& task) {
    std::erase_if(mTasks, [](std::weak_ptr<LoadTask> const& known) { return known.expired(); });
    mTasks.push_back(task);
}

void LoadTasks::abandon() {
    for (std::weak_ptr<LoadTask> const& known : std::exchange(mTasks, {})) {
        if (const std::shared_ptr<LoadTask> task = known.lock()) task->abandon();
    }
}

} // namespace engine
} // namespace filament_core
