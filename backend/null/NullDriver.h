// SPDX-License-Identifier: Apache-2.0
/// NullDriver: a driver without a device. Makes every layer above testable on any machine.
///   Does    tracks which objects live and how many bytes they would take; counts commands, draws, passes; answers
///           read-backs with zeros of the right size and timers with 0, at the next CmdEndFrame or waitIdle().
///   Does not check anything (layers/Validated does) and never draws a pixel.
///   Thread  as every driver: one; statistics() from any.
///   Fails   never. Commands that name unknown objects are ignored.
///   Cost    a few nanoseconds a command; heap only for objects and read-backs.
#pragma once

#include "backend/api/Driver.h"

#include <memory>

namespace filament_core::backend {

/// `sink` must outlive the driver. Limits and features are generous: everything that some accepted device can do.
std::unique_ptr<Driver> createNullDriver(ResultSink& sink);

} // namespace filament_core::backend
