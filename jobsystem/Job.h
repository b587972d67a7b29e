// SPDX-License-Identifier: Apache-2.0
/// Job: one call to make, with its captures stored inline; exactly one cache line.
/// Completion: how many jobs of a group have not finished yet, and whether somebody sleeps until none is left.
///   Thread  a Job belongs to one thread at a time; the queues hand it over. Completion: any thread.
///   Memory  captures live in the job (48 bytes); a larger capture does not compile.
///   Fails   a job that throws ends the process.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

namespace filament::jobs {

inline constexpr size_t kCacheLineBytes = 64;
inline constexpr size_t kJobCaptureBytes = 48;

class Completion {
public:
    bool isDone() const { return (mState.load(std::memory_order_acquire) & ~kSlept) == 0; }

    void add() { mState.fetch_add(1, std::memory_order_relaxed); }

    /// True if this was the last job and somebody sleeps. The memory of this object may be gone when it returns.
    bool finishOne() { return mState.fetch_sub(1, std::memory_order_acq_rel) == (kSlept | 1); }

    /// Asks the last job to wake the sleepers. False if there is nothing to wait for any more.
    bool announceSleeper() { return (mState.fetch_or(kSlept, std::memory_order_acq_rel) & ~kSlept) != 0; }

    /// Withdraws the request if everything is done, so that reusing a group does not wake for nothing.
    void forgetSleepers() {
        uint32_t expected = kSlept;
        mState.compare_exchange_strong(expected, 0, std::memory_order_relaxed);
    }

private:
    static constexpr uint32_t kSlept = 1u << 31;
    std::atomic<uint32_t> mState{ 0 }; // jobs left | kSlept
};

struct alignas(kCacheLineBytes) Job {
    void (*call)(Job&) noexcept; ///< runs the captured callable, then destroys it
    Completion* completion;
    alignas(16) std::byte captures[kJobCaptureBytes];

    template <class F>
    void set(F&& function, Completion& done) {
        using Callable = std::decay_t<F>;
        static_assert(sizeof(Callable) <= kJobCaptureBytes,
                      "a job captures at most 48 bytes: capture one reference to a struct");
        static_assert(alignof(Callable) <= 16, "captures of a job are aligned to 16 bytes");
        static_assert(std::is_invocable_v<Callable&>, "a job is called without arguments");
        new (captures) Callable(std::forward<F>(function));
        completion = &done;
        call = [](Job& job) noexcept {
            Callable& callable = *std::launder(reinterpret_cast<Callable*>(job.captures));
            callable();
            callable.~Callable();
        };
    }
};
static_assert(sizeof(Job) == kCacheLineBytes);

} // namespace filament::jobs
