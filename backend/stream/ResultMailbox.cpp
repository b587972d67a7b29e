// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/ResultMailbox.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace filament_core::backend {
namespace {

// Falls back to a message that fits the string's internal buffer if there is no memory for the full one.
std::string copyOf(std::string_view message) {
    try {
        return std::string(message);
    } catch (std::bad_alloc const&) {
        return "out of memory";
    }
}

} // namespace

ResultMailbox::ResultMailbox() {
    // Now, when a failure can still be reported: no later answer or error may need memory for its place.
    mTimers.reserve(kMaxTimers);
    mTimings.reserve(kMaxTimings);
    mErrors.reserve(kMaxErrors);
}

void ResultMailbox::onReadback(Ticket ticket, std::span<const std::byte> bytes) {
    std::vector<std::byte> copy;
    try {
        copy.assign(bytes.begin(), bytes.end()); // outside the lock: it may be large
    } catch (std::bad_alloc const&) {
        onError(DriverErrorKind::OutOfMemory, "a read-back: out of host memory, it has no pixels; free some");
    }
    {
        const std::lock_guard lock(mMutex);
        // Without memory for the pixels, too: the ticket must have an answer, or its waiter would wait for the
        // time-out.
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
        if (mErrors.size() < mErrors.capacity())
            mErrors.push_back({ kind, copyOf(message) });
        else
            ++mDroppedErrors;
    }
    if (kind == DriverErrorKind::DeviceLost) mAnswered.notify_all();
}

void ResultMailbox::onOutOfMemory(const char* doing) noexcept {
    {
        const std::lock_guard lock(mMutex);
        mOutOfMemory = doing;
        mDeviceLost = true;
    }
    mAnswered.notify_all();
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
    if (mReadbacks.contains(ticket)) return Wait::Answered; // an answer that arrived before the loss still counts
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
    if (mErrors.empty() && mDroppedErrors == 0 && !mOutOfMemory) return {};
    std::vector<DriverError> next; // everything that can fail does so before anything is taken
    next.reserve(kMaxErrors);
    mErrors.reserve(mErrors.size() + 2);
    DriverError dropped{ DriverErrorKind::Other, {} }, lost{ DriverErrorKind::DeviceLost, {} };
    if (mDroppedErrors > 0)
        dropped.message = fmt::format("{} more errors were dropped: take them every frame", mDroppedErrors);
    if (mOutOfMemory)
        lost.message = fmt::format("driver thread: out of host memory while {}; the device is lost, make a new engine",
                                   mOutOfMemory);
    for (DriverError* error : { &dropped, &lost }) {
        if (!error->message.empty()) mErrors.push_back(std::move(*error));
    }
    mDroppedErrors = 0;
    mOutOfMemory = nullptr;
    return std::exchange(mErrors, std::move(next));
}

std::vector<FrameTiming> ResultMailbox::takeTimings() {
    const std::lock_guard lock(mMutex);
    std::vector<FrameTiming> timings(mTimings.begin(), mTimings.end()); // a copy, so that mTimings keeps its memory
    mTimings.clear();
    return timings;
}

void ResultMailbox::takeTimings(std::vector<FrameTiming>& into) {
    const std::lock_guard lock(mMutex);
    into.assign(mTimings.begin(), mTimings.end());
    mTimings.clear();
}

bool ResultMailbox::deviceLost() const {
    const std::lock_guard lock(mMutex);
    return mDeviceLost;
}

} // namespace filament_core::backend
