// SPDX-License-Identifier: Apache-2.0
/// LoadTask: the state of a LoadTicket: work on a background thread, then steps on the engine's thread.
///   Thread  work() runs on a background thread, and touches neither the engine nor what step() made. Everything else
///           belongs to the thread of the engine. Between the two are the stage and the counts, which are atomic,
///           and the decoded data, which the stage Creating hands over.
///   Life    shared by the ticket, the background job and (weakly) the engine. abandon(), cancel() and the end of the
///           ticket free what step() made, so that a task that ends on a background thread holds plain data only.
///   Fails   work() and step() return errors; without memory they throw std::bad_alloc, which becomes one.
#pragma once

#include "jobsystem/Cancellation.h"

#include <filament_core/Result.h>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core {
enum class LoadStage : uint8_t;
struct LoadStatus;

namespace jobs {
class JobSystem;
}

namespace engine {

class LoadTask {
public:
    explicit LoadTask(std::string name);
    virtual ~LoadTask();
    LoadTask(LoadTask const&) = delete;
    LoadTask& operator=(LoadTask const&) = delete;

    /// Queues work().
    static void start(std::shared_ptr<LoadTask> const& task, jobs::JobSystem& jobs);

    LoadStatus status() const;
    LoadStatus poll(size_t sliceBytes);
    void cancel();
    /// The engine ends: cancels, and drops a result that was not taken.
    void abandon();
    /// The ticket ends.
    void discard() noexcept;
    /// Waits for the background thread only.
    void waitForWork();
    /// Of a finished task without a result; nothing if there is a result.
    std::optional<Error> error() const;

protected:
    /// Background thread.
    virtual Result<void> work() = 0;
    /// The number of steps, once work() has succeeded.
    virtual size_t stepCount() const = 0;
    /// Step `index`; returns the bytes that it copied.
    virtual size_t step(size_t index) = 0;
    /// After the last step.
    virtual void finish() = 0;
    /// Destroys everything that step() and finish() created.
    virtual void drop() noexcept = 0;
    /// Between slices: sends what was created to the driver thread if that has nothing else to do.
    virtual void sendSlice() = 0;

    jobs::Cancellation const& cancellation() const { return mCancellation; }
    void setProgress(size_t done, size_t total);

private:
    void run() noexcept;
    /// Steps until the slice is full or 4 ms have passed, one at least. Whether all are done.
    bool createSlice(size_t sliceBytes);
    void endWith(Error error);
    bool enter(LoadStage stage, LoadStage expected);

    std::string mName;
    jobs::Cancellation mCancellation;
    std::atomic<LoadStage> mStage;
    std::atomic<size_t> mDone{ 0 }, mTotal{ 0 };
    std::optional<Error> mError; // written before the stage Failed is entered
    size_t mNextStep = 0;        // owner
    mutable std::mutex mMutex;
    std::condition_variable mWorkEnded;
    bool mHasEnded = false; // by mMutex: work() will not run any more
};

/// The tasks of an engine that may hold objects of it.
class LoadTasks {
public:
    /// Drops finished tasks.
    void add(std::shared_ptr<LoadTask> const& task);
    /// Cancels them and frees what they made: the engine ends.
    void abandon();

private:
    std::vector<std::weak_ptr<LoadTask>> mTasks;
};

} // namespace engine
} // namespace filament_core
