// SPDX-License-Identifier: Apache-2.0
/// The Vulkan entry points and result codes, as every file of this folder includes them.
///   Functions come from tables (InstanceFunctions, VolkDeviceTable), never from volk's globals: several engines on
///   several devices live in one process.
#pragma once

#include "base/Result.h"

#include <volk.h>

#include <string_view>

namespace filament_core::backend::vulkan {

/// "VK_ERROR_DEVICE_LOST" and the like.
std::string toString(VkResult result);

bool isOutOfMemory(VkResult result);

/// OutOfMemory, DeviceLost or Internal; `what` says which call failed for which object.
Error errorFromResult(VkResult result, std::string_view what);

/// Something the GPU may still use after its handle is gone; Submissions::keep() destroys it when it is idle.
class DeviceObject {
public:
    DeviceObject() = default;
    DeviceObject(DeviceObject const&) = delete;
    DeviceObject& operator=(DeviceObject const&) = delete;
    virtual ~DeviceObject() = default;
};

/// A Vulkan structure of that type with everything else zero.
template <class S>
S make(VkStructureType type) {
    S value{};
    value.sType = type;
    return value;
}

/// A handle as the 64 bits that debug names and memory chunks carry.
template <class H>
uint64_t bitsOf(H handle) {
    static_assert(sizeof(H) <= sizeof(uint64_t));
    return (uint64_t)handle; // a pointer on 64-bit targets, an integer on 32-bit ones
}

} // namespace filament_core::backend::vulkan
