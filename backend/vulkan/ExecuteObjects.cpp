// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Executor.h"

namespace filament_core::backend::vulkan {

template <class H, class T>
void Executor::store(Slots<H, T>& slots, H handle, Result<std::unique_ptr<T>> made, DriverErrorKind kind) {
    if (!made) report(made.error(), kind);
    slots.put(handle, made ? std::move(*made) : nullptr);
}

// ---------------------------------------------------------------------------------------------- create

void Executor::execute(CmdCreateBuffer const& command) {
    store(mBuffers, command.handle, Buffer::create(*mDevice, command.desc), DriverErrorKind::Other);
}

void Executor::execute(CmdCreateTexture const& command) {
    Texture const* const host = command.desc.placedOn ? mTextures.find(command.desc.placedOn) : nullptr;
    store(mTextures, command.handle, Texture::create(*mDevice, command.desc, host), DriverErrorKind::Other);
    if (Texture* texture = mTextures.find(command.handle)) mBarriers.add(*texture);
}

void Executor::execute(CmdCreateSampler const& command) {
    store(mSamplers, command.handle, Sampler::create(*mDevice, command.desc), DriverErrorKind::Other);
}

void Executor::execute(CmdCreateProgram const& command) {
    PipelineLayout const* const layout = mLayouts->get(command.desc.layout);
    if (!layout) {
        return report(fail(ErrorCode::OutOfMemory, "program '{}': no pipeline layout", command.desc.debugName));
    }
    store(mPrograms, command.handle, Program::create(*mDevice, *layout, command.desc), DriverErrorKind::ShaderCompile);
    if (mPrograms.find(command.handle)) ++mStatistics.programsCreated;
}

void Executor::execute(CmdCreatePipeline const& command) {
    PipelineDesc const& desc = command.desc;
    Program const* const program = mPrograms.find(desc.program);
    if (!program) {
        const Error error = fail(ErrorCode::NotFound,
                                 "pipeline '{}': its program could not be made or is gone; draws with it are skipped",
                                 desc.debugName);
        return report(error, DriverErrorKind::ShaderCompile);
    }
    if (program->compute() != VK_NULL_HANDLE) {
        store(mPipelines, command.handle,
              Pipeline::createCompute(*mDevice, mProgramCache->handle(), *program, desc.debugName),
              DriverErrorKind::ShaderCompile);
        return countPipeline(command.handle);
    }
    const VkRenderPass pass = mRenderPasses->get(keyOf(desc.pass));
    if (pass == VK_NULL_HANDLE) {
        return report(fail(ErrorCode::OutOfMemory, "pipeline '{}': no render pass", desc.debugName));
    }
    store(mPipelines, command.handle, Pipeline::create(*mDevice, mProgramCache->handle(), pass, *program, desc),
          DriverErrorKind::ShaderCompile);
    countPipeline(command.handle);
}

void Executor::countPipeline(PipelineHandle handle) {
    Pipeline const* const pipeline = mPipelines.find(handle);
    if (!pipeline) return;
    ++mStatistics.pipelinesCreated;
    mStatistics.pipelinesFromCache += pipeline->isFromCache();
    if (mPass->isOpen()) ++mStatistics.pipelinesCreatedInPasses;
}

void Executor::execute(CmdCreateBindGroup const& command) {
    BindGroupDesc const& desc = command.desc;
    SetLayout* const layout = mLayouts->get(desc.layout);
    if (!layout) return report(fail(ErrorCode::OutOfMemory, "bind group '{}': no set layout", desc.debugName));
    std::vector<ResolvedEntry> entries;
    entries.reserve(desc.entries.size());
    for (BindGroupEntry const& entry : desc.entries) {
        entries.push_back(
                { entry, mBuffers.find(entry.buffer), mTextures.find(entry.texture), mSamplers.find(entry.sampler) });
    }
    store(mBindGroups, command.handle, BindGroup::create(*mDevice, *layout, entries, desc.debugName),
          DriverErrorKind::Other);
}

void Executor::execute(CmdCreateSurface const& command) {
    const Ticket ticket = command.desc.spaces;
    if (!ticket)
        return store(mSurfaces, command.handle, Surface::create(*mDevice, command.desc), DriverErrorKind::Other);
    const Result<std::unique_ptr<Surface>> asked = Surface::create(*mDevice, command.desc);
    if (!asked) report(asked.error());
    const std::vector<OutputSpace> spaces = asked ? (*asked)->spaces() : std::vector<OutputSpace>{};
    mSink.onReadback(ticket, std::as_bytes(std::span(spaces)));
}

// ---------------------------------------------------------------------------------------------- destroy

void Executor::execute(CmdDestroyBuffer const& command) { mSubmissions->keep(mBuffers.take(command.handle)); }

void Executor::execute(CmdDestroyTexture const& command) {
    std::unique_ptr<Texture> texture = mTextures.take(command.handle);
    if (!texture) return;
    mBarriers.forget(*texture);
    // Kept objects end in this order: the framebuffers before the views that they refer to.
    for (auto& framebuffer : mFramebuffers->take(*texture)) mSubmissions->keep(std::move(framebuffer));
    mSubmissions->keep(std::move(texture));
}

void Executor::execute(CmdDestroySampler const& command) { mSubmissions->keep(mSamplers.take(command.handle)); }

void Executor::execute(CmdDestroyProgram const& command) { mPrograms.take(command.handle); } // no GPU work refers to it

void Executor::execute(CmdDestroyPipeline const& command) { mSubmissions->keep(mPipelines.take(command.handle)); }

void Executor::execute(CmdDestroyBindGroup const& command) { mSubmissions->keep(mBindGroups.take(command.handle)); }

void Executor::execute(CmdDestroySurface const& command) { mSurfaces.take(command.handle); } // waits for the device

} // namespace filament_core::backend::vulkan
