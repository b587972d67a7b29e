// SPDX-License-Identifier: Apache-2.0
/// Buffers: vertex, index, uniform and storage memory.
///   Thread  the driver thread.
///   Fails   out of memory is reported; the buffer stays in the table with name 0, and commands that use it are
///           skipped.
#pragma once

#include "backend/api/Slots.h"
#include "backend/gles/Device.h"

namespace filament_core::backend::gles {

struct Buffer {
    GLuint name = 0; ///< 0: creation failed
    uint64_t size = 0;
    GLenum hint = GL_STATIC_DRAW;
};

class Buffers {
public:
    explicit Buffers(Device& device) : mDevice(device) {}
    ~Buffers();

    void create(BufferHandle handle, BufferDesc const& desc);
    /// The deleted GL name (0 if none): other caches must forget it first, see take().
    std::unique_ptr<Buffer> take(BufferHandle handle) { return mBuffers.take(handle); }
    void destroy(Buffer const& buffer);
    void update(BufferHandle handle, uint64_t offset, std::span<const std::byte> bytes);

    /// Null if it does not exist or could not be created.
    Buffer const* find(BufferHandle handle) const;

private:
    Device& mDevice;
    Slots<BufferHandle, Buffer> mBuffers;
};

} // namespace filament_core::backend::gles
