// SPDX-License-Identifier: Apache-2.0
/// DriverPromise: what is promised of the pictures of these drivers on this processor. The promise is of Mesa's CPU
/// drivers, in the versions that were measured (docs/drivers.md), with the same version for both APIs.
///   Thread  any; pure.
#pragma once

#include <filament/Engine.h>

#include <span>
#include <string>
#include <string_view>

namespace filament::tools {

/// Why the promise of the same bits does not hold, in a line that says what was found, what holds there and what helps;
/// empty: it holds. `features` is cpuFeatures().
std::string driverNote(std::span<const DeviceDescription> devices, std::string_view features);

} // namespace filament::tools
