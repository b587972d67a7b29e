// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Readbacks.h"

#include "backend/gles/Repack.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament_core::backend::gles {
namespace {

/// Samplers multiply by a rounded 1 / 65535; the contract promises the correctly rounded quotient, as Vulkan's copies
/// of the integers give it.
void roundToUnorm16(std::span<const std::byte> floats, std::vector<std::byte>& rounded) {
    rounded.resize(floats.size());
    for (size_t at = 0; at < floats.size(); at += sizeof(float)) {
        float depth = 0;
        std::memcpy(&depth, floats.data() + at, sizeof depth);
        depth = std::round(depth * 65535.0f) / 65535.0f;
        std::memcpy(rounded.data() + at, &depth, sizeof depth);
    }
}

} // namespace

Readbacks::~Readbacks() {
    for (Pending const& pending : mPending) mDevice.gl.DeleteBuffers(1, &pending.buffer);
}

std::optional<Readbacks::Source> Readbacks::open(CmdReadTexture const& command) {
    Texture const* texture = mTextures.find(command.texture);
    if (!texture) return {};
    DeviceTextureDesc const& desc = texture->desc;
    if (!formatInfo(desc.format).isRenderable || desc.samples > 1) {
        mDevice.error(DriverErrorKind::Other,
                      "a read-back needs a single-sampled texture of a renderable format, not {} x{}; "
                      "its answer is empty",
                      formatInfo(desc.format).name, desc.samples);
        return {};
    }
    const bool readsAsFloat = mDevice.quirks.readDepth && desc.format != Format::D16; // D16 reads as integers only
    if (hasDepth(desc.format) && !readsAsFloat) {
        const GLuint copy = mDepthReader.copy(*texture, command.level, command.layer, command.rect);
        if (copy == 0) return {};
        return Source{
            copy, { 0, 0, command.rect.width, command.rect.height }, Format::R32F, desc.format == Format::D16
        };
    }
    const GLuint single = mFramebuffers.single(Framebuffers::Side::Read, *texture, command.level, command.layer);
    return Source{ single, command.rect, desc.format };
}

Readbacks::Plan Readbacks::planFor(Format format) const {
    if (hasDepth(format)) return { GL_DEPTH_COMPONENT, GL_FLOAT, 4 };
    GlFormat const& exact = glFormat(format);
    GLint readFormat = 0, readType = 0;
    mDevice.gl.GetIntegerv(GL_IMPLEMENTATION_COLOR_READ_FORMAT, &readFormat);
    mDevice.gl.GetIntegerv(GL_IMPLEMENTATION_COLOR_READ_TYPE, &readType);
    const bool direct = static_cast<GLenum>(readFormat) == exact.format && static_cast<GLenum>(readType) == exact.type;
    if (direct || !canRepack(format)) return { exact.format, exact.type, formatInfo(format).bytesPerBlock };
    // Formats that every device must offer (OpenGL ES 3.1, 16.1.2).
    FormatInfo const& info = formatInfo(format);
    const uint32_t bytes = genericBytes(format);
    if (info.kind == FormatKind::UnsignedInteger) return { GL_RGBA_INTEGER, GL_UNSIGNED_INT, bytes, format };
    return { GL_RGBA, static_cast<GLenum>(info.isFloat ? GL_FLOAT : GL_UNSIGNED_BYTE), bytes, format };
}

void Readbacks::read(CmdReadTexture const& command) {
    const std::optional<Source> source = open(command);
    if (!source) return refuse(command.ticket);
    Api const& gl = mDevice.gl;
    mDevice.state.bindFramebuffers(source->framebuffer, source->framebuffer);
    const uint64_t texels = static_cast<uint64_t>(source->rect.width) * source->rect.height;
    Pending pending{ command.ticket, planFor(source->format), texels, 0, {} };
    pending.plan.isUnorm16 = source->isUnorm16;
    mDevice.beginCreation();
    gl.GenBuffers(1, &pending.buffer);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, pending.buffer);
    gl.BufferData(GL_PIXEL_PACK_BUFFER, static_cast<GLsizeiptr>(pending.texels * pending.plan.texelBytes), nullptr,
                  GL_STREAM_READ);
    gl.ReadPixels(source->rect.x, source->rect.y, static_cast<GLsizei>(source->rect.width),
                  static_cast<GLsizei>(source->rect.height), pending.plan.format, pending.plan.type, nullptr);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    if (!mDevice.created("read-back of format", formatInfo(source->format).name)) {
        gl.DeleteBuffers(1, &pending.buffer);
        return refuse(command.ticket);
    }
    pending.fence = Fence(mDevice);
    mPending.push_back(std::move(pending));
}

void Readbacks::read(CmdReadBuffer const& command, Buffer const& buffer) {
    Api const& gl = mDevice.gl;
    Pending pending{ command.ticket, { .texelBytes = 1 }, command.size, 0, {} };
    const auto size = static_cast<GLsizeiptr>(command.size);
    mDevice.beginCreation();
    gl.GenBuffers(1, &pending.buffer);
    gl.BindBuffer(GL_COPY_READ_BUFFER, buffer.name);
    gl.BindBuffer(GL_COPY_WRITE_BUFFER, pending.buffer);
    gl.BufferData(GL_COPY_WRITE_BUFFER, size, nullptr, GL_STREAM_READ);
    gl.CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(command.offset), 0, size);
    if (!mDevice.created("read-back of", "a buffer")) {
        gl.DeleteBuffers(1, &pending.buffer);
        return refuse(command.ticket);
    }
    pending.fence = Fence(mDevice);
    mPending.push_back(std::move(pending));
}

void Readbacks::deliver(Pending const& pending) {
    if (pending.buffer == 0) return mDevice.sink.onReadback(pending.ticket, {});
    Api const& gl = mDevice.gl;
    const size_t bytes = pending.texels * pending.plan.texelBytes;
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, pending.buffer);
    const void* mapped = gl.MapBufferRange(GL_PIXEL_PACK_BUFFER, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT);
    if (mapped) {
        std::span<const std::byte> texels(static_cast<const std::byte*>(mapped), bytes);
        if (pending.plan.repackTo != Format::None) {
            mPacked.resize(pending.texels * formatInfo(pending.plan.repackTo).bytesPerBlock);
            repack(pending.plan.repackTo, texels, mPacked);
            texels = mPacked;
        } else if (pending.plan.isUnorm16) {
            roundToUnorm16(texels, mPacked);
            texels = mPacked;
        }
        mDevice.sink.onReadback(pending.ticket, texels);
        gl.UnmapBuffer(GL_PIXEL_PACK_BUFFER);
    } else {
        mDevice.checkLost();
        mDevice.created("read-back", "mapping its buffer");
        if (!mDevice.lost) mDevice.sink.onReadback(pending.ticket, {});
    }
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl.DeleteBuffers(1, &pending.buffer);
}

size_t Readbacks::countReady(bool wait) const {
    const auto isReady = [wait](Pending const& pending) {
        if (wait) pending.fence.wait();
        return wait || pending.fence.isReached();
    };
    return static_cast<size_t>(std::ranges::find_if_not(mPending, isReady) - mPending.begin());
}

void Readbacks::answer(size_t count) {
    for (; count > 0 && !mDevice.lost; --count) {
        deliver(mPending.front());
        mPending.pop_front();
    }
}

} // namespace filament_core::backend::gles
