// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Executor.h"

namespace filament_core::backend::gles {

// ---------------------------------------------------------------------------------------------- begin and end

void Executor::execute(CmdBeginPass const& command) {
    mDraws.beginSubpass();
    mCompute.reset();
    mPass.begin(command.desc);
}

void Executor::execute(CmdNextSubpass const&) {
    mDraws.beginSubpass();
    mPass.nextSubpass();
}

void Executor::execute(CmdEndPass const&) {
    mPass.end();
    mCompute.reset();
}

// ---------------------------------------------------------------------------------------------- bindings

void Executor::execute(CmdBindPipeline const& command) {
    if (mPass.isOpen()) {
        mDraws.setPipeline(mPipelines.find(command.pipeline));
    } else {
        mCompute.setPipeline(command.pipeline);
    }
}

void Executor::execute(CmdBindGroup const& command) {
    if (mPass.isOpen()) {
        mDraws.setGroup(command.index, mBindGroups.find(command.group), command.dynamicOffsets);
    } else {
        mCompute.setGroup(command);
    }
}

void Executor::execute(CmdBindVertexBuffers const& command) {
    for (uint32_t i = 0; i < command.count; ++i) {
        mDraws.setVertexBuffer(i, mBuffers.find(command.buffers[i]), command.offsets[i]);
    }
}

void Executor::execute(CmdBindIndexBuffer const& command) {
    mDraws.setIndexBuffer(mBuffers.find(command.buffer), command.offset, command.type);
}

bool Executor::prepareDraw(bool indexed, DrawBase base) {
    if (!mPass.isUsable() || !mDraws.prepareDraw(indexed, base)) return false;
    ++mDevice.statistics.draws;
    return true;
}

void Executor::execute(CmdDraw const& command) {
    const bool based = mDevice.quirks.baseInstance;
    if (!prepareDraw(false, { .instance = based ? 0 : command.firstInstance })) return;
    const auto first = static_cast<GLint>(command.firstVertex);
    const auto vertices = static_cast<GLsizei>(command.vertexCount),
               instances = static_cast<GLsizei>(command.instanceCount);
    if (based && command.firstInstance != 0) {
        mDevice.gl.DrawArraysInstancedBaseInstance(mDraws.topology(), first, vertices, instances,
                                                   command.firstInstance);
    } else {
        mDevice.gl.DrawArraysInstanced(mDraws.topology(), first, vertices, instances);
    }
}

void Executor::execute(CmdDrawIndexed const& command) {
    Quirks const& quirks = mDevice.quirks;
    const DrawBase emulated{ quirks.baseInstance ? 0 : command.firstInstance,
                             quirks.baseVertex ? 0 : command.vertexOffset };
    if (!prepareDraw(true, emulated)) return;
    const bool wide = mDraws.sources().indexFormat == IndexFormat::UInt32;
    const GLenum type = wide ? GL_UNSIGNED_INT : GL_UNSIGNED_SHORT;
    const uint64_t start = mDraws.sources().indexOffset + static_cast<uint64_t>(command.firstIndex) * (wide ? 4 : 2);
    auto const* indices = reinterpret_cast<const void*>(static_cast<uintptr_t>(start)); // an offset in the bound buffer
    const auto count = static_cast<GLsizei>(command.indexCount),
               instances = static_cast<GLsizei>(command.instanceCount);
    const GLenum mode = mDraws.topology();
    Api const& gl = mDevice.gl;
    if (quirks.baseInstance && command.firstInstance != 0) {
        gl.DrawElementsInstancedBaseVertexBaseInstance(mode, count, type, indices, instances, command.vertexOffset,
                                                       command.firstInstance);
    } else if (quirks.baseVertex && command.vertexOffset != 0) {
        gl.DrawElementsInstancedBaseVertex(mode, count, type, indices, instances, command.vertexOffset);
    } else {
        gl.DrawElementsInstanced(mode, count, type, indices, instances);
    }
}

// ---------------------------------------------------------------------------------------------- dispatches

void Executor::execute(CmdDispatch const& command) {
    if (mPass.isOpen() || !mCompute.prepareDispatch()) return;
    mDevice.gl.DispatchCompute(command.groupsX, command.groupsY, command.groupsZ);
    // Covers everything that may read or overwrite a storage buffer. Dispatches are few, so the barrier is not narrowed
    // to what the next command needs.
    mDevice.gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT |
                             GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    ++mDevice.statistics.dispatches;
}

} // namespace filament_core::backend::gles
