// SPDX-License-Identifier: Apache-2.0
/// PhysicalDevice: the properties of one device, queried once, and the choice between several devices.
///   Thread  any; plain values afterwards.
///   Needs   Vulkan 1.1, one queue family with graphics, and every format that formatInfo() calls renderable.
///           Everything else (anisotropy, depth clamp, BC formats, provoking vertex, half floats) is used if available.
#pragma once

#include "backend/api/Driver.h"
#include "backend/vulkan/Instance.h"
#include "backend/vulkan/Quirks.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::backend::vulkan {

struct PhysicalDevice {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    DeviceInfo info;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    VkPhysicalDeviceMemoryProperties memory{};
    VkPhysicalDeviceFeatures features{};
    uint32_t queueFamily = ~0u;
    uint32_t timestampBits = 0;       ///< 0: no timestamps on that queue
    float timestampNanoseconds = 1;   ///< of one tick
    uint64_t copyOffsetAlignment = 4; ///< of bytes in a staging buffer
    bool bresenhamLines = false;      ///< VK_EXT_line_rasterization: lines as OpenGL ES draws them
    bool provokingVertexLast = false;
    bool halfFloatShaders = false;
    bool depthResolve = false;
    bool imageFormatList = false;       ///< images may list the formats of their views
    bool swapchains = false;            ///< presents to windows
    bool hdrMetadata = false;           ///< VK_EXT_hdr_metadata, for windows
    bool creationFeedback = false;      ///< says whether a pipeline came from a cache
    bool lazilyAllocatedMemory = false; ///< transient attachments may live in tile memory only
    Quirks quirks;
    std::string unusable; ///< empty, or why this driver cannot run on it
};

/// All devices of the instance, usable or not, in the order of the loader.
std::vector<PhysicalDevice> surveyDevices(Instance const& instance);

/// Whether passes that read their own pixel are worth merging, which every device can: attachments then stay in the
/// tile memory of a device that has some, and in the caches of a CPU. Others gain nothing and may lose: an NVIDIA H100
/// takes 7.2 ms for the colours and the tone mapper of 3840 x 2160 pixels in one pass, and 4.6 ms in two.
bool gainsByMerging(PhysicalDevice const& device);

/// Index of the device to use: the first one whose name contains `required` (case-insensitive; empty: any), GPUs before
/// CPUs. DeviceUnavailable lists the devices and why they are unsuitable.
Result<size_t> chooseDevice(std::span<const PhysicalDevice> devices, std::string_view required);

} // namespace filament_core::backend::vulkan
