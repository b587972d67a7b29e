// SPDX-License-Identifier: Apache-2.0
/// DriverPromise: what is promised of the images of these drivers on this processor. The promise is of Mesa's CPU
/// drivers, in the versions that were measured (docs/drivers.md), with the same version for both APIs.
///   Thread  any; pure.
#pragma once

#include <filament_core/Engine.h>

#include <span>
#include <string>
#include <string_view>

namespace filament_core::tools {

/// "25.0.7" of "Mesa 25.0.7-2 (LLVM 19.1.7), Vulkan 1.4.305", as DeviceDescription::driver has it; empty: not Mesa's.
std::string mesaVersion(std::string_view driver);

/// Why the promise of the same bits does not hold, in a line that says what was found, what holds there and what helps;
/// empty: it holds. `features` is cpuFeatures().
std::string driverNote(std::span<const DeviceDescription> devices, std::string_view features);

} // namespace filament_core::tools
