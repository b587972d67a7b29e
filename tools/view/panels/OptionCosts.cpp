// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/OptionCosts.h"

#include "base/Statistics.h"

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

constexpr size_t kFewestFrames = 4;

QualityCost const* costOfValue(QualityEffect const& effect, std::string_view value) {
    const auto found = std::ranges::find(effect.values, value, &QualityCost::value);
    return found == effect.values.end() ? nullptr : &*found;
}

} // namespace

std::optional<ValueCost> tabledCost(QualityCosts const& costs, Backend backend, std::string_view option,
                                    std::string_view current, std::string_view value, double frameMilliseconds) {
    const auto effect = std::ranges::find(costs.effects, option, &QualityEffect::name);
    if (effect == costs.effects.end()) return std::nullopt;
    QualityCost const* now = costOfValue(*effect, current);
    QualityCost const* then = costOfValue(*effect, value);
    if (!now || !then || !(now->on(backend).milliseconds > 0)) return std::nullopt;
    const double ratio = then->on(backend).milliseconds / now->on(backend).milliseconds;
    return ValueCost{ .milliseconds = frameMilliseconds * (ratio - 1), .error = then->error };
}

void ChangeMeter::frame(double milliseconds) {
    if (!std::isfinite(milliseconds) || milliseconds <= 0) return;
    if (mPending && mPending->skipped < kSkipped) {
        ++mPending->skipped;
        return;
    }
    if (mFrames.size() == kFrames) mFrames.erase(mFrames.begin());
    mFrames.push_back(milliseconds);
    if (mPending && mFrames.size() == kFrames) finish();
}

void ChangeMeter::changed(std::string_view option, std::string_view from, std::string_view to) {
    Pending pending{ .change = { .option = std::string(option), .from = std::string(from), .to = std::string(to) } };
    const bool isSettled = !mPending || mPending->change.option == option; // a slider that is being dragged
    if (mPending && isSettled) {
        pending.change.from = mPending->change.from;
        pending.before = mPending->before;
    } else if (isSettled) {
        pending.before = medianMilliseconds();
    }
    mFrames.clear();
    mPending = std::move(pending);
}

void ChangeMeter::finish() {
    MeasuredChange change = std::move(mPending->change);
    const std::optional<double> before = mPending->before;
    mPending.reset();
    if (!before) return;
    change.milliseconds = median(mFrames) - *before;
    change.frames = mFrames.size();
    std::erase_if(mChanges, [&](MeasuredChange const& old) { return old.option == change.option; });
    mChanges.push_back(std::move(change));
}

MeasuredChange const* ChangeMeter::changeOf(std::string_view option) const {
    const auto found = std::ranges::find(mChanges, option, &MeasuredChange::option);
    return found == mChanges.end() ? nullptr : &*found;
}

std::optional<double> ChangeMeter::medianMilliseconds() const {
    return mFrames.size() < kFewestFrames ? std::nullopt : std::optional(median(mFrames));
}

} // namespace filament_core::view
