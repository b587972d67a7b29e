// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/ResultMailbox.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace filament::backend {

ResultMailbox::ResultMailbox() {
    mTimers.reserve(kMaxTimers);
    mTimings.reserve(kMaxTimings);
}

void ResultMailbox::onReadback(Ticket ticket, std::span<const std::byte> bytes) {
    std::vector<std::byte> copy(bytes.begin(), bytes.end()); // outside of the lock: it may be large
    {
        const std::lock_guard lock(mMutex);
        mReadbacks.insert_or_assign(ticket, std::move(copy));
    }
    mAnswered.notify_all();
}

void ResultMailbox::onTimer(Ticket ticket, uint64_t nanoseconds) {
    const std::lock_guard lock(mMutex);
    if (mTimers.size() == kMaxTimers) mTimers.erase(mTimers.begin());
    mTimers.push_back({ ticket, nanoseconds });
}

void ResultMailbox::onError(DriverErrorKind kind, std::string_view message) {
    {
        const std::lock_guard lock(mMutex);
        mDeviceLost |= kind == DriverErrorKind::DeviceLost;
        if (mErrors.size() < kMaxErrors)
            mErrors.push_back({ kind, std::string(message) });
        else
            ++mDroppedErrors;
    }
    if (kind == DriverErrorKind::DeviceLost) mAnswered.notify_all();
}

void ResultMailbox::onReplayed(FrameTiming const& timing) {
    const std::lock_guard lock(mMutex);
    if (mTimings.size() == kMaxTimings) mTimings.erase(mTimings.begin());
    mTimings.push_back(timing);
}

void ResultMailbox::onIdle(uint64_t submission) {
    {
        const std::lock_guard lock(mMutex);
        mIdleSubmission = std::max(mIdleSubmission, submission);
    }
    mAnswered.notify_all();
}

std::optional<std::vector<std::byte>> ResultMailbox::takeReadback(Ticket ticket) {
    const std::lock_guard lock(mMutex);
    const auto it = mReadbacks.find(ticket);
    if (it == mReadbacks.end()) return std::nullopt;
    std::optional<std::vector<std::byte>> bytes = std::move(it->second);
    mReadbacks.erase(it);
    return bytes;
}

ResultMailbox::Wait ResultMailbox::waitFor(Ticket ticket, uint64_t submission,
                                           std::chrono::steady_clock::time_point deadline) {
    std::unique_lock lock(mMutex);
    const auto settled = [&] { return mReadbacks.contains(ticket) || mDeviceLost || mIdleSubmission >= submission; };
    if (!mAnswered.wait_until(lock, deadline, settled)) return Wait::TimedOut;
    if (mReadbacks.contains(ticket)) return Wait::Answered; // an answer from before the loss still counts
    return mDeviceLost ? Wait::DeviceLost : Wait::NeverAsked;
}

std::optional<uint64_t> ResultMailbox::takeTimer(Ticket ticket) {
    const std::lock_guard lock(mMutex);
    const auto it = std::ranges::find(mTimers, ticket, &Timer::ticket);
    if (it == mTimers.end()) return std::nullopt;
    const uint64_t nanoseconds = it->nanoseconds;
    mTimers.erase(it);
    return nanoseconds;
}

std::vector<DriverError> ResultMailbox::takeErrors() {
    const std::lock_guard lock(mMutex);
    if (const size_t dropped = std::exchange(mDroppedErrors, 0)) {
        mErrors.push_back(
                { DriverErrorKind::Other, fmt::format("{} more errors were dropped: take them every frame", dropped) });
    }
    return std::exchange(mErrors, {});
}

std::vector<FrameTiming> ResultMailbox::takeTimings() {
    const std::lock_guard lock(mMutex);
    std::vector<FrameTiming> timings(mTimings.begin(), mTimings.end()); // mTimings keeps its memory
    mTimings.clear();
    return timings;
}

bool ResultMailbox::deviceLost() const {
    const std::lock_guard lock(mMutex);
    return mDeviceLost;
}

} // namespace filament::backend
