// SPDX-License-Identifier: Apache-2.0
/// PassBlocks: the uniform blocks of a frame's passes, packed into one buffer: the size of a pass's target, the values
/// of a full-screen effect.
///   Use     begin() once per frame, add() while passes declare themselves, upload() once before the graph is recorded,
///           entry() while it is recorded.
///   Memory  three buffers, used in turn, so that no frame overwrites data that an earlier frame still reads. They grow
///           to the largest frame and stay. A steady frame allocates nothing. Its blocks have the same offsets as three
///           frames before, so the bind groups made then are found again.
///   Thread  the app thread. upload() records outside of passes.
///   Fails   std::bad_alloc; the recorded commands then still match the remembered state.
#pragma once

#include "backend/stream/CommandStream.h"

#include <array>
#include <span>
#include <vector>

namespace filament_core::passes {

/// The place of a block, valid from add() to the begin() of the next frame.
struct PassBlock {
    uint32_t offset = 0, bytes = 0;
};

class PassBlocks {
public:
    explicit PassBlocks(backend::CommandStream& stream) : mStream(stream) {}

    void begin();
    /// Copies the bytes. At most DeviceLimits::maxUniformBlockBytes.
    PassBlock add(std::span<const std::byte> bytes);
    /// Until the next add().
    std::span<const std::byte> bytesOf(PassBlock block) const {
        return std::span(mBytes).subspan(block.offset, block.bytes);
    }
    void upload(backend::CommandBuffer& commands);
    backend::BindGroupEntry entry(uint8_t binding, PassBlock block) const;
    void destroy(backend::CommandBuffer& commands);

private:
    struct Set {
        backend::BufferHandle buffer;
        size_t bytes = 0;
    };

    backend::CommandStream& mStream;
    std::array<Set, 3> mSets{};
    uint32_t mCurrent = 0;
    std::vector<std::byte> mBytes; // of the frame being described
};

} // namespace filament_core::passes
