// SPDX-License-Identifier: Apache-2.0
/// Shared by the storms: many threads that start at the same moment, as often as time allows.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <latch>
#include <thread>
#include <vector>

namespace filament_core::test {

/// `count`, times the environment's FILAMENT_STRESS.
inline int scaled(int count) {
    const char* text = std::getenv("FILAMENT_STRESS");
    return count * std::max(1, text ? std::atoi(text) : 1);
}

/// Runs body(0), body(1), ... on one thread each, all starting at the same moment. Returns when all are done.
inline void onThreads(int count, std::function<void(int)> const& body) {
    std::latch start(count);
    std::vector<std::jthread> threads;
    for (int i = 0; i < count; ++i) {
        threads.emplace_back([&, i] {
            start.arrive_and_wait();
            body(i);
        });
    }
}

} // namespace filament_core::test
