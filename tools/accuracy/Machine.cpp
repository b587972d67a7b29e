// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Machine.h"

#include "generated/Commit.h"

#include <fmt/chrono.h>

#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <thread>

namespace filament::accuracy {
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

void describeMachine(Results& results) {
    utsname system{};
    const bool known = uname(&system) == 0;
    results.machine = fmt::format("{}, {} cores, {} {}, load {}", processor(), std::thread::hardware_concurrency(),
                                  known ? system.sysname : "unknown", known ? system.release : "system", load());
    results.commit = FILAMENT_COMMIT;
    results.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
}

} // namespace filament::accuracy
