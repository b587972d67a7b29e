// SPDX-License-Identifier: Apache-2.0
#include "base/Log.h"

#include <atomic>
#include <cstdio>
#include <mutex>
#include <utility>

namespace filament_core {
namespace {

std::mutex gSinkMutex;
LogSink gSink; // empty: standard error
std::atomic<Severity> gThreshold{ Severity::Info };

const char* prefix(Severity severity) {
    switch (severity) {
    case Severity::Debug:
        return "debug: ";
    case Severity::Info:
        return "";
    case Severity::Warning:
        return "warning: ";
    case Severity::Error:
        return "error: ";
    }
    return "";
}

} // namespace

LogSink setLogSink(LogSink sink) {
    const std::lock_guard lock(gSinkMutex);
    return std::exchange(gSink, std::move(sink));
}

void setLogThreshold(Severity severity) { gThreshold.store(severity, std::memory_order_relaxed); }

bool logs(Severity severity) { return severity >= gThreshold.load(std::memory_order_relaxed); }

void logLine(Severity severity, std::string_view line) {
    const std::lock_guard lock(gSinkMutex);
    if (gSink) {
        gSink(severity, line);
        return;
    }
    std::fprintf(stderr, "%s%.*s\n", prefix(severity), static_cast<int>(line.size()), line.data());
}

void logLineIsMissing() noexcept { std::fputs("error: out of memory, a line of the log is missing\n", stderr); }

} // namespace filament_core
