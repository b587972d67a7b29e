// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/ProgramCache.h"

#include "backend/api/Driver.h"
#include "base/Hash.h"

#include <new>
#include <vector>

namespace filament_core::backend::vulkan {

ProgramCache::ProgramCache(Device& device, std::filesystem::path const& directory) : mDevice(device) {
    auto info = make<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
    if (!directory.empty()) {
        DeviceInfo const& of = device.info();
        const uint64_t identity = hashString(of.driverName, hashString(of.deviceName));
        mKept.emplace(directory / fmt::format("vulkan-{:016x}.pipelines", identity), identity, kProgramCacheBytes);
        const std::span<const std::byte> data = mKept->find(0);
        info.initialDataSize = data.size();
        info.pInitialData = data.data();
    }
    if (device.fn().vkCreatePipelineCache(device.handle(), &info, nullptr, &mHandle) != VK_SUCCESS)
        mHandle = VK_NULL_HANDLE;
}

ProgramCache::~ProgramCache() { mDevice.fn().vkDestroyPipelineCache(mDevice.handle(), mHandle, nullptr); }

void ProgramCache::save() {
    if (!mKept || mHandle == VK_NULL_HANDLE) return;
    VolkDeviceTable const& fn = mDevice.fn();
    size_t size = 0;
    if (fn.vkGetPipelineCacheData(mDevice.handle(), mHandle, &size, nullptr) != VK_SUCCESS) return;
    try {
        std::vector<std::byte> data(size);
        if (fn.vkGetPipelineCacheData(mDevice.handle(), mHandle, &size, data.data()) != VK_SUCCESS) return;
        mKept->put(0, std::span(data).first(size));
        mKept->save();
    } catch (std::bad_alloc const&) { // then nothing is saved
    }
}

} // namespace filament_core::backend::vulkan
