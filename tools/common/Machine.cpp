// SPDX-License-Identifier: Apache-2.0
#include "tools/common/Machine.h"

#include "generated/Commit.h"

#include <fmt/format.h>

#include <sys/utsname.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string_view>
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

} // namespace filament::tools
