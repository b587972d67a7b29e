// SPDX-License-Identifier: Apache-2.0
/// Faulty: a layer that fails on request: faults that devices rarely show, at any command.
///   In      FaultInjector::arm() sets the faults from the next stream on: which command loses the device, which
///           creation runs out of memory, how slow the driver is.
///   Out     the commands up to the fault reach the inner driver, even in the middle of a pass. A refused creation does
///           not reach it, and commands that use the object find a driver that does not know it. Both are reported like
///           those of a real device: ResultSink::onError.
///   Thread  FaultInjector: any. The layer: the driver thread.
///   Memory  a list of the parts of the stream that are forwarded.
///   Fails   only as requested.
///   Cost    unarmed: one lock per stream. Armed: about 5 ns per command.
#pragma once

#include "backend/api/Driver.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace filament_core::backend {

/// Zero: never.
struct Faults {
    uint64_t loseDeviceAt = 0;   ///< at this command, counted from 1 since arm(); it is not executed, nor are others
    uint64_t refuseCreation = 0; ///< this creation of an object, counted from 1 since arm(), runs out of memory
    std::chrono::microseconds streamDelay{ 0 };  ///< added to every stream
    std::chrono::microseconds commandDelay{ 0 }; ///< added to every command, which counts as running
};

/// The tests' interface to the layer: EngineOptions::debug.faults. One per engine.
class FaultInjector {
public:
    /// Takes effect with the next stream; the counts restart.
    void arm(Faults const& faults);

    /// Number of commands and creations since arm(), including those after a fault.
    uint64_t commandsSeen() const;
    uint64_t creationsSeen() const;
    /// Whether a device was lost or a creation refused since arm().
    bool hasStruck() const;

private:
    friend class FaultyDriver; // the layer: reads the faults and counts

    mutable std::mutex mMutex;
    Faults mFaults;
    uint64_t mCommands = 0, mCreations = 0;
    bool mHasStruck = false;
    uint64_t mArmed = 0; // number of calls: counts for earlier faults are not written back
};

/// `sink` receives the injected errors and must outlive the result; the inner driver keeps its own sink.
std::unique_ptr<Driver> faulty(std::unique_ptr<Driver> inner, std::shared_ptr<FaultInjector> injector,
                               ResultSink& sink);

} // namespace filament_core::backend
