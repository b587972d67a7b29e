// SPDX-License-Identifier: Apache-2.0
/// The only file that names all backends.
///   Thread  createDriver(): on the thread that will drive it. listDevices(): any, before drivers are made.
///   Errors  DeviceUnavailable with the reason and the cure (which package to install, which devices exist);
///           Unsupported for a driver that fails the self-test.
#pragma once

#include "backend/api/Driver.h"
#include "base/Result.h"

#include <memory>
#include <vector>

namespace filament_core::backend {

/// `sink` must outlive the driver.
Result<std::unique_ptr<Driver>> createDriver(Backend type, DriverOptions const& options, ResultSink& sink);

/// Every device of every backend of this build. A backend without a driver installed is simply absent.
std::vector<DeviceInfo> listDevices();

} // namespace filament_core::backend
