// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Driver.h"

#include "backend/vulkan/Executor.h"

namespace filament_core::backend {

Result<std::unique_ptr<Driver>> createVulkanDriver(DriverOptions const& options, ResultSink& sink) {
    auto executor = vulkan::Executor::create(options, sink);
    if (!executor) return executor.error();
    return std::unique_ptr<Driver>(std::move(*executor));
}

std::vector<DeviceInfo> listVulkanDevices() {
    const auto instance = vulkan::Instance::create(nullptr);
    if (!instance) return {};
    std::vector<DeviceInfo> list;
    for (vulkan::PhysicalDevice& device : vulkan::surveyDevices(**instance)) {
        if (device.unusable.empty()) list.push_back(std::move(device.info));
    }
    return list;
}

} // namespace filament_core::backend
