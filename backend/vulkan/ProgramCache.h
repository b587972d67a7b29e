// SPDX-License-Identifier: Apache-2.0
/// ProgramCache: the pipeline cache of the device, kept between runs in DriverOptions::cacheDirectory.
///   Thread  the driver thread.
///   Memory  that of the driver; at most kProgramCacheBytes on disk.
///   Fails   never: without a cache, pipelines are created again. The data begins with the device's own header, so a
///           driver ignores data of another one.
#pragma once

#include "backend/vulkan/Device.h"
#include "base/BlobStore.h"

#include <filesystem>
#include <optional>

namespace filament_core::backend::vulkan {

class ProgramCache {
public:
    /// An empty directory: nothing is kept.
    ProgramCache(Device& device, std::filesystem::path const& directory);
    ~ProgramCache();
    ProgramCache(ProgramCache const&) = delete;
    ProgramCache& operator=(ProgramCache const&) = delete;

    VkPipelineCache handle() const { return mHandle; } ///< null if the device refuses
    void save();

private:
    Device& mDevice;
    VkPipelineCache mHandle = VK_NULL_HANDLE;
    std::optional<BlobStore> mKept; ///< none: disabled
};

} // namespace filament_core::backend::vulkan
