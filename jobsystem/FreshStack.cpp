// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/FreshStack.h"

#include "base/Assert.h"

#include <pthread.h>
#include <sys/mman.h>
#include <ucontext.h>

#include <algorithm>
#include <utility>

namespace filament_core::jobs {
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

void runMapped(uint32_t high, uint32_t low) { // makecontext() passes ints only
    Call& call = *reinterpret_cast<Call*>(uintptr_t(high) << 32 | low);
    call.call(call.argument);
}

/// Where the system refuses a thread: the same thread on other memory. Sanitizers and debuggers may lose track of it.
bool callOnMappedStack(Call& request) {
    void* const stack =
            mmap(nullptr, kStackBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
    if (stack == MAP_FAILED) return false;
    ucontext_t here{}, there{};
    getcontext(&there);
    there.uc_stack.ss_sp = stack;
    there.uc_stack.ss_size = kStackBytes;
    there.uc_link = &here;
    const auto address = reinterpret_cast<uintptr_t>(&request);
    makecontext(&there, reinterpret_cast<void (*)()>(&runMapped), 2, static_cast<uint32_t>(address >> 32),
                static_cast<uint32_t>(address));
    const uintptr_t floor = std::exchange(tThread.stackFloor, reinterpret_cast<uintptr_t>(stack) + kReserveBytes);
    swapcontext(&here, &there);
    tThread.stackFloor = floor;
    munmap(stack, kStackBytes);
    return true;
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
    if (error == 0) {
        pthread_join(helper, nullptr);
        return;
    }
    const bool done = callOnMappedStack(request);
    FILAMENT_ASSERT(done, "jobs are nested so deeply that the system refuses memory for more stack");
}

} // namespace filament_core::jobs
