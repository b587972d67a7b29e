// SPDX-License-Identifier: Apache-2.0
/// Queries: GPU timers, and how far the device may fall behind.
///   Timers are pairs of time stamps, so they nest. One that spans a disjoint event (a clock change) answers 0.
///   Thread  the driver thread.
///   Memory  query objects are reused; as many live as timers are unanswered.
///   Limits  two frames in flight: endFrame() waits for the frame before the last one.
#pragma once

#include "backend/gles/Fence.h"
#include "base/Fifo.h"

#include <vector>

namespace filament::backend::gles {

class Queries {
public:
    explicit Queries(Device& device) : mDevice(device) { mSpare.reserve(64); }
    ~Queries();

    void beginTimer(Ticket ticket);
    void endTimer(Ticket ticket);
    /// Starts the frame's work on the device.
    void endFrame();
    /// Answers the timers whose time stamps are there; `wait`: all that have ended.
    void poll(bool wait);

private:
    static constexpr size_t kFramesInFlight = 2;

    struct Timer {
        Ticket ticket;
        GLuint begin = 0, end = 0;
    };
    GLuint stamp();
    uint64_t read(GLuint query) const;

    Device& mDevice;
    std::vector<Timer> mOpen; // innermost last
    Fifo<Timer> mEnded;       // oldest first
    std::vector<GLuint> mSpare;
    Fifo<Fence> mFrames;
};

} // namespace filament::backend::gles
