// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/DeviceNeeds.h"

#include <gmock/gmock.h>

namespace filament_core::engine {
namespace {

TEST(DeviceNeeds, ADeviceWithoutStorageBuffersInFragmentShadersIsRefusedByName) {
    backend::DeviceInfo device{ .backend = Backend::Gles, .deviceName = "Small GPU" };
    device.limits.maxFragmentStorageBuffers = 3;
    EXPECT_TRUE(checkDevice(device).ok());
    device.limits.maxFragmentStorageBuffers = 0;
    const Result<void> refused = checkDevice(device);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("OpenGL ES device 'Small GPU' reads 0 storage buffers"));
    EXPECT_THAT(refused.error().message, testing::HasSubstr("choose another"));
}

} // namespace
} // namespace filament_core::engine
