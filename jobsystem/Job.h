// SPDX-License-Identifier: Apache-2.0
/// Job: one call to make, with its captures stored inline; exactly one cache line.
/// JobType: what all jobs of one call site have in common: how to call them, and their name.
///   Thread  a Job belongs to one thread at a time; the queues hand it over. A JobType is a constant.
///   Memory  captures live in the job (48 bytes); a larger capture does not compile. A name costs nothing at run time.
///   Fails   a job that throws ends the process with a message that names it (JobFault.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

namespace filament::jobs {

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
    FrameCritical, ///< what the frame waits for: searched first
    Normal,
    Background, ///< long work that no frame waits for: on threads of its own
};

struct JobType {
    void (*call)(Job&); ///< runs the captured callable, then destroys it
    const char* name;
};

struct alignas(kCacheLineBytes) Job {
    JobType const* type;
    Completion* completion;
    alignas(16) std::byte captures[kJobCaptureBytes];

    template <JobName kName, class F>
    void set(F&& function, Completion& done);
};
static_assert(sizeof(Job) == kCacheLineBytes);

namespace detail {

template <class Callable>
void callAndDestroy(Job& job) {
    Callable& callable = *std::launder(reinterpret_cast<Callable*>(job.captures));
    callable();
    callable.~Callable();
}

template <class Callable, JobName kName>
inline constexpr JobType kJobType{ &callAndDestroy<Callable>, kName.text };

} // namespace detail

template <JobName kName, class F>
void Job::set(F&& function, Completion& done) {
    using Callable = std::decay_t<F>;
    static_assert(sizeof(Callable) <= kJobCaptureBytes,
                  "a job captures at most 48 bytes: capture one reference to a struct");
    static_assert(alignof(Callable) <= 16, "captures of a job are aligned to 16 bytes");
    static_assert(std::is_invocable_v<Callable&>, "a job is called without arguments");
    new (captures) Callable(std::forward<F>(function));
    completion = &done;
    type = &detail::kJobType<Callable, kName>;
}

} // namespace filament::jobs
