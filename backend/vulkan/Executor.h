// SPDX-License-Identifier: Apache-2.0
/// Executor: the Vulkan Driver. Owns all objects of one device; has one function per command.
///   Serial   every replayed stream ends in a submission, and so does every CmdEndFrame; at most two frames are in
///            flight.
///   Answers  a ticket gets its result when its submission has finished, which is checked at the start of a stream, at
///            every CmdEndFrame, and in waitIdle(), which waits.
///   Thread   the driver thread; info() and statistics() any.
///   Fails    as Driver says. An object that could not be created is missing: draws, passes and copies with it are
///            skipped, and its read-backs return no bytes. After a lost device, streams are ignored.
///   Files    Executor.cpp frames and life time, ExecuteObjects.cpp, ExecuteContents.cpp, ExecutePasses.cpp.
#pragma once

#include "backend/api/Driver.h"
#include "backend/api/Slots.h"
#include "backend/vulkan/Barriers.h"
#include "backend/vulkan/Buffer.h"
#include "backend/vulkan/ComputeState.h"
#include "backend/vulkan/Descriptors.h"
#include "backend/vulkan/Device.h"
#include "backend/vulkan/DrawState.h"
#include "backend/vulkan/Pass.h"
#include "backend/vulkan/Pipeline.h"
#include "backend/vulkan/ProgramCache.h"
#include "backend/vulkan/Readbacks.h"
#include "backend/vulkan/Sampler.h"
#include "backend/vulkan/Submissions.h"
#include "backend/vulkan/Surface.h"
#include "backend/vulkan/Texture.h"
#include "backend/vulkan/Timers.h"
#include "backend/vulkan/Upload.h"

#include <array>
#include <memory>
#include <mutex>
#include <optional>

namespace filament_core::backend::vulkan {

class Executor final : public Driver {
public:
    static Result<std::unique_ptr<Executor>> create(DriverOptions const& options, ResultSink& sink,
                                                    QuirkFilter filter = nullptr);
    /// On a device chosen by the caller.
    static Result<std::unique_ptr<Executor>> create(std::unique_ptr<Device> device, ResultSink& sink,
                                                    std::filesystem::path const& cacheDirectory = {});
    ~Executor() override;

    DeviceInfo const& info() const override { return mDevice->info(); }
    void execute(CommandView commands) override;
    void waitIdle() override;
    DriverStatistics statistics() const override;

    Device& device() { return *mDevice; }

    // ---- one per command, called by replay()
    void execute(CmdCreateBuffer const& command);
    void execute(CmdCreateTexture const& command);
    void execute(CmdCreateSampler const& command);
    void execute(CmdCreateProgram const& command);
    void execute(CmdCreatePipeline const& command);
    void execute(CmdCreateBindGroup const& command);
    void execute(CmdCreateSurface const& command);
    void execute(CmdDestroyBuffer const& command);
    void execute(CmdDestroyTexture const& command);
    void execute(CmdDestroySampler const& command);
    void execute(CmdDestroyProgram const& command);
    void execute(CmdDestroyPipeline const& command);
    void execute(CmdDestroyBindGroup const& command);
    void execute(CmdDestroySurface const& command);

    void execute(CmdUpdateBuffer const& command);
    void execute(CmdUploadTexture const& command);
    void execute(CmdGenerateMips const& command);
    void execute(CmdBlit const& command);
    void execute(CmdReadBuffer const& command);
    void execute(CmdReadTexture const& command);
    void execute(CmdPresent const& command);

    void execute(CmdBeginPass const& command);
    void execute(CmdNextSubpass const& command);
    void execute(CmdEndPass const& command);
    void execute(CmdSetViewport const& command) { mDraws->setViewport(command.viewport); }
    void execute(CmdSetScissor const& command) { mDraws->setScissor(command.rect); }
    void execute(CmdSetStencilReference const& command) { mDraws->setStencilReference(command.front, command.back); }
    void execute(CmdBindPipeline const& command);
    void execute(CmdBindGroup const& command);
    void execute(CmdBindVertexBuffers const& command);
    void execute(CmdBindIndexBuffer const& command);
    void execute(CmdDraw const& command);
    void execute(CmdDrawIndexed const& command);
    void execute(CmdDispatch const& command);

    void execute(CmdBeginFrame const& command);
    void execute(CmdEndFrame const& command);
    void execute(CmdBeginTimer const& command);
    void execute(CmdEndTimer const& command);
    void execute(CmdPushGroup const& command);
    void execute(CmdPopGroup const& command);

private:
    static constexpr size_t kFramesInFlight = 2;

    Executor(std::unique_ptr<Device> device, ResultSink& sink);
    Result<void> initialize(std::filesystem::path const& cacheDirectory);

    // frames
    VkCommandBuffer commands(); ///< opened on first use
    void submit();
    void submitAtEnd();
    void answer();
    /// After a failed submission nothing can continue: the device counts as lost.
    bool check(VkResult result, std::string_view what);
    /// Reports OutOfMemory as such, anything else as `kind`.
    void report(Error const& error, DriverErrorKind kind = DriverErrorKind::Other);
    template <class H, class T>
    void store(Slots<H, T>& slots, H handle, Result<std::unique_ptr<T>> made, DriverErrorKind kind);
    void countPipeline(PipelineHandle handle); ///< unless it could not be made
    void label(std::string_view name);
    void endLabel();
    void publishStatistics();

    // contents
    void flushBarriers() { mBarriers.flush(mDevice->fn(), commands()); }
    std::optional<StagedBytes> stage(std::span<const std::byte> bytes, std::string_view target);
    bool canBlit(Texture const& texture, VkFormatFeatureFlags needed, std::string_view what);
    void recordBlit(Texture& source, VkImageBlit const& blit, Texture& target, Contents targetContents, Filter filter);
    void recordReadback(CmdReadTexture const& command, Texture& texture, std::unique_ptr<Buffer> target);

    // Destroyed from the last to the first, after the destructor has waited for the GPU.
    std::unique_ptr<Device> mDevice;
    ResultSink& mSink;
    std::optional<RenderPasses> mRenderPasses;
    std::optional<Framebuffers> mFramebuffers;
    std::optional<Layouts> mLayouts;
    std::optional<ProgramCache> mProgramCache;
    std::unique_ptr<Buffer> mZeros;
    Slots<BufferHandle, Buffer> mBuffers;
    Slots<TextureHandle, Texture> mTextures;
    Slots<SamplerHandle, Sampler> mSamplers;
    Slots<ProgramHandle, Program> mPrograms;
    Slots<PipelineHandle, Pipeline> mPipelines;
    Slots<BindGroupHandle, BindGroup> mBindGroups;
    Slots<SurfaceHandle, Surface> mSurfaces;
    std::optional<Timers> mTimers;
    std::optional<Readbacks> mReadbacks;
    std::optional<Submissions> mSubmissions;
    std::optional<Upload> mUpload;
    std::optional<DrawState> mDraws;
    ComputeState mCompute{ mPipelines, mBindGroups };
    Barriers mBarriers;
    std::optional<Pass> mPass;

    std::array<uint64_t, kFramesInFlight> mFrameSerials{}; // the last submission of the last frames
    size_t mFrameIndex = 0;
    bool mIsLost = false;

    DriverStatistics mStatistics; // of the driver thread
    mutable std::mutex mPublishedMutex;
    DriverStatistics mPublished;
};

} // namespace filament_core::backend::vulkan
