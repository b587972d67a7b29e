// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Pass.h"

#include <algorithm>

namespace filament_core::backend::gles {
namespace {

// A blit may return any value between those of the samples (OpenGL ES 3.1, 16.2.1). Vulkan offers sample 0 on every
// device.
constexpr std::string_view kDepthResolveText = R"(#version 310 es
precision highp float;
layout(binding = 0) uniform highp sampler2DMS samples;
void main() { gl_FragDepth = texelFetch(samples, ivec2(gl_FragCoord.xy), 0).r; }
)";

} // namespace

Pass::Pass(Device& device, Textures const& textures, Framebuffers& framebuffers)
        : mDevice(device), mTextures(textures), mFramebuffers(framebuffers),
          mDepthResolve(device, kDepthResolveText, "depth resolve") {}

void Pass::begin(PassDesc const& desc) {
    mDesc = desc;
    mSubpass = 0;
    mOpen = true;
    FramebufferKey key;
    mFramebuffer = collect(key) ? mFramebuffers.get(key, desc.debugName) : 0;
    ++mDevice.statistics.passes;
    if (!isUsable()) return;
    ContextState& state = mDevice.state;
    state.bindFramebuffers(mFramebuffer, mFramebuffer);
    coverArea();
    // At the start: a tiled device then need not load what is discarded.
    invalidate(discardedByLoad());
    clear();
}

void Pass::nextSubpass() {
    ++mSubpass;
    if (isUsable()) coverArea();
}

void Pass::coverArea() {
    Rect const& area = mDesc.area;
    mDevice.state.setScissor(area);
    mDevice.state.setViewport({ static_cast<float>(area.x), static_cast<float>(area.y), static_cast<float>(area.width),
                                static_cast<float>(area.height) });
}

void Pass::end() {
    mOpen = false;
    if (!isUsable()) return;
    for (uint32_t i = 0; i < mDesc.layout.colorCount; ++i) {
        if ((mDesc.layout.resolveMask >> i) & 1) resolve(i);
    }
    if (mDesc.layout.resolvesDepth) resolveDepth();
    mDevice.state.bindFramebuffers(mFramebuffer, mFramebuffer);
    // After the resolves, which read the samples that are discarded here.
    invalidate(discardedByStore());
    mFramebuffer = 0;
}

// ---------------------------------------------------------------------------------------------- attachments

bool Pass::add(FramebufferKey& key, Attachment const& attachment, bool isDepth) {
    Texture const* texture = mTextures.find(attachment.texture);
    if (!texture) return false;
    if (isDepth) {
        key.setDepth(*texture, attachment.level, attachment.layer);
    } else {
        if (formatInfo(texture->desc.format).isSrgb) mDevice.state.convertSrgb(false); // see attachmentFormat()
        key.addColor(*texture, attachment.level, attachment.layer);
    }
    mCoversAll = mCoversAll && std::max(texture->desc.width >> attachment.level, 1u) == mDesc.area.width &&
                 std::max(texture->desc.height >> attachment.level, 1u) == mDesc.area.height;
    return true;
}

bool Pass::collect(FramebufferKey& key) {
    PassLayout const& layout = mDesc.layout;
    mCoversAll = mDesc.area.x == 0 && mDesc.area.y == 0;
    for (uint32_t i = 0; i < layout.colorCount; ++i) {
        if (!add(key, mDesc.colors[i], false)) return false;
    }
    return layout.depthFormat == Format::None || add(key, mDesc.depth, true);
}

