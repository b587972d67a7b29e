// SPDX-License-Identifier: Apache-2.0
/// timeInTurns: the cost of the values of one effect on one backend.
///   Method  each round draws every value once, starting with a different one; ratios to the standard value are formed
///           within a round. The first two rounds are a warm-up and do not count.
///   Thread  one at a time.
///   Fails   errors of the loaders and the device.
#pragma once

#include "tools/accuracy/Results.h"
#include "tools/accuracy/Studio.h"

#include <functional>

namespace filament_core::accuracy {

struct TimingJob {
    Studio& studio;
    tools::SceneSpec const& scene;
    Effect const& effect;
    uint2 size{ 1280, 720 };
    uint32_t rounds = 15;
};

/// In the order of effect.values. `progress`: in [0, 1], called after every round.
Result<std::vector<Timing>> timeInTurns(TimingJob const& job, std::function<void(double done)> const& progress);

} // namespace filament_core::accuracy
