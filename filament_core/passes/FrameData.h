// SPDX-License-Identifier: Apache-2.0
/// FrameData: the uniform data of a frame on the device, and the bind group through which shaders see it.
///   In      a FramePacket.   Out: a bind group for kGroupView and offsets into it.
///   Memory  three sets of buffers, used in turn, so that no frame overwrites what an earlier one still reads. They
///           grow to the largest frame and stay. Objects are written straight into the memory of the command buffer.
///   Fails   std::bad_alloc; what is recorded then fits what is remembered.
///   Thread  the app thread, with the workers for the objects. Records outside of passes.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/passes/DeformationBuffer.h"
#include "filament_core/prepare/FramePacket.h"
#include "jobsystem/JobSystem.h"

#include <array>

namespace filament::passes {

/// The textures of the view group; every handle is set.
struct ViewTextures {
    backend::TextureHandle specular, dfg, sky, irradiance;
    backend::SamplerHandle trilinear; ///< of the specular levels
    backend::SamplerHandle bilinear;  ///< of sky, irradiance and table: one level each
    friend bool operator==(ViewTextures const&, ViewTextures const&) = default;
};

class FrameData {
public:
    explicit FrameData(backend::CommandStream& stream) : mStream(stream) {}

    /// Uploads the packet into the next set and makes its bind group current.
    void upload(jobs::JobSystem& jobs, backend::CommandBuffer& commands, prepare::FramePacket const& packet,
                ViewTextures const& textures);
    void destroy(backend::CommandBuffer& commands);

    backend::BindGroupHandle viewGroup() const { return mSets[mCurrent].view; }
    /// Group 0 of post-process materials: the frame block only.
    backend::BindGroupHandle postGroup() const { return mSets[mCurrent].post; }
    /// By slot of scene::Deformations; those that are not visible are not set.
    std::span<const backend::CmdBindGroup> deformations() const { return mSets[mCurrent].deformation.groups(); }
    /// Dynamic offsets of viewGroup() for the window that holds `object`.
    static backend::CmdBindGroup bindView(backend::BindGroupHandle group, uint32_t object);

private:
    struct Set {
        backend::BufferHandle frame, lights, objects;
        uint32_t windows = 0; ///< capacity of `objects`
        ViewTextures textures{};
        backend::BindGroupHandle view, post;
        DeformationBuffer deformation;
    };

    backend::BufferHandle createBuffer(backend::CommandBuffer& commands, uint64_t bytes, const char* name);
    void release(backend::CommandBuffer& commands, backend::BindGroupHandle& group);
    void release(backend::CommandBuffer& commands, backend::BufferHandle& buffer);
    void makeObjects(backend::CommandBuffer& commands, Set& set, uint32_t windows);
    void makeFixed(backend::CommandBuffer& commands, Set& set);
    void bind(backend::CommandBuffer& commands, Set& set, ViewTextures const& textures);
    static void uploadObjects(jobs::JobSystem& jobs, backend::CommandBuffer& commands, Set const& set,
                              prepare::ObjectList const& list);

    backend::CommandStream& mStream;
    std::array<Set, 3> mSets{};
    uint32_t mCurrent = 0;
};

} // namespace filament::passes
