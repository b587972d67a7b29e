// SPDX-License-Identifier: Apache-2.0
/// Console: a progress line that overwrites itself, and lines that stay. On standard error.
///   Thread  any; lines never interleave.
///   Limits  progress overwrites itself on a terminal only. A log receives the lines that stay, and a line of progress
///           every kBetweenProgressLines, so that it tells long work from work that hangs.
#pragma once

#include <chrono>
#include <string_view>

namespace filament_core::tools {

/// The prefix of warnings and errors. Call once, before any other call, with a string literal.
void setProgramName(std::string_view name);

inline constexpr std::chrono::minutes kBetweenProgressLines{ 5 };

/// Which calls of showProgress() a log receives.
class ProgressPace {
public:
    using Clock = std::chrono::steady_clock;
    explicit ProgressPace(Clock::time_point begin) : mLast(begin) {}
    bool isDue(Clock::time_point now);

private:
    Clock::time_point mLast;
};

void showProgress(std::string_view text);
void clearProgress();
/// For signal handlers: takes no lock and only writes to the terminal.
void clearProgressInHandler();

/// "PROGRAM: warning: ..."; a line that was printed before is not repeated.
void printWarning(std::string_view text);
/// "PROGRAM: error: ...", on one line whatever `text` contains.
void printError(std::string_view text);

/// Prints the library's log lines as warnings; lines below a warning are dropped.
void routeLogToConsole();

} // namespace filament_core::tools
