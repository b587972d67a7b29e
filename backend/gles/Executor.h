// SPDX-License-Identifier: Apache-2.0
/// Executor: the OpenGL ES Driver. Owns the context and everything created in it; one function per command.
///   Answers  a ticket gets its result when the device has reached it, which is checked after every stream, at every
///            CmdEndFrame, and in waitIdle(), which waits. At most two frames are in flight.
///   Thread   the driver thread; info() and statistics() any. Makes its context current on every entry, so that several
///            drivers can live on one thread.
///   Fails    as Driver says. Objects that could not be created were reported; commands that need them do nothing.
///            After a lost device, streams are ignored.
///   Files    Executor.cpp frames and life time, ExecuteObjects.cpp, ExecuteContents.cpp, ExecutePasses.cpp.
#pragma once

#include "backend/gles/ComputeState.h"
#include "backend/gles/Context.h"
#include "backend/gles/DrawState.h"
#include "backend/gles/Fence.h"
#include "backend/gles/Pass.h"
#include "backend/gles/Readbacks.h"
#include "backend/gles/Surface.h"
#include "backend/gles/Timers.h"
#include "base/Fifo.h"

#include <memory>
#include <mutex>

namespace filament_core::backend::gles {

class Executor final : public Driver {
public:
    /// `filter`, for tests, disables features of the device, to test the workarounds.
    static Result<std::unique_ptr<Executor>> create(DriverOptions const& options, ResultSink& sink,
                                                    QuirkFilter filter = nullptr);
    Executor(OpenDevice device, DriverOptions const& options, ResultSink& sink);
    ~Executor() override;

    DeviceInfo const& info() const override { return mDevice.info; }
    void execute(CommandView commands) override;
    void waitIdle() override;
    DriverStatistics statistics() const override;

    // ---- one per command, called by replay()
    void execute(CmdCreateBuffer const& command) { mBuffers.create(command.handle, command.desc); }
    void execute(CmdCreateTexture const& command) { mTextures.create(command.handle, command.desc); }
    void execute(CmdCreateSampler const& command) { mSamplers.create(command.handle, command.desc); }
    void execute(CmdCreateProgram const& command);
    void execute(CmdCreatePipeline const& command);
    void execute(CmdCreateBindGroup const& command);
    void execute(CmdCreateSurface const& command);
    void execute(CmdDestroyBuffer const& command);
    void execute(CmdDestroyTexture const& command);
    void execute(CmdDestroySampler const& command) { mSamplers.destroy(command.handle); }
    void execute(CmdDestroyProgram const& command) { mPrograms.take(command.handle); }
    void execute(CmdDestroyPipeline const& command) { mPipelines.take(command.handle); }
    void execute(CmdDestroyBindGroup const& command) { mBindGroups.take(command.handle); }
    void execute(CmdDestroySurface const& command) { mSurfaces.take(command.handle); }

    void execute(CmdUpdateBuffer const& command) { mBuffers.update(command.buffer, command.offset, command.bytes); }
    void execute(CmdUploadTexture const& command) { mTextures.upload(command); }
    void execute(CmdGenerateMips const& command);
    void execute(CmdBlit const& command);
    void execute(CmdReadBuffer const& command);
    void execute(CmdReadTexture const& command) { mReadbacks.read(command); }
    void execute(CmdPresent const& command);

    void execute(CmdBeginPass const& command);
    void execute(CmdNextSubpass const& command);
    void execute(CmdEndPass const& command);
    void execute(CmdSetViewport const& command) { mDevice.state.setViewport(command.viewport); }
    void execute(CmdSetScissor const& command) { mDevice.state.setScissor(command.rect); }
    void execute(CmdSetStencilReference const& command) { mDraws.setStencilReference(command.front, command.back); }
    void execute(CmdBindPipeline const& command);
    void execute(CmdBindGroup const& command);
    void execute(CmdBindVertexBuffers const& command);
    void execute(CmdBindIndexBuffer const& command);
    void execute(CmdDraw const& command);
    void execute(CmdDrawIndexed const& command);
    void execute(CmdDispatch const& command);

    void execute(CmdBeginFrame const&) {}
    void execute(CmdEndFrame const& command);
    void execute(CmdBeginTimer const& command) { mTimers.begin(command.ticket); }
    void execute(CmdEndTimer const& command) { mTimers.end(command.ticket); }
    void execute(CmdPushGroup const& command);
    void execute(CmdPopGroup const& command);

private:
    static constexpr size_t kFramesInFlight = 2;

    /// One side of a copy.
    struct Image {
        Texture const& texture;
        uint32_t level, layer;
        Rect rect;
    };

    // frames
    /// Answers the tickets that the device has finished; `wait`: all of them.
    void answer(bool wait);
    /// Starts the frame's work on the device; waits for the frame before the last one.
    void endFrame();
    void publishStatistics();

    // contents
    bool canRead(Texture const& texture, const char* what);
    bool canWrite(Texture const& texture, const char* what);
    void copy(Image const& source, Image const& target, Filter filter);

    // passes
    bool prepareDraw(bool indexed, DrawBase base);

    Context mContext; // outlives everything that is deleted in it
    const NativeDisplay mDisplay;
    Device mDevice;
    Buffers mBuffers;
    Textures mTextures;
    Samplers mSamplers;
    Framebuffers mFramebuffers;
    Vertices mVertices;
    Pass mPass;
    DrawState mDraws;
    Readbacks mReadbacks;
    Timers mTimers;
    Slots<ProgramHandle, std::shared_ptr<Program const>> mPrograms;
    Slots<PipelineHandle, Pipeline> mPipelines;
    Slots<BindGroupHandle, BindGroup> mBindGroups;
    Slots<SurfaceHandle, Surface> mSurfaces;
    ComputeState mCompute; // refers to the slots
    Fifo<Fence> mFrames;

    mutable std::mutex mPublishedMutex;
    DriverStatistics mPublished;
};

} // namespace filament_core::backend::gles
