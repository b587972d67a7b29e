// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Commands.h"

namespace filament::backend::gles {

Commands::Commands(Device& device)
        : mDevice(device), mBuffers(device), mTextures(device), mFramebuffers(device), mVertices(device),
          mPass(device, mTextures, mFramebuffers), mTransfer(device, mTextures, mFramebuffers),
          mReadbacks(device, mTextures, mFramebuffers), mQueries(device), mDescriptors(device.state) {}

// ---------------------------------------------------------------------------------------------- objects

void Commands::execute(CmdCreateProgram const& command) {
    mPrograms.insert(command.handle, std::make_shared<Program const>(mDevice, command.desc));
}

void Commands::execute(CmdCreatePipeline const& command) {
    auto const* program = mPrograms.find(command.desc.program);
    mPipelines.insert(command.handle, makePipeline(command.desc, program ? *program : nullptr, mVertices));
    ++mDevice.statistics.pipelinesCreated;
    mDevice.statistics.pipelinesCreatedInPasses += mPass.isOpen();
}

void Commands::execute(CmdCreateBindGroup const& command) {
    mBindGroups.insert(command.handle, makeBindGroup(command.desc, mBuffers, mTextures));
}

void Commands::execute(CmdDestroyBuffer const& command) {
    const std::unique_ptr<Buffer> buffer = mBuffers.take(command.handle);
    if (!buffer) return;
    mVertices.forget(buffer->name);
    mBuffers.destroy(*buffer);
}

void Commands::execute(CmdDestroyTexture const& command) {
    const std::unique_ptr<Texture> texture = mTextures.take(command.handle);
    if (!texture) return;
    mFramebuffers.forget(texture->name);
    mTextures.destroy(*texture);
}

// ---------------------------------------------------------------------------------------------- passes

void Commands::unbindAll() {
    mPipeline = nullptr;
    mPipelineApplied = false;
    mSources = {};
    mStencilFront = mStencilBack = 0;
    mDescriptors.reset();
}

void Commands::execute(CmdBeginPass const& command) {
    unbindAll();
    mPass.begin(command.desc);
}

void Commands::execute(CmdNextSubpass const&) {
    unbindAll();
    mPass.nextSubpass();
}

void Commands::execute(CmdEndPass const&) { mPass.end(); }

void Commands::execute(CmdSetStencilReference const& command) {
    mStencilFront = command.front;
    mStencilBack = command.back;
    mPipelineApplied = false;
}

void Commands::execute(CmdBindPipeline const& command) {
    mPipeline = mPipelines.find(command.pipeline);
    mPipelineApplied = false;
    if (mPipeline && mPipeline->isUsable()) mDescriptors.setProgram(*mPipeline->program);
}

void Commands::execute(CmdBindGroup const& command) {
    mDescriptors.bind(command.index, mBindGroups.find(command.group), command.dynamicOffsets);
}

void Commands::execute(CmdBindVertexBuffers const& command) {
    for (uint32_t i = 0; i < command.count; ++i) {
        Buffer const* buffer = mBuffers.find(command.buffers[i]);
        mSources.slots[i] = { buffer ? buffer->name : 0, static_cast<GLintptr>(command.offsets[i]) };
    }
}

void Commands::execute(CmdBindIndexBuffer const& command) {
    Buffer const* buffer = mBuffers.find(command.buffer);
    mSources.indexBuffer = buffer ? buffer->name : 0;
    mSources.indexOffset = command.offset;
    mSources.indexType = command.type;
}

// ---------------------------------------------------------------------------------------------- draws

bool Commands::prepareDraw(bool indexed, DrawBase base) {
    if (!mPass.isUsable() || !mPipeline || !mPipeline->isUsable()) return false;
    if (!mPipelineApplied) {
        applyPipeline(mDevice.state, *mPipeline, mStencilFront, mStencilBack);
        mPipelineApplied = true;
    }
    if (!mDescriptors.apply() || !mVertices.bind(*mPipeline->vertices, mSources, indexed, base)) return false;
    ++mDevice.statistics.draws;
    return true;
}

void Commands::execute(CmdDraw const& command) {
    const bool based = mDevice.quirks.baseInstance;
    if (!prepareDraw(false, { .instance = based ? 0 : command.firstInstance })) return;
    const auto first = static_cast<GLint>(command.firstVertex);
    const auto vertices = static_cast<GLsizei>(command.vertexCount),
               instances = static_cast<GLsizei>(command.instanceCount);
    if (based && command.firstInstance != 0) {
        mDevice.gl.DrawArraysInstancedBaseInstance(mPipeline->topology, first, vertices, instances,
                                                   command.firstInstance);
    } else {
        mDevice.gl.DrawArraysInstanced(mPipeline->topology, first, vertices, instances);
    }
}

void Commands::execute(CmdDrawIndexed const& command) {
    Quirks const& quirks = mDevice.quirks;
    const DrawBase emulated{ quirks.baseInstance ? 0 : command.firstInstance,
                             quirks.baseVertex ? 0 : command.vertexOffset };
    if (!prepareDraw(true, emulated)) return;
    const bool wide = mSources.indexType == IndexType::UInt32;
    const GLenum type = wide ? GL_UNSIGNED_INT : GL_UNSIGNED_SHORT;
    const uint64_t start = mSources.indexOffset + static_cast<uint64_t>(command.firstIndex) * (wide ? 4 : 2);
    auto const* indices = reinterpret_cast<const void*>(static_cast<uintptr_t>(start)); // an offset in the bound buffer
    const auto count = static_cast<GLsizei>(command.indexCount),
               instances = static_cast<GLsizei>(command.instanceCount);
    const GLenum mode = mPipeline->topology;
    GlApi const& gl = mDevice.gl;
    if (quirks.baseInstance && command.firstInstance != 0) {
        gl.DrawElementsInstancedBaseVertexBaseInstance(mode, count, type, indices, instances, command.vertexOffset,
                                                       command.firstInstance);
    } else if (quirks.baseVertex && command.vertexOffset != 0) {
        gl.DrawElementsInstancedBaseVertex(mode, count, type, indices, instances, command.vertexOffset);
    } else {
        gl.DrawElementsInstanced(mode, count, type, indices, instances);
    }
}

// ---------------------------------------------------------------------------------------------- frames

void Commands::execute(CmdEndFrame const&) {
    mQueries.endFrame();
    mDevice.checkLost();
#ifndef NDEBUG
    const GLenum error = mDevice.takeError();
    if (error != GL_NO_ERROR && !mDevice.messages) {
        mDevice.error(DriverErrorKind::Validation, "{} during this frame; DriverOptions::validation names the call",
                      glErrorName(error));
    }
#endif
    poll(false);
}

void Commands::poll(bool wait) {
    mReadbacks.poll(wait);
    mQueries.poll(wait);
}

void Commands::execute(CmdPushGroup const& command) {
    if (!mDevice.messages) return;
    mDevice.gl.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(command.name.size()),
                              command.name.data());
}

void Commands::execute(CmdPopGroup const&) {
    if (mDevice.messages) mDevice.gl.PopDebugGroup();
}

} // namespace filament::backend::gles
