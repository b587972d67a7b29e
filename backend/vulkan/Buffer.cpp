// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Buffer.h"

namespace filament_core::backend::vulkan {
namespace {

VkBufferUsageFlags usageFlags(BufferUsage usage) {
    VkBufferUsageFlags flags = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (has(usage, BufferUsage::Vertex)) flags |= VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
    if (has(usage, BufferUsage::Index)) flags |= VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
    if (has(usage, BufferUsage::Uniform)) flags |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    if (has(usage, BufferUsage::Storage)) flags |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    if (has(usage, BufferUsage::TransferSource)) flags |= VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    return flags;
}

} // namespace

Result<std::unique_ptr<Buffer>> Buffer::create(Device& device, BufferDesc const& desc) {
    return create(device, { desc.size, usageFlags(desc.usage), MemoryPurpose::Device, desc.debugName });
}

Result<std::unique_ptr<Buffer>> Buffer::create(Device& device, BufferOptions const& options) {
    if (options.bytes == 0) return fail(ErrorCode::InvalidArgument, "buffer '{}': size 0", options.debugName);
    std::unique_ptr<Buffer> buffer(new Buffer(device));
    VolkDeviceTable const& fn = device.fn();
    auto info = make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = options.bytes;
    info.usage = options.usage;
    VkResult result = fn.vkCreateBuffer(device.handle(), &info, nullptr, &buffer->mHandle);
    if (result == VK_SUCCESS) {
        VkMemoryRequirements needs{};
        fn.vkGetBufferMemoryRequirements(device.handle(), buffer->mHandle, &needs);
        const auto allocation = device.memory().allocate(needs, ResourceKind::Linear, options.purpose);
        result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
        if (allocation) {
            buffer->mAllocation = *allocation;
            result = fn.vkBindBufferMemory(device.handle(), buffer->mHandle, Memory::handleOf(*allocation),
                                           allocation->offset);
        }
    }
    if (result != VK_SUCCESS) {
        return errorFromResult(result, fmt::format("buffer '{}' of {} bytes", options.debugName, options.bytes));
    }
    buffer->mBytes = options.bytes;
    device.setName(VK_OBJECT_TYPE_BUFFER, buffer->mHandle, options.debugName);
    return buffer;
}

Buffer::~Buffer() {
    mDevice.fn().vkDestroyBuffer(mDevice.handle(), mHandle, nullptr);
    if (mAllocation.bytes > 0) mDevice.memory().free(mAllocation);
}

} // namespace filament_core::backend::vulkan
