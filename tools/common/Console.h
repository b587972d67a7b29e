// SPDX-License-Identifier: Apache-2.0
/// Console: one line of progress that overwrites itself, and lines that stay. On standard error.
///   Thread  any; lines never interleave.
///   Limits  progress is shown on a terminal only: a log file gets the lines that stay and nothing else.
#pragma once

#include <string_view>

namespace filament::tools {

/// What warnings and errors begin with. Once, before any other call; a string literal.
void setProgramName(std::string_view name);

void showProgress(std::string_view text);
void clearProgress();

/// "PROGRAM: warning: ..."; a line that was printed before is not repeated.
void printWarning(std::string_view text);
/// "PROGRAM: error: ...", on one line whatever `text` holds.
void printError(std::string_view text);

/// The library's own log lines come out as warnings, those below a warning not at all.
void routeLogToConsole();

} // namespace filament::tools
