// SPDX-License-Identifier: Apache-2.0
/// ModelSearch: the depth-first search over all choices. At every fork, a run requests a choice; advance() makes the
/// next run differ at the last fork that has choices left.
///   Source  sleep sets: Godefroid 1996, "Partial-Order Methods for the Verification of Concurrent Systems", chapter 5.
///   Thread  one.  Memory: 16 bytes per fork of the current path.  Fails: never.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace filament_core::jobs::model {

class ModelSearch {
public:
    static constexpr int kNobody = -1;

    void beginRun() {
        mDepth = 0;
        mSleepSet = 0;
    }

    /// One of the threads in the bit mask; kNobody if all their next steps have been explored before, in another order.
    int pickThread(uint32_t mask, int preferred) {
        if (mDepth == mNodes.size()) {
            const uint32_t fresh = mask & ~mSleepSet;
            if (fresh == 0) return kNobody;
            const bool stays = preferred >= 0 && (fresh >> preferred & 1);
            const int first = stays ? preferred : std::countr_zero(fresh);
            mNodes.push_back({ true, static_cast<uint32_t>(first), mask, mSleepSet });
        }
        return static_cast<int>(mNodes[mDepth++].choice);
    }

    /// Threads whose next step need not be tried here, because its consequences have been explored; after pickThread().
    uint32_t explored() const { return mNodes[mDepth - 1].done; }
    /// Those of them for which this still applies after the step of the picked thread.
    void setSleepSet(uint32_t mask) { mSleepSet = mask; }

    /// A number below `count`.
    uint32_t pick(uint32_t count) {
        if (count == 1) return 0;
        if (mDepth == mNodes.size()) mNodes.push_back({ false, 0, count, 0 });
        return mNodes[mDepth++].choice;
    }

    /// False if everything has been explored.
    bool advance() {
        while (!mNodes.empty()) {
            Node& node = mNodes.back();
            if (node.isOfThreads) {
                node.done |= 1u << node.choice;
                const uint32_t left = node.ways & ~node.done;
                node.choice = static_cast<uint32_t>(std::countr_zero(left));
                if (left) return true;
            } else if (++node.choice < node.ways) {
                return true;
            }
            mNodes.pop_back();
        }
        return false;
    }

private:
    struct Node {
        bool isOfThreads;
        uint32_t choice;
        uint32_t ways; // threads as a mask, or how many values
        uint32_t done; // threads
    };

    std::vector<Node> mNodes; // from the root to where the search is
    size_t mDepth = 0;        // how far this run has followed them
    uint32_t mSleepSet = 0;
};

} // namespace filament_core::jobs::model
