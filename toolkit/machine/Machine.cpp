// SPDX-License-Identifier: Apache-2.0
#include "toolkit/machine/Machine.h"

#include "generated/Commit.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <sys/utsname.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string_view>
#include <thread>

namespace filament_core::tools {
namespace {

constexpr const char* kUnknown = "unknown";

std::string firstLineOf(const char* path) {
    std::string line;
    std::ifstream file(path);
    return std::getline(file, line) && !line.empty() ? line : kUnknown;
}

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(':');
        if (line.starts_with("model name") && colon + 2 < line.size()) return line.substr(colon + 2);
    }
    return kUnknown;
}

std::string kernel() {
    utsname name{};
    return uname(&name) == 0 ? fmt::format("{} {} {}", name.sysname, name.release, name.machine) : kUnknown;
}

} // namespace

std::string describeMachine() {
    const std::string load = firstLineOf("/proc/loadavg");
    return fmt::format("{}, {} cores, {}, load {}", processor(), std::thread::hardware_concurrency(), kernel(),
                       load.substr(0, load.find(' ')));
}

std::vector<std::pair<std::string, std::string>> machineFacts() {
    return {
        { "cpu", processor() },
        { "cores", fmt::format("{} online", std::thread::hardware_concurrency()) },
        { "smt", firstLineOf("/sys/devices/system/cpu/smt/control") },
        { "governor", firstLineOf("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor") },
        { "turboOff", firstLineOf("/sys/devices/system/cpu/intel_pstate/no_turbo") },
        { "quota", firstLineOf("/sys/fs/cgroup/cpu.max") },
        { "kernel", kernel() },
        { "load", firstLineOf("/proc/loadavg") },
        { "compiler", __VERSION__ },
        { "commit", builtCommit() },
    };
}

std::string today() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))); }

std::string cpuFeatures(bool hasAvx, bool hasFma, const char* override) {
    constexpr std::string_view kWithoutAvx[] = { "nosse", "sse", "sse2", "sse3", "ssse3", "sse4.1" };
    if (override && std::ranges::find(kWithoutAvx, std::string_view(override)) != std::end(kWithoutAvx))
        hasAvx = hasFma = false;
    return fmt::format("{} {}", hasAvx ? "avx" : "no-avx", hasFma ? "fma" : "no-fma");
}

std::string cpuFeatures() {
#if defined(__x86_64__)
    return cpuFeatures(__builtin_cpu_supports("avx") != 0, __builtin_cpu_supports("fma") != 0,
                       std::getenv("GALLIUM_OVERRIDE_CPU_CAPS"));
#else
    return "not x86-64";
#endif
}

std::string builtCommit() { return FILAMENT_COMMIT; }

} // namespace filament_core::tools
