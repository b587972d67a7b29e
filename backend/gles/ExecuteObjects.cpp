// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Executor.h"

namespace filament_core::backend::gles {

// ---------------------------------------------------------------------------------------------- create

void Executor::execute(CmdCreateProgram const& command) {
    auto program = std::make_shared<Program const>(mDevice, command.desc);
    mPrograms.put(command.handle, std::make_unique<std::shared_ptr<Program const>>(std::move(program)));
}

void Executor::execute(CmdCreatePipeline const& command) {
    auto const* program = mPrograms.find(command.desc.program);
    Pipeline pipeline = makePipeline(command.desc, program ? *program : nullptr, mVertices);
    mPipelines.put(command.handle, std::make_unique<Pipeline>(std::move(pipeline)));
    ++mDevice.statistics.pipelinesCreated;
    mDevice.statistics.pipelinesCreatedInPasses += mPass.isOpen();
}

void Executor::execute(CmdCreateBindGroup const& command) {
    BindGroup group = makeBindGroup(command.desc, mBuffers, mTextures, mSamplers);
    mBindGroups.put(command.handle, std::make_unique<BindGroup>(std::move(group)));
}

void Executor::execute(CmdCreateSurface const& command) {
    if (command.desc.spaces) {
        // EGL takes a window once, and knows its display's spaces without.
        const std::vector<OutputSpace> spaces = Surface::spaces(mContext);
        return mDevice.sink.onReadback(command.desc.spaces, std::as_bytes(std::span(spaces)));
    }
    Result<std::unique_ptr<Surface>> surface = Surface::create(mContext, mDisplay, command.desc);
    if (!surface) return mDevice.error(DriverErrorKind::Other, "{}", surface.error().message);
    mSurfaces.put(command.handle, std::move(*surface));
}

// ---------------------------------------------------------------------------------------------- destroy

void Executor::execute(CmdDestroyBuffer const& command) {
    const std::unique_ptr<Buffer> buffer = mBuffers.take(command.handle);
    if (!buffer) return;
    // Before the name is free: vertex arrays that still hold it would keep the memory.
    mVertices.forget(buffer->name);
    mBuffers.destroy(*buffer);
}

void Executor::execute(CmdDestroyTexture const& command) {
    const std::unique_ptr<Texture> texture = mTextures.take(command.handle);
    if (!texture) return;
    // Framebuffers keep what is attached to them alive.
    mFramebuffers.forget(texture->name);
    mTextures.destroy(*texture);
}

} // namespace filament_core::backend::gles
