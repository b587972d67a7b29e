// SPDX-License-Identifier: Apache-2.0
/// Query: answers that come later: read-backs and timers.
///   In      a ticket, and the serial of the submission that computes the answer.
///   Out     answer(): one ResultSink call for every ticket whose submission has finished, in the order of asking.
///   Thread  the driver thread.
///   Memory  a host buffer per read-back until it is answered; two timestamps per timer from pools of 128 that are
///           reused.
///   Fails   a read-back without memory is answered with no bytes, a timer of a device without timestamps with 0.
#pragma once

#include "backend/api/Driver.h"
#include "backend/vulkan/Barriers.h"
#include "backend/vulkan/Buffer.h"
#include "backend/vulkan/Texture.h"
#include "base/Fifo.h"

#include <deque>
#include <vector>

namespace filament::backend::vulkan {

class Readbacks {
public:
    explicit Readbacks(Device& device) : mDevice(device) {}

    /// Host memory for the texels of the command; OutOfMemory with the texture's name.
    Result<std::unique_ptr<Buffer>> makeTarget(CmdReadTexture const& command, Texture const& texture);
    void add(Ticket ticket, Format format, std::unique_ptr<Buffer> target, uint64_t serial);
    void answer(uint64_t finishedSerial, ResultSink& sink);
    bool isWaiting() const { return !mWaiting.empty(); }

private:
    struct Waiting {
        Ticket ticket;
        Format format = Format::None;
        std::unique_ptr<Buffer> target;
        uint64_t serial = 0;
    };

    Device& mDevice;
    std::deque<Waiting> mWaiting;
};

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

} // namespace filament::backend::vulkan
