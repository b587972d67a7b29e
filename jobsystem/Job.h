// SPDX-License-Identifier: Apache-2.0
/// Job: one call, with its captures stored inline; exactly one cache line.
/// JobType: what all jobs of one call site share: how to call them, and their name.
///   Thread  a Job belongs to one thread at a time; the queues pass it on. A JobType is a constant.
///   Memory  captures are stored in the job (48 bytes); larger captures do not compile. A name costs nothing at run
///           time.
///   Fails   std::bad_alloc reaches the thread that waits for the job's group. A job that throws anything else ends the
///           process with a message that names it (JobFault.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

namespace filament_core::jobs {

inline constexpr size_t kCacheLineBytes = 64;
inline constexpr size_t kJobCaptureBytes = 48;

struct StdAtomics;
template <class Policy>
class BasicCompletion;
using Completion = BasicCompletion<StdAtomics>;
struct Job;

/// Text as a template argument: run<"skin">(...).
template <size_t kSize>
struct JobName {
    char text[kSize];
    consteval JobName(const char (&literal)[kSize]) { std::copy_n(literal, kSize, text); }
};

enum class Priority : uint8_t {
    FrameCritical, ///< work that the frame waits for: searched first
    Normal,
    Background, ///< long work that no frame waits for: runs on separate threads
};

struct JobType {
    /// Runs the captured callable and destroys it. True: the job now holds its successor; call that too.
    bool (*call)(Job&);
    const char* name;
};

/// Returned by a job to run `function` next, in its place; next<"upload">(...) creates one.
template <JobName kName, class F>
struct Successor {
    F function;
};

template <JobName kName, class F>
Successor<kName, std::decay_t<F>> next(F&& function) {
    return { std::forward<F>(function) };
}

struct alignas(kCacheLineBytes) Job {
    JobType const* type;
    Completion* completion;
    alignas(16) std::byte captures[kJobCaptureBytes];

    template <JobName kName, class F>
    void set(F&& function);
};
static_assert(sizeof(Job) == kCacheLineBytes);

namespace detail {

/// Puts the returned successor in the job's place; false if the job returned none, or an empty optional.
template <JobName kName, class Result>
bool follow(Job& job, Result&& result) {
    if constexpr (std::is_invocable_v<Result&>) {
        job.set<kName>(std::forward<Result>(result));
        return true;
    } else {
        return false;
    }
}

template <JobName, JobName kNext, class F>
bool follow(Job& job, Successor<kNext, F>&& successor) {
    job.set<kNext>(std::move(successor.function));
    return true;
}

template <JobName kName, class Next>
bool follow(Job& job, std::optional<Next>&& successor) {
    return successor && follow<kName>(job, *std::move(successor));
}

/// Destroys a callable, after its call or when the call throws.
template <class Callable>
class Destroyed {
public:
    explicit Destroyed(Callable& callable) : mCallable(&callable) {}
    ~Destroyed() { now(); }
    Destroyed(Destroyed const&) = delete;
    Destroyed& operator=(Destroyed const&) = delete;
    void now() {
        if (Callable* callable = std::exchange(mCallable, nullptr)) callable->~Callable();
    }

private:
    Callable* mCallable;
};

template <class Callable, JobName kName>
bool callAndDestroy(Job& job) {
    Callable& callable = *std::launder(reinterpret_cast<Callable*>(job.captures));
    Destroyed destroyed(callable);
    if constexpr (std::is_void_v<std::invoke_result_t<Callable&>>) {
        callable();
        return false;
    } else {
        auto result = callable();
        destroyed.now(); // the successor reuses its memory
        return follow<kName>(job, std::move(result));
    }
}

template <class Callable, JobName kName>
inline constexpr JobType kJobType{ &callAndDestroy<Callable, kName>, kName.text };

} // namespace detail

template <JobName kName, class F>
void Job::set(F&& function) {
    using Callable = std::decay_t<F>;
    static_assert(sizeof(Callable) <= kJobCaptureBytes,
                  "a job captures at most 48 bytes: capture one reference to a struct");
    static_assert(alignof(Callable) <= 16, "captures of a job are aligned to 16 bytes");
    static_assert(std::is_invocable_v<Callable&>, "a job is called without arguments");
    new (captures) Callable(std::forward<F>(function));
    type = &detail::kJobType<Callable, kName>;
}

} // namespace filament_core::jobs
