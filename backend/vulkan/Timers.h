// SPDX-License-Identifier: Apache-2.0
/// Timers: how long the device worked between two points of the stream. Pairs of time stamps, so they can nest.
///   In      a ticket, and the serial of the submission that the end is recorded in.
///   Out     answer(): one ResultSink call for every ticket whose submission has finished, in the order of ending.
///   Thread  the driver thread.
///   Memory  two time stamps per timer, from pools of 128 that are reused.
///   Fails   a timer of a device without time stamps returns 0.
#pragma once

#include "backend/api/Driver.h"
#include "backend/vulkan/Device.h"
#include "base/Fifo.h"

#include <vector>

namespace filament_core::backend::vulkan {

class Timers {
public:
    explicit Timers(Device& device) : mDevice(device) {}
    ~Timers();
    Timers(Timers const&) = delete;
    Timers& operator=(Timers const&) = delete;

    void begin(VkCommandBuffer commands, Ticket ticket);
    void end(VkCommandBuffer commands, Ticket ticket, uint64_t serial);
    void answer(uint64_t finishedSerial, ResultSink& sink);
    bool isWaiting() const { return !mWaiting.empty(); }

private:
    static constexpr uint32_t kPoolSize = 128;
    static constexpr uint32_t kNone = ~0u;

    struct Timer {
        Ticket ticket;
        uint32_t begin = kNone, end = kNone; // pool * kPoolSize + query
        uint64_t serial = 0;
    };

    uint32_t writeTimestamp(VkCommandBuffer commands);
    bool addPool();
    uint64_t nanoseconds(Timer const& timer) const;
    uint64_t ticks(uint32_t query) const;
    void recycle(Timer const& timer);

    Device& mDevice;
    std::vector<VkQueryPool> mPools;
    std::vector<uint32_t> mFree;
    std::vector<Timer> mRunning;
    Fifo<Timer> mWaiting; // ascending serials
};

} // namespace filament_core::backend::vulkan
