// SPDX-License-Identifier: Apache-2.0
/// Interrupt: Ctrl-C (SIGINT) and SIGTERM end a program tidily.
///   Long work that can stop between two steps opens a StopOnInterrupt and asks isInterrupted(): the first signal only
///   sets that flag, so that what is done can be written and reported. The second one, and every signal outside of such
///   a scope, clears the progress line and ends the process by that signal, as its parent expects.
///   Thread  watchForInterrupts() and scopes: the main thread. isInterrupted(): any.
///   Limits  signals that the parent told this process to ignore (nohup) stay ignored.
#pragma once

namespace filament_core::tools {

/// The exit status of work that stopped early, as of shells: 128 + SIGINT.
inline constexpr int kInterruptedStatus = 130;

/// Installs the handlers; runProgram() calls it.
void watchForInterrupts();

bool isInterrupted();

class StopOnInterrupt {
public:
    StopOnInterrupt();
    ~StopOnInterrupt();
    StopOnInterrupt(StopOnInterrupt const&) = delete;
    StopOnInterrupt& operator=(StopOnInterrupt const&) = delete;
};

} // namespace filament_core::tools
