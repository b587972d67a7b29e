// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/FreshStack.h"

#include "base/Assert.h"

#include <pthread.h>

#include <algorithm>

namespace filament::jobs {
namespace {

constexpr size_t kStackBytes = size_t(8) << 20;

// The stack that a job may use between two checks, and the most that nested waits may use. Frames of sanitized code are
// several times as large, and the thread sanitizer records at most 65536 frames per thread.
#if !defined(__has_feature) // gcc has macros instead of __has_feature
#define __has_feature(name) 0
#endif
#if defined(__SANITIZE_THREAD__) || __has_feature(thread_sanitizer)
constexpr size_t kReserveBytes = size_t(1) << 20, kMostBytes = size_t(2) << 20;
#elif defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
constexpr size_t kReserveBytes = size_t(1) << 20, kMostBytes = kStackBytes;
#else
constexpr size_t kReserveBytes = size_t(256) << 10, kMostBytes = kStackBytes;
#endif

struct Call {
    void (*call)(void*);
    void* argument;
    ThreadState caller;
    const char* context;
};

void* runHelper(void* erased) {
    Call& call = *static_cast<Call*>(erased);
    tThread = call.caller;
    tThread.stackFloor = 0;
    tAssertContext = call.context;
    call.call(call.argument);
    return nullptr;
}

} // namespace

void measureStack() {
    pthread_attr_t attributes;
    void* lowest = nullptr;
    size_t bytes = 0;
    tThread.stackFloor = 1; // default if the limits are unknown: the stack is never low
    if (pthread_getattr_np(pthread_self(), &attributes) != 0) return;
    if (pthread_attr_getstack(&attributes, &lowest, &bytes) == 0) {
        const size_t reserve = std::min(kReserveBytes, bytes / 4);
        tThread.stackFloor = reinterpret_cast<uintptr_t>(lowest) + bytes - std::min(bytes - reserve, kMostBytes);
    }
    pthread_attr_destroy(&attributes);
}

void callOnFreshStack(void (*call)(void*), void* argument) {
    Call request{ call, argument, tThread, tAssertContext };
    pthread_attr_t attributes;
    pthread_t helper{};
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, kStackBytes);
    const int error = pthread_create(&helper, &attributes, &runHelper, &request);
    pthread_attr_destroy(&attributes);
    FILAMENT_ASSERT(error == 0, "jobs are nested so deeply that the system refuses a thread for more stack");
    pthread_join(helper, nullptr);
}

} // namespace filament::jobs
