// SPDX-License-Identifier: Apache-2.0
/// The OpenGL ES 3.1+ driver, off-screen through EGL without a window system.
///   In      command streams whose programs are ESSL 3.10 text.  Out: results to the ResultSink.
///   Thread  createGlesDriver(): the thread that will use it. listGlesDevices(): any; restores the thread's EGL state.
///           Several drivers, on several threads or on one, do not interfere.
///   Limits  ES 3.1 with EXT_clip_control and EXT_color_buffer_float (ES 3.2 has the latter); others are not listed.
///   Fails   DeviceUnavailable: no libEGL, no driver behind it, or no device of the required name; the message tells
///           which, and what to install.
#pragma once

#include "backend/api/Driver.h"
#include "base/Result.h"

#include <memory>
#include <vector>

namespace filament_core::backend {

/// `sink` must outlive the driver.
Result<std::unique_ptr<Driver>> createGlesDriver(DriverOptions const& options, ResultSink& sink);

/// Usable devices, the default one first; empty without libEGL or a driver.
std::vector<DeviceInfo> listGlesDevices();

} // namespace filament_core::backend
