// SPDX-License-Identifier: Apache-2.0
// The parts that need no device: ring arithmetic, sub-resource bookkeeping, pass layouts, vertex inputs, device choice.
#include "backend/api/Slots.h"
#include "backend/vulkan/Barriers.h"
#include "backend/vulkan/PhysicalDevice.h"
#include "backend/vulkan/Pipeline.h"
#include "backend/vulkan/RenderPasses.h"
#include "backend/vulkan/RingCursor.h"

#include <gtest/gtest.h>

namespace filament_core::backend::vulkan {
namespace {

TEST(Results, WithoutANameAreShownAsNumbers) {
    EXPECT_EQ(toString(VK_ERROR_DEVICE_LOST), "VK_ERROR_DEVICE_LOST");
    EXPECT_EQ(toString(static_cast<VkResult>(-1000255000)), "VkResult -1000255000");
}

// ---------------------------------------------------------------------------------------------- RingCursor

TEST(RingCursor, RefusesToOverwriteWhatIsInFlight) {
    RingCursor ring(1024);
    EXPECT_EQ(ring.allocate(512, 16, 1), 0u);
    EXPECT_EQ(ring.allocate(512, 16, 2), 512u);
    EXPECT_FALSE(ring.allocate(1, 16, 2));
    ring.release(1);
    EXPECT_EQ(ring.allocate(512, 16, 3), 0u);
    EXPECT_FALSE(ring.allocate(1, 16, 3));
}

TEST(RingCursor, SkipsTheEndRatherThanSplitARequest) {
    RingCursor ring(1024);
    EXPECT_EQ(ring.allocate(700, 16, 1), 0u);
    EXPECT_EQ(ring.allocate(100, 16, 2), 704u);
    ring.release(1);
    EXPECT_EQ(ring.allocate(400, 16, 3), 0u); // 224 are left behind 804
    EXPECT_FALSE(ring.allocate(400, 16, 3));  // serial 2 still owns 704..804
    ring.release(2);
    EXPECT_EQ(ring.allocate(400, 16, 3), 400u);
}

TEST(RingCursor, FitsTheWholeSizeAgainWhenEmpty) {
    RingCursor ring(1024);
    EXPECT_TRUE(ring.allocate(100, 16, 1));
    ring.release(1);
    EXPECT_EQ(ring.bytesInUse(), 0u);
    EXPECT_EQ(ring.allocate(1024, 16, 2), 0u);
    EXPECT_FALSE(ring.allocate(1025, 16, 3));
}

// ---------------------------------------------------------------------------------------------- SubresourceUses

using Part = std::pair<SubresourceRange, Use>;

std::vector<Part> partsOf(SubresourceUses const& uses, SubresourceRange const& range) {
    std::vector<Part> parts;
    uses.forEachPart(range, [&](SubresourceRange const& part, Use use) { parts.emplace_back(part, use); });
    return parts;
}

TEST(SubresourceUses, AUniformRangeIsOnePart) {
    const SubresourceUses uses(5, 6);
    EXPECT_EQ(partsOf(uses, uses.all()), (std::vector<Part>{ { { 0, 5, 0, 6 }, Use::Undefined } }));
}

TEST(SubresourceUses, AMixedRangeFallsIntoRunsOfLayersPerLevel) {
    SubresourceUses uses(2, 6);
    uses.set({ 1, 1, 2, 3 }, Use::TransferWrite);
    EXPECT_EQ(partsOf(uses, uses.all()), (std::vector<Part>{ { { 0, 1, 0, 6 }, Use::Undefined },
                                                             { { 1, 1, 0, 2 }, Use::Undefined },
                                                             { { 1, 1, 2, 3 }, Use::TransferWrite },
                                                             { { 1, 1, 5, 1 }, Use::Undefined } }));
    EXPECT_EQ(partsOf(uses, { 1, 1, 3, 2 }), (std::vector<Part>{ { { 1, 1, 3, 2 }, Use::TransferWrite } }));
}

// ---------------------------------------------------------------------------------------------- passes

PassLayout tonemapLayout() {
    PassLayout layout;
    layout.colorFormats = { Format::RGBA16F, Format::RGBA8 };
    layout.colorCount = 2;
    layout.subpassCount = 2;
    layout.subpasses[0] = { .colorMask = 0b01 };
    layout.subpasses[1] = { .colorMask = 0b11, .inputMask = 0b01, .usesDepth = false };
    return layout;
}

TEST(Pass, ASubpassDoesNotWriteWhatItReads) {
    EXPECT_EQ(writtenColors(tonemapLayout(), 0), 0b01);
    EXPECT_EQ(readColors(tonemapLayout(), 1), 0b01);
    EXPECT_EQ(writtenColors(tonemapLayout(), 1), 0b10);
}

TEST(Pass, AnAttachmentEntersInItsFirstUseAndStaysInItsLast) {
    EXPECT_EQ(firstColorUse(tonemapLayout(), 0), Use::ColorAttachment);
    EXPECT_EQ(lastColorUse(tonemapLayout(), 0), Use::InputRead);
    EXPECT_EQ(firstColorUse(tonemapLayout(), 1), Use::ColorAttachment);
    EXPECT_EQ(lastColorUse(tonemapLayout(), 1), Use::ColorAttachment);
}

TEST(Pass, WhatLiesBeyondTheCountsDoesNotTellLayoutsApart) {
    PassLayout other = tonemapLayout();
    other.colorFormats[5] = Format::R8;
    other.subpasses[3].inputMask = 7;
    other.subpasses[0].inputMask = 0xF0;
    EXPECT_EQ(keyOf(other), keyOf(tonemapLayout()));
    other.subpasses[0].colorMask = 0b11;
    EXPECT_NE(keyOf(other), keyOf(tonemapLayout()));
}

// ---------------------------------------------------------------------------------------------- vertex inputs

TEST(VertexInput, LeavesOutWhatTheProgramDoesNotRead) {
    VertexLayout layout;
    layout.attributes[0] = { .location = 0, .buffer = 0, .format = VertexFormat::Float3 };
    layout.attributes[1] = { .location = 3, .buffer = 1, .format = VertexFormat::Half2, .offset = 4 };
    layout.attributeCount = 2;
    layout.buffers[1].stride = 20;
    layout.bufferCount = 2;
    const std::array inputs{ ShaderInput{ 3, ScalarKind::Float } };
    const VertexInput input = vertexInputOf(layout, inputs);
    ASSERT_EQ(input.attributeCount, 1u);
    EXPECT_EQ(input.attributes[0].binding, 1u);
    EXPECT_EQ(input.attributes[0].offset, 4u);
    EXPECT_EQ(input.attributes[0].format, VK_FORMAT_R16G16_SFLOAT);
    ASSERT_EQ(input.bufferCount, 1u);
    EXPECT_EQ(input.buffers[0].stride, 20u);
    EXPECT_EQ(input.bufferMask, 0b10);
    EXPECT_FALSE(input.readsZeros);
}

TEST(VertexInput, FeedsWhatTheLayoutLacksFromTheZeroBufferInTheRightType) {
    const std::array inputs{ ShaderInput{ 1, ScalarKind::Float }, ShaderInput{ 5, ScalarKind::UInt } };
    const VertexInput input = vertexInputOf({}, inputs);
    ASSERT_EQ(input.attributeCount, 2u);
    EXPECT_EQ(input.attributes[0].format, VK_FORMAT_R32_SFLOAT);
    EXPECT_EQ(input.attributes[1].format, VK_FORMAT_R32_UINT);
    ASSERT_EQ(input.bufferCount, 1u);
    EXPECT_EQ(input.buffers[0].binding, kZeroBufferSlot);
    EXPECT_EQ(input.buffers[0].stride, 0u);
    EXPECT_TRUE(input.readsZeros);
    EXPECT_EQ(input.bufferMask, 0);
}

// ---------------------------------------------------------------------------------------------- handles

TEST(Slots, AStaleHandleFindsNothing) {
    Slots<BufferHandle, int> slots;
    const auto first = BufferHandle::make(3, 1), second = BufferHandle::make(3, 2);
    slots.put(first, std::make_unique<int>(1));
    EXPECT_EQ(*slots.find(first), 1);
    EXPECT_EQ(slots.find(second), nullptr);
    EXPECT_EQ(slots.take(second), nullptr);
    slots.put(second, std::make_unique<int>(2));
    EXPECT_EQ(slots.find(first), nullptr);
    EXPECT_EQ(*slots.take(second), 2);
    EXPECT_EQ(slots.find(second), nullptr);
    EXPECT_EQ(slots.find({}), nullptr);
    EXPECT_EQ(slots.find(BufferHandle::make(1000, 1)), nullptr);
}

// ---------------------------------------------------------------------------------------------- device choice

PhysicalDevice device(const char* name, VkPhysicalDeviceType type, const char* unusable = "") {
    PhysicalDevice made;
    made.info.deviceName = name;
    made.type = type;
    made.unusable = unusable;
    return made;
}

std::vector<PhysicalDevice> someDevices() {
    return { device("llvmpipe (LLVM 15.0.6, 256 bits)", VK_PHYSICAL_DEVICE_TYPE_CPU),
             device("Intel UHD", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
             device("Old Radeon", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, "cannot render to D32FS8"),
             device("GeForce", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU) };
}

TEST(ChooseDevice, TakesTheDiscreteGpuUnlessANameIsRequired) {
    const auto devices = someDevices();
    EXPECT_EQ(chooseDevice(devices, "").value(), 3u);
    EXPECT_EQ(chooseDevice(devices, "LLVMPipe").value(), 0u);
    EXPECT_EQ(chooseDevice(devices, "uhd").value(), 1u);
    EXPECT_EQ(chooseDevice(std::span(devices).first(1), "").value(), 0u);
}

TEST(GainsByMerging, DevicesWhoseAttachmentsNeedNotLeaveTheChip) {
    EXPECT_TRUE(gainsByMerging({ .type = VK_PHYSICAL_DEVICE_TYPE_CPU }));
    EXPECT_TRUE(gainsByMerging({ .type = VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU, .lazilyAllocatedMemory = true }));
    EXPECT_FALSE(gainsByMerging({ .type = VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU }));
    EXPECT_FALSE(gainsByMerging({ .type = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU }));
}

TEST(ChooseDevice, SaysWhyAnUnusableDeviceDoesNotDo) {
    const auto choice = chooseDevice(someDevices(), "radeon");
    ASSERT_FALSE(choice);
    EXPECT_EQ(choice.error().code, ErrorCode::DeviceUnavailable);
    EXPECT_NE(choice.error().message.find("'Old Radeon' (unusable: cannot render to D32FS8)"), std::string::npos)
            << choice.error().message;
}

TEST(ChooseDevice, SaysWhatToInstallWhenThereIsNone) {
    const auto choice = chooseDevice({}, "");
    ASSERT_FALSE(choice);
    EXPECT_NE(choice.error().message.find("install mesa-vulkan-drivers"), std::string::npos);
}

} // namespace
} // namespace filament_core::backend::vulkan
