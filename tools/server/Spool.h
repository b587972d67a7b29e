// SPDX-License-Identifier: Apache-2.0
/// Spool: a queue of jobs as a folder, which survives the processes that use it.
///   Folder    new/      being written
///             queued/   NAME.TRIES.json: accepted; names sort by time of arrival
///             running/  NAME.TRIES.PROCESS.json: claimed by that process
///             done/     NAME.json: the outcome; NAME.image: the picture
///   Moves     by rename() in one file system: a job is in one state at a time, whichever process ends when. What is
///             accepted is on the disk (fdatasync) before accept() returns.
///   Names     letters, digits, - and _, at most 64: of the client, so that a repeated request is the same job, or made
///             here.
///   Thread    any; any number of processes. Limits: listing reads the folder, which `mostQueued` keeps small.
///   Fails     Unreadable with the path and the system's reason; InvalidArgument for a name.
#pragma once

#include "base/Result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::server {

enum class JobState : uint8_t { Unknown, Queued, Running, Done };

struct ClaimedJob {
    std::string name;
    std::string request;        ///< JSON
    uint32_t tries = 0;         ///< how often a process has ended while it had this job
    std::filesystem::path file; ///< in running/
};

/// What became of a job, as done/NAME.json says it.
struct JobOutcome {
    int status = 200;        ///< of HTTP: 200, 400 (the request is wrong), 500 (the engine), 504 (too late)
    std::string error;       ///< one line; empty: there is an image
    std::string contentType; ///< of the image
    double queuedSeconds = 0, renderSeconds = 0;
};

enum class Accepted : uint8_t { New, Known, Full };

class Spool {
public:
    /// Makes the folders.
    static Result<Spool> open(std::filesystem::path const& folder, uint32_t mostQueued);

    static bool isName(std::string_view name);
    static std::string makeName(); ///< later ones sort behind earlier ones

    /// Known: a job of that name is there already, in any state; nothing changes.
    Result<Accepted> accept(std::string const& name, std::string_view request);
    JobState state(std::string const& name) const;
    /// The oldest one that no other process claims first; nothing: none is queued.
    Result<std::optional<ClaimedJob>> claim();
    /// Where the image of a claimed job is written, before finish() moves it.
    std::filesystem::path imageDraft(ClaimedJob const& job) const;
    /// Unless the outcome is an error, imageDraft() is there.
    Result<void> finish(ClaimedJob const& job, JobOutcome const& outcome);
    std::optional<JobOutcome> outcome(std::string const& name) const;
    std::filesystem::path imageFile(std::string const& name) const;
    /// What a process that has ended had claimed goes back to the queue, or ends with an error if processes have ended
    /// with it `mostTries` times. `isToBlame`: the job may be why it ended.
    Result<void> release(long process, bool isToBlame, uint32_t mostTries, std::string const& reason, int status);
    /// The same for every process: when none is there.
    Result<void> releaseAll();
    /// The job that a process has claimed; empty: none.
    std::string runningOf(long process) const;
    /// Of done or queued jobs; false: there is none, or it is being drawn.
    bool remove(std::string const& name);
    /// All but the newest outcomes.
    void keepNewest(size_t outcomes);

    uint32_t queuedCount() const;
    uint32_t runningCount() const;
    std::filesystem::path const& queuedFolder() const { return mQueued; }
    std::filesystem::path const& doneFolder() const { return mDone; }

private:
    Spool(std::filesystem::path const& folder, uint32_t mostQueued);
    Result<void> putImage(ClaimedJob const& job) const;
    Result<void> write(std::filesystem::path const& to, std::span<const std::byte> bytes) const;

    std::filesystem::path mNew, mQueued, mRunning, mDone;
    uint32_t mMostQueued = 0;
};

} // namespace filament_core::server
