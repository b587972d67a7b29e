// SPDX-License-Identifier: Apache-2.0
/// LatencyLog: how long the last frames took from submit() to the end of their replay, and their distribution.
///   Thread  one at a time.
///   Memory  the last kFrames frames in place; nothing is allocated.
///   Cost    four stores a frame; summary() sorts four columns of 256.
#pragma once

#include "backend/stream/CommandStream.h"

#include <array>
#include <cstdint>

namespace filament_core::backend {

class LatencyLog {
public:
    static constexpr uint32_t kFrames = 256;

    void add(FrameTiming const& timing);
    LatencyStatistics summary() const;

private:
    using Column = std::array<int64_t, kFrames>;
    LatencyDistribution distributionOf(Column const& column) const;

    Column mSubmitToReplay{}, mReplay{}, mSubmitToEnd{}, mBackPressure{}; // rings
    uint64_t mCount = 0;                                                  // ever added
};

} // namespace filament_core::backend
