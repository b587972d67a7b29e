// SPDX-License-Identifier: Apache-2.0
/// Commands: one execute() per command of backend/api/Commands.h.
///   Thread  the driver thread, context current.
///   Fails   what could not be made was reported when it was made; commands that need it do nothing.
#pragma once

#include "backend/gles/Descriptors.h"
#include "backend/gles/Pass.h"
#include "backend/gles/Pipeline.h"
#include "backend/gles/Query.h"
#include "backend/gles/Readback.h"
#include "backend/gles/Transfer.h"

namespace filament::backend::gles {

class Commands {
public:
    explicit Commands(Device& device);

    void execute(CmdCreateBuffer const& command) { mBuffers.create(command.handle, command.desc); }
    void execute(CmdCreateTexture const& command) { mTextures.create(command.handle, command.desc); }
    void execute(CmdCreateSampler const& command) { mTextures.createSampler(command.handle, command.desc); }
    void execute(CmdCreateProgram const& command);
    void execute(CmdCreatePipeline const& command);
    void execute(CmdCreateBindGroup const& command);
    void execute(CmdDestroyBuffer const& command);
    void execute(CmdDestroyTexture const& command);
    void execute(CmdDestroySampler const& command) { mTextures.destroySampler(command.handle); }
    void execute(CmdDestroyProgram const& command) { mPrograms.remove(command.handle); }
    void execute(CmdDestroyPipeline const& command) { mPipelines.remove(command.handle); }
    void execute(CmdDestroyBindGroup const& command) { mBindGroups.remove(command.handle); }

    void execute(CmdUpdateBuffer const& command) { mBuffers.update(command.buffer, command.offset, command.bytes); }
    void execute(CmdUploadTexture const& command) { mTextures.upload(command); }
    void execute(CmdGenerateMips const& command) { mTransfer.generateMips(command.texture); }
    void execute(CmdBlit const& command) { mTransfer.blit(command); }
    void execute(CmdReadTexture const& command) { mReadbacks.read(command); }

    void execute(CmdBeginPass const& command);
    void execute(CmdNextSubpass const& command);
    void execute(CmdEndPass const& command);
    void execute(CmdSetViewport const& command) { mDevice.state.setViewport(command.viewport); }
    void execute(CmdSetScissor const& command) { mDevice.state.setScissor(command.rect); }
    void execute(CmdSetStencilReference const& command);
    void execute(CmdBindPipeline const& command);
    void execute(CmdBindGroup const& command);
    void execute(CmdBindVertexBuffers const& command);
    void execute(CmdBindIndexBuffer const& command);
    void execute(CmdDraw const& command);
    void execute(CmdDrawIndexed const& command);

    void execute(CmdBeginFrame const&) {}
    void execute(CmdEndFrame const& command);
    void execute(CmdBeginTimer const& command) { mQueries.beginTimer(command.ticket); }
    void execute(CmdEndTimer const& command) { mQueries.endTimer(command.ticket); }
    void execute(CmdPushGroup const& command);
    void execute(CmdPopGroup const& command);

    /// Answers the tickets that the device has finished; `wait`: all of them.
    void poll(bool wait);

private:
    using Programs = Table<ProgramTag, std::shared_ptr<Program const>>;

    void unbindAll();
    /// Brings everything a draw needs into the context. False: the draw is skipped.
    bool prepareDraw(bool indexed, DrawBase base);

    Device& mDevice;
    Buffers mBuffers;
    Textures mTextures;
    Framebuffers mFramebuffers;
    Vertices mVertices;
    Pass mPass;
    Transfer mTransfer;
    Readbacks mReadbacks;
    Queries mQueries;
    Descriptors mDescriptors;
    Programs mPrograms;
    Table<PipelineTag, Pipeline> mPipelines;
    Table<BindGroupTag, BindGroup> mBindGroups;

    // What the pass has bound.
    Pipeline const* mPipeline = nullptr;
    bool mPipelineApplied = false;
    VertexSources mSources;
    uint8_t mStencilFront = 0, mStencilBack = 0;
};

} // namespace filament::backend::gles
