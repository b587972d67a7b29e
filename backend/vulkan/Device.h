// SPDX-License-Identifier: Apache-2.0
/// Device: the logical device, its one queue, its functions and its memory. Lives longer than everything made from it.
///   Thread  the driver thread; info() any.
///   Fails   create(): DeviceUnavailable, naming the device and what refused.
#pragma once

#include "backend/vulkan/Memory.h"
#include "backend/vulkan/PhysicalDevice.h"

#include <memory>
#include <string_view>

namespace filament_core::backend::vulkan {

class Device {
public:
    static Result<std::unique_ptr<Device>> create(std::unique_ptr<Instance> instance, PhysicalDevice physical);
    ~Device(); ///< everything made from the device is gone
    Device(Device const&) = delete;
    Device& operator=(Device const&) = delete;

    VkDevice handle() const { return mHandle; }
    VkQueue queue() const { return mQueue; }
    VolkDeviceTable const& fn() const { return mFunctions; }
    /// For tests: a function replaced here fails the way a broken device would.
    VolkDeviceTable& functionsForTest() { return mFunctions; }
    Memory& memory() { return *mMemory; }
    PhysicalDevice const& physical() const { return mPhysical; }
    DeviceInfo const& info() const { return mPhysical.info; }
    Instance const& instance() const { return *mInstance; }

    /// Names an object for validation messages and captures; does nothing without validation.
    template <class H>
    void setName(VkObjectType type, H handle, std::string_view name) const {
        if (mInstance->hasValidation() && !name.empty()) setNameBits(type, bitsOf(handle), name);
    }

private:
    Device() = default;
    void setNameBits(VkObjectType type, uint64_t handle, std::string_view name) const;

    std::unique_ptr<Instance> mInstance;
    PhysicalDevice mPhysical;
    VkDevice mHandle = VK_NULL_HANDLE;
    VkQueue mQueue = VK_NULL_HANDLE;
    VolkDeviceTable mFunctions{};
    std::unique_ptr<Memory> mMemory;
};

} // namespace filament_core::backend::vulkan
