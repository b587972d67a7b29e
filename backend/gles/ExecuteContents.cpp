// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Executor.h"

#include <algorithm>

namespace filament_core::backend::gles {
namespace {

// Blits and mip chains are framebuffer blits, whose fixed-function filter is also that of vkCmdBlitImage, so the bits
// agree; glGenerateMipmap may filter in any way.

Rect wholeLevel(DeviceTextureDesc const& desc, uint32_t level) {
    return { 0, 0, std::max(desc.width >> level, 1u), std::max(desc.height >> level, 1u) };
}

GLint right(Rect const& rect) { return rect.x + static_cast<GLint>(rect.width); }
GLint bottom(Rect const& rect) { return rect.y + static_cast<GLint>(rect.height); }

} // namespace

bool Executor::canRead(Texture const& texture, const char* what) {
    FormatInfo const& format = formatInfo(texture.desc.format);
    if (format.isRenderable && format.kind <= FormatKind::UnsignedInteger && texture.desc.samples == 1) return true;
    mDevice.error(DriverErrorKind::Other,
                  "{} needs single-sampled textures of a renderable colour format, not {} x{}; skipped", what,
                  format.name, texture.desc.samples);
    return false;
}

bool Executor::canWrite(Texture const& texture, const char* what) {
    if (!canRead(texture, what)) return false;
    if (isWritable(texture.desc.format)) return true;
    mDevice.error(DriverErrorKind::Other,
                  "{} would let the driver encode {}, which has other bits on other processors; upload the texels",
                  what, formatInfo(texture.desc.format).name);
    return false;
}

void Executor::copy(Image const& source, Image const& target, Filter filter) {
    const GLuint read = mFramebuffers.single(Framebuffers::Side::Read, source.texture, source.level, source.layer);
    const GLuint draw = mFramebuffers.single(Framebuffers::Side::Draw, target.texture, target.level, target.layer);
    mDevice.state.bindFramebuffers(draw, read);
    // Blits from sRGB decode, as vkCmdBlitImage does; with the conversion off they would copy the encoded values.
    if (formatInfo(source.texture.desc.format).isSrgb) mDevice.state.convertSrgb(true);
    mDevice.state.setScissor({}); // blits obey the scissor
    mDevice.gl.BlitFramebuffer(source.rect.x, source.rect.y, right(source.rect), bottom(source.rect), target.rect.x,
                               target.rect.y, right(target.rect), bottom(target.rect), GL_COLOR_BUFFER_BIT,
                               glFilter(filter));
}

void Executor::execute(CmdReadBuffer const& command) {
    Buffer const* buffer = mBuffers.find(command.buffer);
    if (!buffer) return mReadbacks.refuse(command.ticket);
    mReadbacks.read(command, *buffer);
}

void Executor::execute(CmdBlit const& command) {
    Texture const* source = mTextures.find(command.source);
    Texture const* target = mTextures.find(command.target);
    if (!source || !target || !canRead(*source, "a blit") || !canWrite(*target, "a blit")) return;
    copy({ *source, command.sourceLevel, command.sourceLayer, command.sourceRect },
         { *target, command.targetLevel, command.targetLayer, command.targetRect }, command.filter);
}

void Executor::execute(CmdGenerateMips const& command) {
    Texture const* texture = mTextures.find(command.texture);
    if (!texture || !canWrite(*texture, "generating mips")) return;
    for (uint32_t layer = 0; layer < texture->desc.layers; ++layer) {
        for (uint32_t level = 1; level < texture->desc.levels; ++level) {
            copy({ *texture, level - 1, layer, wholeLevel(texture->desc, level - 1) },
                 { *texture, level, layer, wholeLevel(texture->desc, level) }, Filter::Linear);
        }
    }
}

void Executor::execute(CmdPresent const& command) {
    Surface* const surface = mSurfaces.find(command.surface);
    Texture const* const texture = mTextures.find(command.texture);
    if (!surface || !texture || !canRead(*texture, "presenting")) return;
    if (!surface->present(mDevice, mFramebuffers, *texture)) return;
    ++mDevice.statistics.presents;
    mDevice.statistics.lastPresent = std::chrono::steady_clock::now();
}

} // namespace filament_core::backend::gles
