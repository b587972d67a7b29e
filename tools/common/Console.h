// SPDX-License-Identifier: Apache-2.0
/// Console: a progress line that overwrites itself, and lines that stay. On standard error.
///   Thread  any; lines never interleave.
///   Limits  progress is shown on a terminal only: a log file receives only the lines that stay.
#pragma once

#include <string_view>

namespace filament::tools {

/// The prefix of warnings and errors. Call once, before any other call, with a string literal.
void setProgramName(std::string_view name);

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

} // namespace filament::tools
