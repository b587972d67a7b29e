// SPDX-License-Identifier: Apache-2.0
/// SelfTest: a frame of 8 x 8 pixels whose bytes are known, drawn by a driver before it is used. Drivers that get it
/// wrong would draw blank or wrong images without an error (docs/driver-faults.md).
///   Draws   a dispatch that fills a storage buffer; a pass of depth alone; a draw that reads both, is blended and
///           masked; a second subpass with the first one's pixels as input attachment, where passes are merged.
///   Fails   Unsupported, with the device, the driver, the first wrong pixel and the cure.
///   Thread  that of the driver.
///   Cost    about 20 ms with Mesa's CPU drivers and a warm cache of shaders (bench/README.md). A driver that passed is
///           noted in a file, and not tested again.
#pragma once

#include "backend/api/Driver.h"
#include "base/Result.h"

#include <filesystem>
#include <functional>
#include <memory>

namespace filament_core::backend {

using MakeDriver = std::function<Result<std::unique_ptr<Driver>>(ResultSink&)>;

/// The driver that `make` makes, after the test. `sink` gets none of the test's results, and DriverStatistics do not
/// count its commands. `notes`: the folder of the file with the drivers that passed; empty: every driver is tested.
Result<std::unique_ptr<Driver>> makeTestedDriver(MakeDriver const& make, ResultSink& sink,
                                                 std::filesystem::path const& notes);

} // namespace filament_core::backend
