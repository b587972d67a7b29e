// SPDX-License-Identifier: Apache-2.0
/// Faulty: a driver around a driver that fails on request: what devices do once in a million frames, at any command.
///   In      FaultInjector::arm() says what happens from the next stream on: which command loses the device, which
///           creation runs out of memory, how slow the driver is.
///   Out     the commands up to the fault reach the driver inside, in the middle of a pass or not; a refused creation
///           does not, and whatever uses the object meets a driver that has never heard of it. Both are told like a
///           real device tells them: ResultSink::onError.
///   Thread  FaultInjector: any. The layer: the driver thread.
///   Memory  a list of the pieces of the stream that are forwarded.
///   Fails   only as asked.
///   Cost    unarmed: one lock a stream. Armed: about 5 ns a command.
#pragma once

#include "backend/api/Driver.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace filament::backend {

/// Zero: never.
struct Faults {
    uint64_t loseDeviceAt = 0;   ///< at this command, counted from 1 since arm(); it is not executed, nor are others
    uint64_t refuseCreation = 0; ///< this creation of an object, counted from 1 since arm(), is out of memory
    std::chrono::microseconds streamDelay{ 0 };  ///< every stream takes so much longer
    std::chrono::microseconds commandDelay{ 0 }; ///< every command takes so much longer, and counts as running
};

/// The end of the layer that tests hold: EngineOptions::debug.faults. One engine each.
class FaultInjector {
public:
    /// From the next stream on; the counts start again.
    void arm(Faults const& faults);

    /// Since arm(): how many commands and creations came by, those behind a fault included.
    uint64_t commandsSeen() const;
    uint64_t creationsSeen() const;
    /// Whether a device was lost or a creation refused since arm().
    bool hasStruck() const;

private:
    friend class FaultyDriver; // the layer's end: reads the faults and counts

    mutable std::mutex mMutex;
    Faults mFaults;
    uint64_t mCommands = 0, mCreations = 0;
    bool mHasStruck = false;
    uint64_t mArmed = 0; // how often: what a stream counted for earlier faults is not written back
};

/// `sink` gets the injected errors and must outlive the result; the inner driver keeps its own sink.
std::unique_ptr<Driver> faulty(std::unique_ptr<Driver> inner, std::shared_ptr<FaultInjector> injector,
                               ResultSink& sink);

} // namespace filament::backend
