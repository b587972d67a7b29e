// SPDX-License-Identifier: Apache-2.0
/// Readbacks: bytes on their way to the app.
///   In      a ticket, a host buffer that the GPU copies into, and the serial of the submission that does it.
///   Out     answer(): one ResultSink call for every ticket whose submission has finished, in the order of requests.
///   Thread  the driver thread.
///   Memory  a host buffer per read-back until it is answered.
///   Fails   a read-back without memory returns no bytes.
#pragma once

#include "backend/api/Driver.h"
#include "backend/vulkan/Buffer.h"
#include "backend/vulkan/Texture.h"

#include <deque>
#include <memory>

namespace filament_core::backend::vulkan {

class Readbacks {
public:
    explicit Readbacks(Device& device) : mDevice(device) {}

    /// Host memory for the texels or bytes of the command; OutOfMemory with the texture's name.
    Result<std::unique_ptr<Buffer>> makeTarget(CmdReadTexture const& command, Texture const& texture);
    Result<std::unique_ptr<Buffer>> makeTarget(CmdReadBuffer const& command);
    /// `format`: None for bytes as they are.
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

} // namespace filament_core::backend::vulkan
