// SPDX-License-Identifier: Apache-2.0
/// DeformationBuffer: poses of one frame on the device, and their bind groups: one for each texture of morph targets in
/// use, with windows of the buffer of uniforms as dynamic offsets.
///   In      a DeformationList.   Out: what to bind, by slot of scene::Deformations.
///   Memory  a sampler, a texel, and a buffer and a texture of bones that grow to the largest frame and stay; none
///           before the first frame with deformations. A group that no frame used for kKeptFrames frames is
///           dropped, with everything known about its texture.
///   Limits  the bones and weights that fit into a texture of the device: at least a million bones. Further meshes are
///           drawn at rest.
///   Fails   std::bad_alloc; recorded commands and remembered objects still agree.
///   Thread  the app thread, with the workers for the data. Records outside of passes.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/prepare/FramePacket.h"
#include "jobsystem/JobSystem.h"

#include <span>
#include <vector>

namespace filament_core::passes {

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
    void reserveRows(backend::CommandStream& stream, backend::CommandBuffer& commands, uint32_t rows, uint32_t most);
    uint32_t uploadBones(backend::CommandStream& stream, jobs::JobSystem& jobs, backend::CommandBuffer& commands,
                         prepare::DeformationList const& list);
    backend::BindGroupHandle groupFor(backend::CommandStream& stream, backend::CommandBuffer& commands,
                                      backend::TextureHandle deltas);
    void makeFixed(backend::CommandStream& stream, backend::CommandBuffer& commands);
    void dropUnused(backend::CommandStream& stream, backend::CommandBuffer& commands, uint32_t keptFrames);

    backend::TextureHandle mNoTexels; ///< replaces missing morph targets
    backend::SamplerHandle mNearest;
    backend::BufferHandle mBuffer;
    uint32_t mBytes = 0; ///< capacity for blocks
    backend::TextureHandle mBones;
    uint32_t mRows = 0; ///< of bones
    uint32_t mFrame = 0;
    std::vector<Group> mGroups; // a few: searched
    std::vector<backend::CmdBindGroup> mBinds;
};

} // namespace filament_core::passes
