// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/Interrupt.h"

#include "toolkit/program/Console.h"

#include <atomic>
#include <csignal>

namespace filament_core::tools {
namespace {

// Lock-free atomics: the handler may use nothing else.
std::atomic<int> gScopes{ 0 };
std::atomic<bool> gIsInterrupted{ false };
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

extern "C" void onInterrupt(int signal) {
    if (gScopes.load() > 0 && !gIsInterrupted.exchange(true)) return;
    clearProgressInHandler();
    std::signal(signal, SIG_DFL);
    std::raise(signal); // takes effect when the handler returns
}

void watch(int signal) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) return;
    action = {};
    action.sa_handler = &onInterrupt;
    action.sa_flags = SA_RESTART; // a write that is under way must not fail
    sigaction(signal, &action, nullptr);
}

} // namespace

void watchForInterrupts() {
    watch(SIGINT);
    watch(SIGTERM);
}

bool isInterrupted() { return gIsInterrupted.load(); }

StopOnInterrupt::StopOnInterrupt() { ++gScopes; }
StopOnInterrupt::~StopOnInterrupt() { --gScopes; }

} // namespace filament_core::tools
