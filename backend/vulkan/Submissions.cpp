// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Submissions.h"

#include <limits>
#include <new>

namespace filament_core::backend::vulkan {

VkResult Submissions::initialize() {
    for (Slot& slot : mSlots) {
        if (const VkResult result = initialize(slot); result != VK_SUCCESS) return result;
    }
    return VK_SUCCESS;
}

VkResult Submissions::initialize(Slot& slot) {
    VolkDeviceTable const& fn = mDevice.fn();
    auto pool = make<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = mDevice.physical().queueFamily;
    VkResult result = fn.vkCreateCommandPool(mDevice.handle(), &pool, nullptr, &slot.pool);
    if (result != VK_SUCCESS) return result;

    auto buffer = make<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    buffer.commandPool = slot.pool;
    buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    buffer.commandBufferCount = 1;
    result = fn.vkAllocateCommandBuffers(mDevice.handle(), &buffer, &slot.commands);
    if (result != VK_SUCCESS) return result;

    const auto fence = make<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    return fn.vkCreateFence(mDevice.handle(), &fence, nullptr, &slot.fence);
}

Submissions::~Submissions() {
    VolkDeviceTable const& fn = mDevice.fn();
    fn.vkDeviceWaitIdle(mDevice.handle()); // also returns, with an error, when the device is lost
    mKept.clear();
    for (Slot& slot : mSlots) {
        fn.vkDestroyFence(mDevice.handle(), slot.fence, nullptr);
        fn.vkDestroyCommandPool(mDevice.handle(), slot.pool, nullptr);
    }
}

VkResult Submissions::open() {
    if (mIsOpen) return VK_SUCCESS;
    VolkDeviceTable const& fn = mDevice.fn();
    const size_t next = (mCurrent + 1) % kSlots;
    Slot& slot = mSlots[next];
    // After the wait the slot counts as finished, and poll() no longer looks at its fence, which can be reset.
    VkResult result = wait(slot.serial);
    if (result == VK_SUCCESS) result = fn.vkResetFences(mDevice.handle(), 1, &slot.fence);
    if (result == VK_SUCCESS) result = fn.vkResetCommandPool(mDevice.handle(), slot.pool, 0);
    if (result != VK_SUCCESS) return result;

    auto begin = make<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    result = fn.vkBeginCommandBuffer(slot.commands, &begin);
    if (result != VK_SUCCESS) return result;
    mCurrent = next;
    mIsOpen = true;
    return VK_SUCCESS;
}

VkResult Submissions::submit(VkSemaphore waits, VkSemaphore signals) {
    if (!mIsOpen) return VK_SUCCESS;
    mIsOpen = false;
    VolkDeviceTable const& fn = mDevice.fn();
    Slot& slot = mSlots[mCurrent];
    VkResult result = fn.vkEndCommandBuffer(slot.commands);
    if (result != VK_SUCCESS) return result;
    auto info = make<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.commandBufferCount = 1;
    info.pCommandBuffers = &slot.commands;
    const VkPipelineStageFlags transfers = VK_PIPELINE_STAGE_TRANSFER_BIT;
    info.waitSemaphoreCount = waits ? 1 : 0;
    info.pWaitSemaphores = &waits;
    info.pWaitDstStageMask = &transfers;
    info.signalSemaphoreCount = signals ? 1 : 0;
    info.pSignalSemaphores = &signals;
    result = fn.vkQueueSubmit(mDevice.queue(), 1, &info, slot.fence);
    // Only then: the fence of a failed submission is never signalled, and a wait for it would not end.
    if (result == VK_SUCCESS) slot.serial = ++mSubmitted;
    return result;
}

VkResult Submissions::poll() {
    VkResult result = VK_SUCCESS;
    uint64_t finished = mFinished;
    for (Slot const& slot : mSlots) {
        if (slot.serial <= finished) continue;
        const VkResult status = mDevice.fn().vkGetFenceStatus(mDevice.handle(), slot.fence);
        // There is one queue: a submission finishes after all earlier ones.
        if (status == VK_SUCCESS) finished = slot.serial;
        if (status < VK_SUCCESS) result = status;
    }
    finish(finished);
    return result;
}

VkResult Submissions::wait(uint64_t serial) {
    if (serial <= mFinished) return VK_SUCCESS;
    for (Slot const& slot : mSlots) {
        if (slot.serial != serial) continue;
        const VkResult result = mDevice.fn().vkWaitForFences(mDevice.handle(), 1, &slot.fence, VK_TRUE,
                                                             std::numeric_limits<uint64_t>::max());
        if (result != VK_SUCCESS) return result;
        finish(serial);
        break;
    }
    return VK_SUCCESS;
}

void Submissions::keep(std::unique_ptr<DeviceObject> object) {
    if (!object) return;
    const uint64_t serial = mIsOpen ? recordingSerial() : mSubmitted;
    if (serial <= mFinished) return;
    try {
        mKept.emplace_back();
    } catch (std::bad_alloc const&) {
        mDevice.fn().vkDeviceWaitIdle(mDevice.handle()); // this object ends while nothing uses it
        throw;
    }
    mKept.back() = { serial, std::move(object) };
}

void Submissions::finish(uint64_t serial) {
    mFinished = serial;
    while (!mKept.empty() && mKept.front().serial <= serial) mKept.pop_front();
}

} // namespace filament_core::backend::vulkan
