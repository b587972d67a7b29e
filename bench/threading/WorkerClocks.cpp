// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/WorkerClocks.h"

#include "bench/threading/Clock.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <string>

namespace filament_core::bench {
namespace {

/// The clock that pthread_getcpuclockid() returns for a thread, from its number in /proc. Linux,
/// include/linux/posix-timers_types.h: the inverted number above three bits, per thread (4) and scheduler time (2).
clockid_t cpuClockOf(pid_t thread) { return static_cast<clockid_t>((~static_cast<unsigned>(thread) << 3) | 4 | 2); }

} // namespace

std::vector<pid_t> threadsNamed(std::string_view wanted) {
    std::vector<pid_t> threads;
    std::error_code error;
    for (std::filesystem::directory_iterator at("/proc/self/task", error), end; !error && at != end;
         at.increment(error)) {
        std::string name;
        std::getline(std::ifstream(at->path() / "comm"), name);
        if (name != wanted) continue;
        const std::string number = at->path().filename().string();
        pid_t thread = 0;
        if (std::from_chars(number.data(), number.data() + number.size(), thread).ec == std::errc())
            threads.push_back(thread);
    }
    return threads;
}

int64_t cpuNanosecondsOf(std::vector<pid_t> const& threads) {
    int64_t sum = 0;
    for (const pid_t thread : threads) sum += nanosecondsOf(cpuClockOf(thread));
    return sum;
}

} // namespace filament_core::bench