GLenum Pass::depthPoint() const {
    return hasStencil(mDesc.layout.depthFormat) ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

// ---------------------------------------------------------------------------------------------- load and store

void Pass::clear() {
    const bool depth = mDesc.layout.depthFormat != Format::None && mDesc.depth.load == LoadOp::Clear;
    bool color = false;
    for (uint32_t i = 0; i < mDesc.layout.colorCount; ++i) color |= mDesc.colors[i].load == LoadOp::Clear;
    if (!depth && !color) return;
    mDevice.state.allowClears(mDesc.layout.colorCount);
    for (uint32_t i = 0; i < mDesc.layout.colorCount; ++i) {
        if (mDesc.colors[i].load == LoadOp::Clear) clearColor(i);
    }
    if (depth) clearDepth();
}

void Pass::clearColor(uint32_t index) {
    std::array<float, 4> const& value = mDesc.colors[index].clear;
    if (formatInfo(mDesc.layout.colorFormats[index]).kind == FormatKind::UnsignedInteger) {
        const GLuint words[] = { static_cast<GLuint>(value[0]), static_cast<GLuint>(value[1]),
                                 static_cast<GLuint>(value[2]), static_cast<GLuint>(value[3]) };
        mDevice.gl.ClearBufferuiv(GL_COLOR, static_cast<GLint>(index), words);
    } else {
        mDevice.gl.ClearBufferfv(GL_COLOR, static_cast<GLint>(index), value.data());
    }
}

void Pass::clearDepth() {
    std::array<float, 4> const& value = mDesc.depth.clear;
    if (hasStencil(mDesc.layout.depthFormat)) {
        mDevice.gl.ClearBufferfi(GL_DEPTH_STENCIL, 0, value[0], static_cast<GLint>(value[1]));
    } else {
        mDevice.gl.ClearBufferfv(GL_DEPTH, 0, value.data());
    }
}

Pass::Points Pass::discardedByLoad() const {
    Points points;
    for (uint32_t i = 0; i < mDesc.layout.colorCount; ++i) {
        if (mDesc.colors[i].load == LoadOp::Discard) points.add(GL_COLOR_ATTACHMENT0 + i);
    }
    if (mDesc.layout.depthFormat != Format::None && mDesc.depth.load == LoadOp::Discard) points.add(depthPoint());
    return points;
}

Pass::Points Pass::discardedByStore() const {
    Points points;
    for (uint32_t i = 0; i < mDesc.layout.colorCount; ++i) {
        if (mDesc.colors[i].store == StoreOp::Discard) points.add(GL_COLOR_ATTACHMENT0 + i);
    }
    if (mDesc.layout.depthFormat != Format::None && mDesc.depth.store == StoreOp::Discard) points.add(depthPoint());
    return points;
}

void Pass::invalidate(Points const& points) {
    if (points.count == 0) return;
    Rect const& area = mDesc.area;
    if (mCoversAll) {
        mDevice.gl.InvalidateFramebuffer(GL_FRAMEBUFFER, points.count, points.at.data());
    } else {
        mDevice.gl.InvalidateSubFramebuffer(GL_FRAMEBUFFER, points.count, points.at.data(), area.x, area.y,
                                            static_cast<GLsizei>(area.width), static_cast<GLsizei>(area.height));
    }
}

void Pass::resolve(uint32_t index) {
    Texture const* target = mTextures.find(mDesc.colors[index].resolve);
    if (!target) return;
    Api const& gl = mDevice.gl;
    Rect const& area = mDesc.area;
    const GLint right = area.x + static_cast<GLint>(area.width), bottom = area.y + static_cast<GLint>(area.height);
    const GLuint draw = mFramebuffers.single(Framebuffers::Side::Draw, *target, 0, 0);
    mDevice.state.bindFramebuffers(draw, mFramebuffer);
    mDevice.state.setScissor({}); // blits obey the scissor
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0 + index);
    gl.BlitFramebuffer(area.x, area.y, right, bottom, area.x, area.y, right, bottom, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Pass::resolveDepth() {
    Texture const* from = mTextures.find(mDesc.depth.texture);
    Texture const* to = mTextures.find(mDesc.depth.resolve);
    if (!from || !to) return;
    const GLuint target = mFramebuffers.single(Framebuffers::Side::Draw, *to, 0, 0);
    constexpr DepthStencilState kWriteAlways{ .depthCompare = CompareOp::Always, .depthWrite = true };
    mDepthResolve.draw(target, mDesc.area, from->target, from->name, kWriteAlways);
}

} // namespace filament_core::backend::gles
