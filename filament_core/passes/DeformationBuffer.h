// SPDX-License-Identifier: Apache-2.0
/// DeformationBuffer: skins and morph weights of one frame on the device, and the bind groups through which draws see
/// them: one for each texture of morph targets that is in use, with windows of the buffer as dynamic offsets.
///   In      a DeformationList.   Out: what to bind, by slot of scene::Deformations.
///   Memory  a sampler, a texel, and a buffer that grows to the largest frame and stays; none before the first frame
///           that deforms anything. A group that no frame used for kKeptFrames frames is given up, and with it what it
///           remembers of a texture.
///   Fails   std::bad_alloc; what is recorded then fits what is remembered.
///   Thread  the app thread, with the workers for the data. Records outside of passes.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/prepare/FramePacket.h"
#include "jobsystem/JobSystem.h"

#include <span>
#include <vector>

namespace filament::passes {

class DeformationBuffer {
public:
    static constexpr uint32_t kKeptFrames = 60; ///< of the frames that use this buffer

    void upload(backend::CommandStream& stream, jobs::JobSystem& jobs, backend::CommandBuffer& commands,
                prepare::DeformationList const& list);
    void destroy(backend::CommandStream& stream, backend::CommandBuffer& commands);

    std::span<const backend::CmdBindGroup> groups() const { return mBinds; }

private:
    struct Group {
        backend::TextureHandle deltas;
        backend::BindGroupHandle handle;
        uint32_t lastUse = 0;
    };

    void reserve(backend::CommandStream& stream, backend::CommandBuffer& commands, uint32_t bytes);
    backend::BindGroupHandle groupFor(backend::CommandStream& stream, backend::CommandBuffer& commands,
                                      backend::TextureHandle deltas);
    void makeFixed(backend::CommandStream& stream, backend::CommandBuffer& commands);
    void dropUnused(backend::CommandStream& stream, backend::CommandBuffer& commands, uint32_t keptFrames);

    backend::TextureHandle mNoDeltas; ///< in the place of morph targets that are not there
    backend::SamplerHandle mNearest;
    backend::BufferHandle mBuffer;
    uint32_t mBytes = 0; ///< capacity for blocks
    uint32_t mFrame = 0;
    std::vector<Group> mGroups; // a few: searched
    std::vector<backend::CmdBindGroup> mBinds;
};

} // namespace filament::passes
