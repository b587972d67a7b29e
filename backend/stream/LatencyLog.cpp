// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/LatencyLog.h"

#include <algorithm>

namespace filament_core::backend {

void LatencyLog::add(FrameTiming const& timing) {
    const auto at = static_cast<size_t>(mCount++ % kFrames);
    mSubmitToReplay[at] = timing.replayBegin - timing.submitted;
    mReplay[at] = timing.replayEnd - timing.replayBegin;
    mSubmitToEnd[at] = timing.replayEnd - timing.submitted;
    mBackPressure[at] = timing.backPressure;
}

LatencyStatistics LatencyLog::summary() const {
    return { .frames = static_cast<uint32_t>(std::min<uint64_t>(mCount, kFrames)),
             .submitToReplay = distributionOf(mSubmitToReplay),
             .replay = distributionOf(mReplay),
             .submitToEnd = distributionOf(mSubmitToEnd),
             .backPressure = distributionOf(mBackPressure) };
}

LatencyDistribution LatencyLog::distributionOf(Column const& column) const {
    const auto count = static_cast<size_t>(std::min<uint64_t>(mCount, kFrames));
    if (count == 0) return {};
    Column sorted = column;
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
    // Nearest rank: the smallest value that at least `percent` of the frames do not exceed.
    const auto quantile = [&](size_t percent) { return sorted[(count * percent + 99) / 100 - 1]; };
    return { .min = sorted[0], .median = quantile(50), .p99 = quantile(99), .max = sorted[count - 1] };
}

} // namespace filament_core::backend
