// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Machine.h"

#include "bench/threading/Placement.h"
#include "generated/Commit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sys/utsname.h>

#include <fstream>
#include <thread>

namespace filament::bench {
namespace {

constexpr const char* kUnknown = "unknown";

std::string firstLineOf(const char* path) {
    std::string line;
    std::ifstream file(path);
    return std::getline(file, line) && !line.empty() ? line : kUnknown;
}

std::string cpuModel() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            if (const size_t colon = line.find(':'); colon + 2 < line.size()) return line.substr(colon + 2);
    return kUnknown;
}

std::string kernel() {
    utsname name{};
    return uname(&name) == 0 ? fmt::format("{} {} {}", name.sysname, name.release, name.machine) : kUnknown;
}

} // namespace

std::vector<std::pair<std::string, std::string>> describeMachine() {
    return {
        { "cpu", cpuModel() },
        { "cores",
          fmt::format("{} online, allowed: {}", std::thread::hardware_concurrency(), fmt::join(allowedCores(), ",")) },
        { "smt", firstLineOf("/sys/devices/system/cpu/smt/control") },
        { "governor", firstLineOf("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor") },
        { "turboOff", firstLineOf("/sys/devices/system/cpu/intel_pstate/no_turbo") },
        { "quota", firstLineOf("/sys/fs/cgroup/cpu.max") },
        { "kernel", kernel() },
        { "load", firstLineOf("/proc/loadavg") },
        { "compiler", __VERSION__ },
        { "commit", FILAMENT_COMMIT },
    };
}

} // namespace filament::bench
