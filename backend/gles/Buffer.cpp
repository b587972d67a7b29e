// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Buffer.h"

namespace filament_core::backend::gles {

// Not part of vertex arrays or uniform slots, so binding it disturbs nothing that ContextState tracks.
static constexpr GLenum kEditTarget = GL_COPY_WRITE_BUFFER;

Buffers::~Buffers() {
    mBuffers.forEach([this](Buffer& buffer) { destroy(buffer); });
}

void Buffers::create(BufferHandle handle, BufferDesc const& desc) {
    Api const& gl = mDevice.gl;
    const bool changesOften = has(desc.usage, BufferUsage::Uniform | BufferUsage::Storage);
    Buffer buffer{ .size = desc.size, .hint = static_cast<GLenum>(changesOften ? GL_DYNAMIC_DRAW : GL_STATIC_DRAW) };
    mDevice.beginCreation();
    gl.GenBuffers(1, &buffer.name);
    gl.BindBuffer(kEditTarget, buffer.name);
    gl.BufferData(kEditTarget, static_cast<GLsizeiptr>(desc.size), nullptr, buffer.hint);
    if (mDevice.created("buffer", desc.debugName)) {
        mDevice.label(GL_BUFFER, buffer.name, desc.debugName);
        mDevice.statistics.deviceBytes += desc.size;
    } else {
        gl.DeleteBuffers(1, &buffer.name);
        buffer.name = 0;
    }
    mBuffers.put(handle, std::make_unique<Buffer>(buffer));
}

void Buffers::destroy(Buffer const& buffer) {
    if (buffer.name == 0) return;
    // Before the name is free: the next buffer may get it, and would seem to be bound already.
    mDevice.state.forgetBuffer(buffer.name);
    mDevice.gl.DeleteBuffers(1, &buffer.name);
    mDevice.statistics.deviceBytes -= buffer.size;
}

void Buffers::update(BufferHandle handle, uint64_t offset, std::span<const std::byte> bytes) {
    Buffer const* buffer = find(handle);
    if (!buffer || bytes.empty()) return;
    FILAMENT_ASSERT(offset + bytes.size() <= buffer->size, "an update stays inside its buffer");
    Api const& gl = mDevice.gl;
    gl.BindBuffer(kEditTarget, buffer->name);
    if (bytes.size() == buffer->size) {
        // Allocate new storage instead of waiting for draws that still read the old one.
        gl.BufferData(kEditTarget, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), buffer->hint);
    } else {
        gl.BufferSubData(kEditTarget, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                         bytes.data());
    }
}

Buffer const* Buffers::find(BufferHandle handle) const {
    Buffer const* buffer = mBuffers.find(handle);
    return buffer && buffer->name ? buffer : nullptr;
}

} // namespace filament_core::backend::gles
