// SPDX-License-Identifier: Apache-2.0
/// The Vulkan 1.1 driver: what the rest of the engine sees of this folder.
///   Thread  createVulkanDriver(): on the thread that will own the driver. listVulkanDevices(): any.
///   Needs   the Vulkan loader and one driver (Debian: mesa-vulkan-drivers), found at run time. No window system.
///   Fails   DeviceUnavailable with the reason and the cure; never a crash on a machine without Vulkan.
#pragma once

#include "backend/api/Driver.h"
#include "base/Result.h"

#include <memory>
#include <vector>

namespace filament_core::backend {

/// `sink` must outlive the driver. Takes the named device, else a GPU, else a CPU device.
Result<std::unique_ptr<Driver>> createVulkanDriver(DriverOptions const& options, ResultSink& sink);

/// Every Vulkan device that createVulkanDriver() would accept; empty without a loader or driver.
/// Cost: one instance made and destroyed; no device is created.
std::vector<DeviceInfo> listVulkanDevices();

} // namespace filament_core::backend
