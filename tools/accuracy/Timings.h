// SPDX-License-Identifier: Apache-2.0
/// timeInTurns: what the values of one effect cost on one backend.
///   Method  round r draws every value once, beginning with another one each round; the ratio to the standard value is
///           taken within a round. The first two rounds warm up and do not count.
///   Thread  one at a time.
///   Fails   what loaders and the device say.
#pragma once

#include "tools/accuracy/Results.h"
#include "tools/accuracy/Studio.h"

#include <functional>

namespace filament::accuracy {

struct TimingJob {
    Studio& studio;
    conformance::SceneSpec const& scene;
    Effect const& effect;
    uint2 size{ 1280, 720 };
    uint32_t rounds = 15;
};

/// As effect.values. `progress`: in [0, 1], after every round.
Result<std::vector<Timing>> timeInTurns(TimingJob const& job, std::function<void(double done)> const& progress);

} // namespace filament::accuracy
