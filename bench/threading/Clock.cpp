// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Clock.h"

#include <chrono>
#include <thread>

namespace filament_core::bench {

void settle() {
    constexpr int kMostMilliseconds = 100;
    constexpr int64_t kQuietNanoseconds =
            100'000; // of CPU time in a millisecond: a spinning thread takes ten times that
    for (int i = 0; i < kMostMilliseconds; ++i) {
        const int64_t before = nanosecondsOf(CLOCK_PROCESS_CPUTIME_ID);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (nanosecondsOf(CLOCK_PROCESS_CPUTIME_ID) - before < kQuietNanoseconds) return;
    }
}

} // namespace filament_core::bench
