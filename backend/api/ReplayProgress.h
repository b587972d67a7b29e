// SPDX-License-Identifier: Apache-2.0
/// ReplayProgress: the command that a replay is in, for observers on other threads.
///   In      a WatchedReplay on the replaying thread; without one, replay() publishes nothing.
///   Out     command(): an address inside the stream. Compare it, but do not dereference it: the stream may end at any
///           time. Null before, between and after streams.
///   Thread  written by the replaying thread, read by any.
///   Cost    one plain store per command, one thread_local read per stream.
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>

namespace filament_core::backend {

class ReplayProgress {
public:
    const std::byte* command() const { return mCommand.load(std::memory_order_relaxed); }
    void enter(const std::byte* command) { mCommand.store(command, std::memory_order_relaxed); }
    void leave() { mCommand.store(nullptr, std::memory_order_relaxed); }

    /// The target of the calling thread's replays; null: none.
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

} // namespace filament_core::backend
