// SPDX-License-Identifier: Apache-2.0
/// ResultMailbox: where the driver leaves results and any thread picks them up.
///   Thread  any; one short lock per call. The on...() functions are called on the driver thread.
///   Memory  read-backs wait until they are taken. Timers, frame timings and errors are bounded: if they are not taken,
///           the oldest timers and timings and the newest errors are dropped (the number of dropped errors is
///           reported).
///   Fails   never for lack of memory: a read-back then has no bytes, and an error fewer words.
///   Cost    a read-back is one vector and one copy; the rest allocates nothing after the first frames.
#pragma once

#include "backend/api/Driver.h"
#include "backend/stream/CommandStream.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

namespace filament_core::backend {

class ResultMailbox final : public ResultSink {
public:
    static constexpr size_t kMaxTimers = 1024;
    static constexpr size_t kMaxTimings = 256;
    static constexpr size_t kMaxErrors = 256;

    ResultMailbox();

    void onReadback(Ticket ticket, std::span<const std::byte> bytes) override;
    void onTimer(Ticket ticket, uint64_t nanoseconds) override;
    void onError(DriverErrorKind kind, std::string_view message) override;
    /// The driver ran out of host memory in `doing` (a literal) and cannot continue: the device counts as lost.
    void onOutOfMemory(const char* doing) noexcept;
    void onReplayed(FrameTiming const& timing);
    /// The driver has finished everything up to this submission: wakes threads whose results will never come.
    void onIdle(uint64_t submission);

    std::optional<std::vector<std::byte>> takeReadback(Ticket ticket);
    enum class Wait : uint8_t { Answered, TimedOut, DeviceLost, NeverAsked };
    /// Waits until the ticket can be taken, or until it certainly never can: the device is lost, or it finished
    /// `submission` without a result.
    Wait waitFor(Ticket ticket, uint64_t submission, std::chrono::steady_clock::time_point deadline);
    std::optional<uint64_t> takeTimer(Ticket ticket);
    std::vector<DriverError> takeErrors();
    std::vector<FrameTiming> takeTimings();
    void takeTimings(std::vector<FrameTiming>& into); ///< replaces what it holds, and keeps its memory
    bool deviceLost() const;

private:
    struct Timer {
        Ticket ticket;
        uint64_t nanoseconds;
    };

    mutable std::mutex mMutex;
    std::condition_variable mAnswered;
    std::unordered_map<Ticket, std::vector<std::byte>> mReadbacks;
    std::vector<Timer> mTimers;         // oldest first
    std::vector<FrameTiming> mTimings;  // oldest first
    std::vector<DriverError> mErrors;   // oldest first
    const char* mOutOfMemory = nullptr; // in which activity; reported once
    size_t mDroppedErrors = 0;
    uint64_t mIdleSubmission = 0;
    bool mDeviceLost = false;
};

} // namespace filament_core::backend
