// SPDX-License-Identifier: Apache-2.0
/// Read-backs: texels into a buffer of the driver, delivered when the device has written them.
///   Out     tightly packed rows, row 0 first, in the texture's own format; depth formats as 32-bit floats.
///   Thread  the driver thread.
///   Memory  one pixel buffer per unanswered ticket.
///   Fails   what cannot be read is reported, and the answer to its ticket is empty.
#pragma once

#include "backend/gles/Buffer.h"
#include "backend/gles/DepthReader.h"
#include "backend/gles/Fence.h"

#include <deque>
#include <optional>
#include <vector>

namespace filament_core::backend::gles {

class Readbacks {
public:
    Readbacks(Device& device, Textures const& textures, Framebuffers& framebuffers)
            : mDevice(device), mTextures(textures), mFramebuffers(framebuffers), mDepthReader(device, framebuffers) {}
    ~Readbacks();

    void read(CmdReadTexture const& command);
    /// Copies at once: the buffer may change or go afterwards.
    void read(CmdReadBuffer const& command, Buffer const& buffer);
    /// Answers the ticket with nothing, in its turn.
    void refuse(Ticket ticket) { mPending.push_back({ .ticket = ticket }); }
    /// How many results are ready, the oldest first; `wait`: all of them.
    size_t countReady(bool wait) const;
    /// Delivers the oldest results, which must be ready.
    void answer(size_t count);

private:
    /// How the device returns texels of a format, and how they must be converted.
    struct Plan {
        GLenum format = 0, type = 0;
        uint32_t texelBytes = 0;
        Format repackTo = Format::None; ///< None: the bytes are right as they are
        bool isUnorm16 = false;         ///< floats that stand for multiples of 1 / 65535
    };
    struct Pending {
        Ticket ticket{};
        Plan plan{};
        uint64_t texels = 0;
        GLuint buffer = 0; ///< 0: there is nothing to deliver
        Fence fence{};
    };
    struct Source {
        GLuint framebuffer = 0;
        Rect rect;
        Format format;
        bool isUnorm16 = false;
    };
    std::optional<Source> open(CmdReadTexture const& command);
    Plan planFor(Format format) const; ///< queries the bound read framebuffer
    void deliver(Pending const& pending);

    Device& mDevice;
    Textures const& mTextures;
    Framebuffers& mFramebuffers;
    DepthReader mDepthReader;
    std::deque<Pending> mPending; // oldest first
    std::vector<std::byte> mPacked;
};

} // namespace filament_core::backend::gles
