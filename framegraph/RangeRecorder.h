// SPDX-License-Identifier: Apache-2.0
/// RangeRecorder: records a long list of items on the job system, each range of it into a command buffer of its own,
/// and joins the buffers in order.
///   In      count, grain, and body(commands, begin, end), which records the items [begin, end).
///   Bits    the ranges follow from count and grain alone, and a body knows nothing of what other ranges bound: the
///           stream has the same commands and payloads for any number of workers, also in turn (recordRangesInTurn).
///   Thread  record(): one at a time, the thread whose buffer it is; it works along. body: any, at the same time.
///   Memory  a buffer for each range of the longest list so far. append() swaps blocks, so a steady frame allocates
///           nothing.
///   Fails   std::bad_alloc: `commands` then ends somewhere in the list.
///   Cost    bench/filament_core/passes; joining takes about 50 ns a range. One range, or no workers: straight into
///           `commands`.
#pragma once

#include "backend/stream/CommandBuffer.h"
#include "base/Assert.h"
#include "jobsystem/JobSystem.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace filament::framegraph {

/// The ranges [0, grain), [grain, 2 grain), ... one after the other; the last one ends at `count`.
template <class Body>
void recordRangesInTurn(backend::CommandBuffer& commands, size_t count, size_t grain, Body& body) {
    FILAMENT_ASSERT(grain > 0, "recordRanges: a range holds at least one item");
    for (size_t begin = 0; begin < count; begin += grain) body(commands, begin, std::min(count, begin + grain));
}

class RangeRecorder {
public:
    explicit RangeRecorder(jobs::JobSystem& jobs) : mJobs(jobs) {}

    template <class Body>
    void record(backend::CommandBuffer& commands, size_t count, size_t grain, Body&& body) {
        if (count <= grain || mJobs.workerCount() == 0) {
            recordRangesInTurn(commands, count, grain, body);
            return;
        }
        FILAMENT_ASSERT(grain > 0, "recordRanges: a range holds at least one item");
        const size_t ranges = (count - 1) / grain + 1;
        if (ranges > mLanes.size()) mLanes.resize(ranges);
        const EmptyLanes atEnd{ mLanes };
        jobs::parallelFor<"record">(mJobs, ranges, 1, [&](size_t first, size_t last) {
            for (size_t range = first; range < last; ++range) {
                const size_t begin = range * grain;
                body(mLanes[range].commands, begin, std::min(count, begin + grain));
            }
        });
        for (size_t range = 0; range < ranges; ++range) commands.append(std::move(mLanes[range].commands));
    }

    jobs::JobSystem& jobs() { return mJobs; }

private:
    /// On cache lines of its own: neighbours are written by different threads.
    struct alignas(64) Lane {
        backend::CommandBuffer commands;
    };

    /// What a list that failed leaves behind is not joined to the next one.
    struct EmptyLanes {
        std::vector<Lane>& lanes;
        ~EmptyLanes() {
            for (Lane& lane : lanes) {
                if (lane.commands.commandCount() > 0) lane.commands.reset();
            }
        }
    };

    jobs::JobSystem& mJobs;
    std::vector<Lane> mLanes;
};

} // namespace filament::framegraph
