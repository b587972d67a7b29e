// SPDX-License-Identifier: Apache-2.0
#include <filament_core/ResolutionController.h>

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

constexpr uint32_t kSteps = 32; // of the largest scale

/// Both axes of a step at once: a half at kSteps / 2.
float sideOf(uint32_t step) { return 1 - static_cast<float>(step) / static_cast<float>(kSteps); }

/// The last step that no axis leaves its range by.
uint32_t lastStep(Resolution const& options) {
    const float2 leasts = min(options.leastScale / options.scale, 1.0f);
    // Axes that are not uniform shrink one after the other, each to its least.
    const float least = options.uniform ? std::max(leasts.x, leasts.y) : std::sqrt(leasts.x * leasts.y);
    return static_cast<uint32_t>((1 - least) * kSteps + 1e-4f);
}

float2 scaleOf(Resolution const& options, uint32_t step) {
    const float side = sideOf(std::min(step, lastStep(options)));
    if (options.uniform) return options.scale * side;
    const float area = side * side;
    const float x = std::max(area, std::min(options.leastScale / options.scale.x, 1.0f));
    return options.scale * float2(x, area / x);
}

} // namespace

float2 ResolutionController::scale(Resolution const& options) const {
    return options.dynamic ? scaleOf(options, mStep) : options.scale;
}

double ResolutionController::median(uint32_t count) const {
    std::array<double, kMostFrames> sorted = mTimes;
    const auto middle = sorted.begin() + count / 2;
    std::nth_element(sorted.begin(), middle, sorted.begin() + count);
    return *middle;
}

void ResolutionController::add(Resolution const& options, FrameCost const& cost) {
    if (!options.dynamic || !(cost.milliseconds > 0) || cost.scale != scale(options)) return;
    const uint32_t last = lastStep(options);
    mStep = std::min(mStep, last);
    const uint32_t wanted = std::clamp(uint32_t{ options.history }, 1u, kMostFrames);
    if (mCount >= wanted) { // the oldest go
        std::copy(mTimes.begin() + (mCount - wanted + 1), mTimes.begin() + mCount, mTimes.begin());
        mCount = wanted - 1;
    }
    mTimes[mCount++] = cost.milliseconds;
    if (mCount < wanted) return;

    const double now = median(mCount), side = double(sideOf(mStep));
    const double target = double(options.targetMilliseconds), free = target * (1 - double(options.headroom));
    const auto fits = [&](uint32_t step) {
        const double share = double(sideOf(step)) / side;
        return now * share * share <= free;
    };
    uint32_t step = mStep;
    if (now > target) {
        while (step < last && !fits(step)) ++step;
    } else {
        while (step > 0 && fits(step - 1)) --step;
    }
    if (step == mStep) return;
    mStep = step;
    mCount = 0; // what frames of another size took says nothing
}

} // namespace filament_core
