// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/FutexSleeper.h"

#include "bench/threading/Clock.h"
#include "bench/threading/Placement.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <optional>

namespace filament_core::bench {
namespace {

void sleepWhile(std::atomic<uint32_t>& word, uint32_t value) {
    syscall(SYS_futex, &word, FUTEX_WAIT_PRIVATE, value, nullptr, nullptr, 0);
}

void wakeOne(std::atomic<uint32_t>& word) {
    word.fetch_add(1, std::memory_order_seq_cst);
    syscall(SYS_futex, &word, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

} // namespace

FutexSleeper::FutexSleeper(bool pinned) : mThread(&FutexSleeper::sleepAndAnswer, this, pinned) {}

FutexSleeper::~FutexSleeper() {
    mStopping.store(true);
    wakeOne(mWord);
    mThread.join();
}

void FutexSleeper::sleepAndAnswer(bool pinned) {
    std::optional<PinnedScope> pin;
    if (pinned) pin.emplace(coreOfThread(1));
    uint32_t seen = 0;
    while (!mStopping.load()) {
        sleepWhile(mWord, seen);
        const uint32_t value = mWord.load();
        if (value == seen) continue; // spurious wake-up
        seen = value;
        mAwake.store(wallNow());
    }
}

int64_t FutexSleeper::wakeUp(int64_t idle) {
    mAwake.store(0);
    spinFor(idle);
    const int64_t start = wallNow();
    wakeOne(mWord);
    int64_t awake = 0;
    while ((awake = mAwake.load()) == 0) {
    }
    return awake - start;
}

} // namespace filament_core::bench
