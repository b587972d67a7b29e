// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Framebuffers.h"

#include "base/Hash.h"

#include <algorithm>

namespace filament_core::backend::gles {
namespace {

ImageKey imageOf(Texture const& texture, uint32_t level, uint32_t layer) {
    return { texture.name, texture.target, static_cast<uint16_t>(layer), static_cast<uint16_t>(level) };
}

} // namespace

void FramebufferKey::addColor(Texture const& texture, uint32_t level, uint32_t layer) {
    colors[colorCount++] = imageOf(texture, level, layer);
}

void FramebufferKey::setDepth(Texture const& texture, uint32_t level, uint32_t layer) {
    depth = imageOf(texture, level, layer);
    depthPoint = hasStencil(texture.desc.format) ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

size_t Framebuffers::Hash::operator()(FramebufferKey const& key) const { return hashValue(key); }

Framebuffers::~Framebuffers() {
    for (auto const& [key, object] : mObjects) destroy(object);
    for (Single const& single : mSingles) destroy(single.object);
}

void Framebuffers::destroy(GLuint object) {
    if (object == 0) return;
    mDevice.state.forgetFramebuffer(object);
    mDevice.gl.DeleteFramebuffers(1, &object);
}

GLuint Framebuffers::get(FramebufferKey const& wanted, std::string_view what) {
    auto const [entry, isNew] = mObjects.try_emplace(wanted, 0);
    // Zero is kept, too: a set that the driver refuses is reported once, not in each frame.
    if (isNew) entry->second = create(wanted, what);
    return entry->second;
}

GLuint Framebuffers::single(Side side, Texture const& texture, uint32_t level, uint32_t layer) {
    const bool depth = hasDepth(texture.desc.format);
    Single& single = mSingles[static_cast<size_t>(side) * 2 + depth];
    const ImageKey image = imageOf(texture, level, layer);
    if (single.object == 0) mDevice.gl.GenFramebuffers(1, &single.object);
    if (single.image == image) return single.object;
    mDevice.state.bindFramebuffers(single.object, single.object);
    attach(depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, image); // other attachment points are always empty
    single.image = image;
    return single.object;
}

void Framebuffers::attach(GLenum point, ImageKey const& image) {
    Api const& gl = mDevice.gl;
    if (isLayered(image.target)) {
        gl.FramebufferTextureLayer(GL_FRAMEBUFFER, point, image.texture, image.level, image.layer);
    } else {
        const bool cube = image.target == GL_TEXTURE_CUBE_MAP;
        const GLenum target = cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + image.layer : image.target;
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, point, target, image.texture, image.level);
    }
}

GLuint Framebuffers::create(FramebufferKey const& wanted, std::string_view what) {
    Api const& gl = mDevice.gl;
    GLuint object = 0;
    gl.GenFramebuffers(1, &object);
    mDevice.state.bindFramebuffers(object, object);
    std::array<GLenum, kMaxColorAttachments> drawBuffers{};
    for (uint32_t i = 0; i < wanted.colorCount; ++i) {
        drawBuffers[i] = GL_COLOR_ATTACHMENT0 + i;
        attach(drawBuffers[i], wanted.colors[i]);
    }
    if (wanted.depthPoint) attach(wanted.depthPoint, wanted.depth);
    gl.DrawBuffers(static_cast<GLsizei>(wanted.colorCount), drawBuffers.data());
    gl.ReadBuffer(wanted.colorCount ? GL_COLOR_ATTACHMENT0 : GL_NONE);
    const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return object;
    mDevice.error(DriverErrorKind::Other,
                  "'{}': the driver refuses this set of attachments (framebuffer status {:#x}); it is skipped. "
                  "Attachments of one pass need equal sample counts and renderable formats",
                  what, status);
    destroy(object);
    return 0;
}

void Framebuffers::forget(GLuint texture) {
    const auto uses = [texture](FramebufferKey const& key) {
        return key.depth.texture == texture ||
               std::any_of(key.colors.begin(), key.colors.end(),
                           [texture](ImageKey const& image) { return image.texture == texture; });
    };
    for (auto at = mObjects.begin(); at != mObjects.end();) {
        if (!uses(at->first)) {
            ++at;
            continue;
        }
        destroy(at->second);
        at = mObjects.erase(at);
    }
    for (Single& single : mSingles) {
        if (single.image.texture != texture) continue;
        destroy(single.object);
        single = {};
    }
}

} // namespace filament_core::backend::gles
