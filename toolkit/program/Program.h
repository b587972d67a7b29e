// SPDX-License-Identifier: Apache-2.0
/// Program: the common part of main() of every tool.
///   Out     the exit status: that of the job; 0 after the help text; 1 after one line on standard error that says what
///           failed, including running out of memory and a standard output that is full.
///   Thread  the main thread.
#pragma once

#include "base/Result.h"
#include "toolkit/program/Console.h"
#include "toolkit/program/Interrupt.h"
#include "toolkit/program/StandardOutput.h"

#include <exception>
#include <string_view>

namespace filament_core::tools {

/// Prints the error and returns the exit status.
inline int failed(Error const& error) {
    printError(error.message);
    return 1;
}

/// parse(argc, argv) returns Result<std::optional<Options>>, empty after the help text; run(options) returns the exit
/// status.
/// `name`: a string literal. `cure`: advice for running out of memory.
template <class Parse, class Run>
int runProgram(std::string_view name, int argc, const char* const* argv, Parse&& parse, Run&& run,
               std::string_view cure = {}) {
    setProgramName(name);
    watchForInterrupts();
    routeLogToConsole();
    try {
        const auto options = parse(argc, argv);
        if (!options) return failed(options.error());
        const int status = *options ? run(**options) : 0;
        const Result<void> printed = finishOutput();
        return printed ? status : failed(printed.error());
    } catch (std::exception const& error) {
        printError(fmt::format("out of resources ({}){}{}", error.what(), cure.empty() ? "" : "; ", cure));
        return 1;
    }
}

} // namespace filament_core::tools
