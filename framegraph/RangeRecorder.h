// SPDX-License-Identifier: Apache-2.0
/// RangeRecorder: records a long list of items on the job system, each range into its own command buffer, and joins the
/// buffers in order.
///   In      count, grain, and body(commands, begin, end), which records the items [begin, end).
///   Bits    the ranges depend on count and grain only, and a body does not depend on the bindings of other ranges:
///           the stream has the same commands and payloads for any number of workers, also without parallelism
///           (recordRangesInTurn).
///   Thread  record(): one at a time, the thread that owns the buffer, which takes part. body: any, in parallel.
///   Memory  one buffer per range of the longest list so far. append() swaps blocks, so a steady frame allocates
///           nothing.
///   Fails   std::bad_alloc: `commands` then ends somewhere in the list.
///   Cost    bench/filament_core/passes; joining takes about 50 ns per range. A single range, or no workers: recorded
///           directly into `commands`.
#pragma once

#include "backend/stream/CommandBuffer.h"
#include "base/Assert.h"
#include "jobsystem/JobSystem.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace filament_core::framegraph {

/// The ranges [0, grain), [grain, 2 grain), ... in sequence; the last one ends at `count`.
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
    /// On separate cache lines: different threads write to neighbours.
    struct alignas(64) Lane {
        backend::CommandBuffer commands;
    };

    /// Drops the remains of a failed list, so that they are not joined to the next one.
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

} // namespace filament_core::framegraph
