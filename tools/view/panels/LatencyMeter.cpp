// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/LatencyMeter.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace filament_core::view {
namespace {

void keep(std::deque<double>& history, double value) {
    history.push_back(value);
    if (history.size() > LatencyMeter::kFrames) history.pop_front();
}

} // namespace

Percentiles percentilesOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const auto at = [&](double share) {
        const double rank = std::ceil(share * static_cast<double>(values.size()));
        return values[static_cast<size_t>(std::max(rank, 1.0)) - 1];
    };
    return { static_cast<uint32_t>(values.size()), at(0.5), at(0.95), values.back() };
}

void LatencyMeter::input(double now) {
    if (!mOldestInput) mOldestInput = now;
}

void LatencyMeter::sent(double now) {
    ++mSent;
    mLastSent = now;
    keep(mInFlight, static_cast<double>(framesInFlight()));
    if (mOldestInput) mWaiting.push_back({ mSent, *std::exchange(mOldestInput, std::nullopt) });
}

void LatencyMeter::look(uint64_t presents, double lastPresentSeconds, double now) {
    presents = std::min(presents, mSent);
    if (presents <= mSeen) return;
    mSeen = presents;
    double shown = now;
    if (lastPresentSeconds > 0) {
        mOffset = std::min(mOffset, now - lastPresentSeconds);
        shown = lastPresentSeconds + mOffset;
    }
    for (; !mWaiting.empty() && mWaiting.front().present <= mSeen; mWaiting.pop_front())
        keep(mMilliseconds, std::max(shown - mWaiting.front().inputSeconds, 0.0) * 1e3);
}

void LatencyMeter::reset() {
    mSent = mSeen = 0;
    mOffset = std::numeric_limits<double>::max();
    mWaiting.clear();
}

bool LatencyMeter::isWaiting(double now) const { return mSent > mSeen && now - mLastSent < kLostSeconds; }

} // namespace filament_core::view
