// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/Console.h"

#include "base/Log.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <set>
#include <string>
#include <unistd.h>

namespace filament_core::tools {
namespace {

std::mutex gMutex;
std::atomic<bool> gProgressShown = false;
std::string_view gProgram = "filament";
ProgressPace gPace{ ProgressPace::Clock::now() };

void clearProgressLocked() {
    if (!gProgressShown) return;
    std::fputs("\r\x1b[K", stderr);
    std::fflush(stderr);
    gProgressShown = false;
}

std::string oneLine(std::string_view text) {
    std::string line(text);
    std::replace_if(
            line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return line;
}

} // namespace

void setProgramName(std::string_view name) { gProgram = name; }

bool ProgressPace::isDue(Clock::time_point now) {
    if (now - mLast < kBetweenProgressLines) return false;
    mLast = now;
    return true;
}

void showProgress(std::string_view text) {
    static const bool sTerminal = ::isatty(STDERR_FILENO) == 1;
    const std::lock_guard lock(gMutex);
    if (!sTerminal) {
        if (gPace.isDue(ProgressPace::Clock::now()))
            std::fprintf(stderr, "%s: %s\n", gProgram.data(), oneLine(text).c_str());
        return;
    }
    std::fprintf(stderr, "\r\x1b[K%s", oneLine(text).c_str());
    std::fflush(stderr);
    gProgressShown = true;
}

void clearProgress() {
    const std::lock_guard lock(gMutex);
    clearProgressLocked();
}

void clearProgressInHandler() {
    constexpr std::string_view kClear = "\r\x1b[K";
    if (!gProgressShown) return;
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kClear.data(), kClear.size());
}

void printWarning(std::string_view text) {
    static std::set<std::string, std::less<>> sPrinted;
    const std::lock_guard lock(gMutex);
    const std::string line = oneLine(text);
    if (!sPrinted.insert(line).second) return;
    clearProgressLocked();
    std::fprintf(stderr, "%s: warning: %s\n", gProgram.data(), line.c_str());
}

void printError(std::string_view text) {
    const std::lock_guard lock(gMutex);
    clearProgressLocked();
    std::fprintf(stderr, "%s: error: %s\n", gProgram.data(), oneLine(text).c_str());
}

void routeLogToConsole() {
    setLogThreshold(Severity::Warning);
    setLogSink([](Severity, std::string_view line) { printWarning(line); });
}

} // namespace filament_core::tools
