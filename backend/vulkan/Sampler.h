// SPDX-License-Identifier: Apache-2.0
/// Sampler: a VkSampler.
///   Thread  the driver thread.
///   Limits  anisotropy is clamped to DeviceLimits::maxAnisotropy.
///   Fails   create(): OutOfMemory.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/vulkan/Device.h"

namespace filament_core::backend::vulkan {

class Sampler final : public DeviceObject {
public:
    static Result<std::unique_ptr<Sampler>> create(Device& device, SamplerDesc const& desc);
    ~Sampler() override;

    VkSampler handle() const { return mHandle; }

private:
    explicit Sampler(Device& device) : mDevice(device) {}

    Device& mDevice;
    VkSampler mHandle = VK_NULL_HANDLE;
};

} // namespace filament_core::backend::vulkan
