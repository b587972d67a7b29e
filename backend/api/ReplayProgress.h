// SPDX-License-Identifier: Apache-2.0
/// ReplayProgress: which command a replay is in, for whoever watches it from another thread.
///   In      a WatchedReplay on the replaying thread; without one, replay() publishes to nobody.
///   Out     command(): an address inside the stream, to be compared and not to be followed: the stream may end at any
///           time. Null before, between and after streams.
///   Thread  written by the replaying thread, read by any.
///   Cost    one plain store a command, one look at a thread_local a stream.
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>

namespace filament::backend {

class ReplayProgress {
public:
    const std::byte* command() const { return mCommand.load(std::memory_order_relaxed); }
    void enter(const std::byte* command) { mCommand.store(command, std::memory_order_relaxed); }
    void leave() { mCommand.store(nullptr, std::memory_order_relaxed); }

    /// Where the calling thread's replays publish; null: nowhere.
    static ReplayProgress* ofThisThread() { return tCurrent; }

private:
    friend class WatchedReplay;
    std::atomic<const std::byte*> mCommand{ nullptr };
    static inline constinit thread_local ReplayProgress* tCurrent = nullptr;
};

/// While it lives, replays on this thread publish into `progress`.
class WatchedReplay {
public:
    explicit WatchedReplay(ReplayProgress& progress) : mBefore(std::exchange(ReplayProgress::tCurrent, &progress)) {}
    ~WatchedReplay() { ReplayProgress::tCurrent = mBefore; }
    WatchedReplay(WatchedReplay const&) = delete;
    WatchedReplay& operator=(WatchedReplay const&) = delete;

private:
    ReplayProgress* mBefore;
};

} // namespace filament::backend
