// SPDX-License-Identifier: Apache-2.0
/// Log: writes lines of text to a sink.
///   Thread  any; lines never interleave.
///   Sink    standard error by default; setLogSink replaces it (tests collect, tools prefix).
///   Fails   if there is no memory for a line, a fixed line about that replaces it.
///   Cost    formats only when the severity is at or above the threshold.
#pragma once

#include <fmt/core.h>

#include <functional>
#include <new>
#include <string_view>

namespace filament_core {

enum class Severity : unsigned char { Debug, Info, Warning, Error };

using LogSink = std::function<void(Severity, std::string_view line)>;

/// Replaces the sink; an empty function restores standard error. Returns the previous sink.
LogSink setLogSink(LogSink sink);

/// Lines below this severity are dropped before they are formatted. Default: Info.
void setLogThreshold(Severity severity);
bool logs(Severity severity);

void logLine(Severity severity, std::string_view line);
/// Writes to standard error, because the sink may be what ran out of memory.
void logLineIsMissing() noexcept;

template <class... Args>
void log(Severity severity, fmt::format_string<Args...> format, Args&&... args) {
    if (!logs(severity)) return;
    try {
        logLine(severity, fmt::vformat(format, fmt::make_format_args(args...)));
    } catch (std::bad_alloc const&) {
        logLineIsMissing();
    }
}

} // namespace filament_core
