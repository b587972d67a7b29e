// SPDX-License-Identifier: Apache-2.0
#include "tools/common/Machine.h"

#include "generated/Commit.h"

#include <fmt/format.h>

#include <sys/utsname.h>

#include <fstream>
#include <thread>

namespace filament::tools {
namespace {

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(':');
        if (line.starts_with("model name") && colon + 2 < line.size()) return line.substr(colon + 2);
    }
    return "unknown";
}

std::string load() {
    std::string one;
    std::ifstream file("/proc/loadavg");
    return file >> one ? one : "unknown";
}

} // namespace

std::string describeMachine() {
    utsname system{};
    const bool known = uname(&system) == 0;
    return fmt::format("{}, {} cores, {} {}, load {}", processor(), std::thread::hardware_concurrency(),
                       known ? system.sysname : "unknown", known ? system.release : "system", load());
}

std::string builtCommit() { return FILAMENT_COMMIT; }

} // namespace filament::tools
