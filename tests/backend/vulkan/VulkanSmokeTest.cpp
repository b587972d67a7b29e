// SPDX-License-Identifier: Apache-2.0
// The shortest path through every file of the driver: a clear, a triangle, a read-back.
#include "backend/vulkan/Driver.h"
#include "tests/backend/vulkan/DriverFixture.h"
#include "tests/base/ScopedVariable.h"

#include <cstdlib>

namespace filament_core::backend::vulkan {
namespace {

TEST_F(DriverTest, AClearFillsEveryPixel) {
    const TextureHandle target = makeTarget(5, 3);
    beginPass(target, 5, 3, { 0, 1, 0, 1 });
    endPass();
    EXPECT_EQ(readPixels(target, 5, 3), std::vector<Rgba8>(15, Rgba8{ 0, 255, 0, 255 }));
}

TEST_F(DriverTest, ATriangleInTheUpperLeftCornerCoversRowZero) {
    // NDC (-1, -1) is row 0, column 0: a right triangle there covers pixel (0, 0) and not the opposite corner.
    const ProgramHandle program = makeProgram(R"(
        layout(location = 0) in vec2 position;
        void main() { gl_Position = vec4(position, 0.5, 1.0); })",
                                              kRedFragment);
    PipelineDesc desc{ .program = program, .pass = colorLayout(), .debugName = "triangle" };
    desc.vertices.attributes[0] = { .location = 0, .buffer = 0, .format = VertexFormat::Float2 };
    desc.vertices.attributeCount = 1;
    desc.vertices.buffers[0].stride = 8;
    desc.vertices.bufferCount = 1;
    desc.raster.cull = CullMode::None;
    const PipelineHandle pipeline = makePipeline(desc);
    const BufferHandle corners = makeBuffer(BufferUsage::Vertex, std::vector<float>{ -1, -1, -1, 0.5f, 0.5f, -1 });
    const TextureHandle target = makeTarget(8, 8);
    beginPass(target, 8, 8);
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdBindVertexBuffers{ .buffers = { corners }, .count = 1 });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    const std::vector<Rgba8> pixels = readPixels(target, 8, 8);
    EXPECT_EQ(pixels[0], (Rgba8{ 255, 0, 0, 255 }));
    EXPECT_EQ(pixels[63], (Rgba8{ 0, 0, 0, 0 }));
    EXPECT_EQ(driver->statistics().draws, 1u);
}

TEST(VulkanDriver, ListsTheDeviceThatItCreates) {
    const std::vector<DeviceInfo> devices = listVulkanDevices();
    if (devices.empty()) GTEST_SKIP() << "no Vulkan device";
    CollectingSink sink;
    const auto driver = createVulkanDriver({ .requireDevice = devices[0].deviceName }, sink);
    ASSERT_TRUE(driver) << driver.error().message;
    EXPECT_EQ((*driver)->info().deviceName, devices[0].deviceName);
    EXPECT_EQ((*driver)->info().backend, Backend::Vulkan);
    EXPECT_EQ((*driver)->info().shaderLanguage, ShaderLanguage::SpirV);
}

TEST(VulkanDriver, NamesTheDevicesThereAreWhenTheRequiredOneIsMissing) {
    const std::vector<DeviceInfo> devices = listVulkanDevices();
    if (devices.empty()) GTEST_SKIP() << "no Vulkan device";
    CollectingSink sink;
    const auto driver = createVulkanDriver({ .requireDevice = "no such device" }, sink);
    ASSERT_FALSE(driver);
    EXPECT_EQ(driver.error().code, ErrorCode::DeviceUnavailable);
    EXPECT_NE(driver.error().message.find(devices[0].deviceName), std::string::npos) << driver.error().message;
}

TEST(VulkanDriver, SaysWhatToInstallOnAMachineWithoutADriver) {
    // The loader reads them for each instance.
    const test::ScopedVariable driverFiles("VK_DRIVER_FILES", "/nonexistent/driver.json");
    const test::ScopedVariable oldName("VK_ICD_FILENAMES", "/nonexistent/driver.json");
    CollectingSink sink;
    const auto driver = createVulkanDriver({}, sink);
    const std::vector<DeviceInfo> devices = listVulkanDevices();
    ASSERT_FALSE(driver);
    EXPECT_EQ(driver.error().code, ErrorCode::DeviceUnavailable);
    EXPECT_NE(driver.error().message.find("install mesa-vulkan-drivers"), std::string::npos) << driver.error().message;
    EXPECT_TRUE(devices.empty());
}

} // namespace
} // namespace filament_core::backend::vulkan
