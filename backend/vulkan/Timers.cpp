// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Timers.h"

#include <algorithm>
#include <cmath>

namespace filament_core::backend::vulkan {

Timers::~Timers() {
    for (VkQueryPool pool : mPools) mDevice.fn().vkDestroyQueryPool(mDevice.handle(), pool, nullptr);
}

void Timers::begin(VkCommandBuffer commands, Ticket ticket) {
    mRunning.push_back({ ticket, writeTimestamp(commands), kNone, 0 });
}

void Timers::end(VkCommandBuffer commands, Ticket ticket, uint64_t serial) {
    const auto running = std::ranges::find(mRunning, ticket, &Timer::ticket);
    if (running == mRunning.end()) return;
    Timer timer = *running;
    mRunning.erase(running);
    timer.end = writeTimestamp(commands);
    timer.serial = serial;
    mWaiting.push_back(timer);
}

void Timers::answer(uint64_t finishedSerial, ResultSink& sink) {
    while (!mWaiting.empty() && mWaiting.front().serial <= finishedSerial) {
        const Timer timer = mWaiting.front();
        mWaiting.pop_front();
        sink.onTimer(timer.ticket, nanoseconds(timer));
        recycle(timer);
    }
}

uint32_t Timers::writeTimestamp(VkCommandBuffer commands) {
    if (!mDevice.info().features.timers || (mFree.empty() && !addPool())) return kNone;
    const uint32_t query = mFree.back();
    mFree.pop_back();
    VolkDeviceTable const& fn = mDevice.fn();
    VkQueryPool pool = mPools[query / kPoolSize];
    // In the command buffer: resetting a query on the host needs Vulkan 1.2.
    fn.vkCmdResetQueryPool(commands, pool, query % kPoolSize, 1);
    // Both timestamps at the bottom of the pipe: from the end of all earlier work to the end of the timed work.
    fn.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, query % kPoolSize);
    return query;
}

bool Timers::addPool() {
    auto info = make<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kPoolSize;
    VkQueryPool pool = VK_NULL_HANDLE;
    if (mDevice.fn().vkCreateQueryPool(mDevice.handle(), &info, nullptr, &pool) != VK_SUCCESS) return false;
    const auto first = static_cast<uint32_t>(mPools.size()) * kPoolSize;
    for (uint32_t i = kPoolSize; i-- > 0;) mFree.push_back(first + i);
    mPools.push_back(pool);
    return true;
}

uint64_t Timers::nanoseconds(Timer const& timer) const {
    if (timer.begin == kNone || timer.end == kNone) return 0;
    const uint32_t bits = mDevice.physical().timestampBits;
    const uint64_t mask = bits >= 64 ? ~uint64_t{ 0 } : (uint64_t{ 1 } << bits) - 1;
    const uint64_t elapsed = (ticks(timer.end) - ticks(timer.begin)) & mask; // also right when the counter wrapped
    return static_cast<uint64_t>(std::llround(static_cast<double>(elapsed) * mDevice.physical().timestampNanoseconds));
}

uint64_t Timers::ticks(uint32_t query) const {
    uint64_t value = 0;
    mDevice.fn().vkGetQueryPoolResults(mDevice.handle(), mPools[query / kPoolSize], query % kPoolSize, 1, sizeof value,
                                       &value, sizeof value, VK_QUERY_RESULT_64_BIT);
    return value;
}

void Timers::recycle(Timer const& timer) {
    if (timer.begin != kNone) mFree.push_back(timer.begin);
    if (timer.end != kNone) mFree.push_back(timer.end);
}

} // namespace filament_core::backend::vulkan
