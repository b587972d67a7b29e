// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/DeviceNeeds.h"

namespace filament_core::engine {

Result<void> checkDevice(backend::DeviceInfo const& device) {
    if (device.limits.maxFragmentStorageBuffers >= kFragmentStorageBuffers) return {};
    return fail(ErrorCode::Unsupported,
                "{} device '{}' reads {} storage buffers in fragment shaders, lights and fog need {}; choose another "
                "device or API",
                backend::apiName(device.backend), device.deviceName, device.limits.maxFragmentStorageBuffers,
                kFragmentStorageBuffers);
}

} // namespace filament_core::engine
