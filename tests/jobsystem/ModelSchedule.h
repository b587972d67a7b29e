// SPDX-License-Identifier: Apache-2.0
/// ModelSchedule: random choices instead of all of them, for more threads than ModelSearch can go through.
///   How     runs take turns. One half are walks in which every ready thread is as likely as any other: all advance
///           about as fast, as on as many cores. The other half are probabilistic concurrency tests (PCT): the ready
///           thread of the highest priority runs; priorities are random, and at `depth` - 1 random steps, and where it
///           yields, the running thread falls below all others. One of n threads and k steps finds an error that needs
///           d ordered steps with a chance of at least 1 / (n k^(d-1)).
///   Source  Burckhardt, Kothari, Musuvathi and Nagarakatte 2010, "A randomized scheduler with probabilistic guarantees
///           of finding bugs", section 3. Stores: three loads of four read the last one, the others any they may (Gao,
///           Chakraborty and Ozkan 2023, "Probabilistic concurrency testing for weak memory programs", bound how many
///           loads are stale; here it is a chance).
///   Thread  one.  Fails: never; the same seed gives the same runs.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

namespace filament_core::jobs::model {

class ModelSchedule {
public:
    explicit ModelSchedule(uint64_t seed) : mRandom(seed) {}

    /// Run number `run` of `threads` threads.
    void beginRun(uint64_t run, int threads) {
        mLongest = std::max(mLongest, mStep);
        mStep = 0;
        mWalks = run % 2 == 0;
        if (mWalks) return;
        const auto depth = static_cast<int>(2 + run / 2 % 4);
        mPriorities.resize(static_cast<size_t>(threads));
        for (int i = 0; i < threads; ++i) mPriorities[static_cast<size_t>(i)] = depth + i;
        std::shuffle(mPriorities.begin(), mPriorities.end(), mRandom);
        mLeast = 0;
        mChanges.clear();
        for (int i = 1; i < depth; ++i) mChanges.push_back({ below(mLongest), i });
    }

    /// One of the threads in the bit mask, which is not 0.
    int pickThread(uint32_t ready) {
        const uint32_t step = mStep++;
        if (mWalks) return anyOf(ready);
        const int picked = mostUrgentOf(ready);
        for (Change const& change : mChanges) {
            if (change.step == step) mPriorities[static_cast<size_t>(picked)] = change.priority;
        }
        return mostUrgentOf(ready);
    }

    /// The thread waits for others: it falls below all of them.
    void yield(int thread) {
        if (!mWalks) mPriorities[static_cast<size_t>(thread)] = --mLeast;
    }

    /// The store to read, newest first.
    uint32_t pickStore(uint32_t count) { return count == 1 || below(4) != 0 ? 0 : below(count); }
    uint32_t pick(uint32_t count) { return count == 1 ? 0 : below(count); }

private:
    struct Change {
        uint32_t step;
        int priority;
    };

    uint32_t below(uint32_t count) { return static_cast<uint32_t>(mRandom() % count); }

    int anyOf(uint32_t ready) {
        for (uint32_t skip = below(static_cast<uint32_t>(std::popcount(ready))); skip > 0; --skip) ready &= ready - 1;
        return std::countr_zero(ready);
    }

    int mostUrgentOf(uint32_t ready) const {
        int best = std::countr_zero(ready);
        for (uint32_t left = ready; left != 0; left &= left - 1) {
            const int thread = std::countr_zero(left);
            if (mPriorities[static_cast<size_t>(thread)] > mPriorities[static_cast<size_t>(best)]) best = thread;
        }
        return best;
    }

    std::mt19937_64 mRandom;
    bool mWalks = true;
    std::vector<int> mPriorities; // by thread
    int mLeast = 0;
    std::vector<Change> mChanges;
    uint32_t mStep = 0, mLongest = 100; // of all runs so far
};

} // namespace filament_core::jobs::model
