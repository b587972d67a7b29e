// SPDX-License-Identifier: Apache-2.0
/// Timers: how long the device worked between two points of the stream.
///   Each is a pair of time stamps, so they can nest. One that spans a disjoint event (a clock change) returns 0.
///   Thread  the driver thread.
///   Memory  query objects are reused; there are as many as pending timers.
#pragma once

#include "backend/gles/Device.h"
#include "base/Fifo.h"

#include <vector>

namespace filament_core::backend::gles {

class Timers {
public:
    explicit Timers(Device& device) : mDevice(device) { mSpare.reserve(64); }
    ~Timers();

    void begin(Ticket ticket);
    void end(Ticket ticket);
    /// Delivers timers whose time stamps are ready; `wait`: all that have ended.
    void poll(bool wait);

private:
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
};

} // namespace filament_core::backend::gles
