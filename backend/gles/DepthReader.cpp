// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/DepthReader.h"

namespace filament_core::backend::gles {
namespace {

constexpr std::string_view kFragmentText = R"(#version 310 es
precision highp float;
layout(binding = 0) uniform highp sampler2D depth;
layout(location = 0) out float value;
void main() { value = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r; }
)";

} // namespace

DepthReader::DepthReader(Device& device, Framebuffers& framebuffers)
        : mDevice(device), mFramebuffers(framebuffers), mProgram(device, kFragmentText, "depth read-back") {}

void DepthReader::dropTextures() {
    for (Texture* texture : { &mDepth, &mFloat }) {
        if (texture->name == 0) continue;
        mFramebuffers.forget(texture->name);
        mDevice.state.forgetTexture(texture->name);
        mDevice.gl.DeleteTextures(1, &texture->name);
        texture->name = 0;
    }
}

Texture DepthReader::makeTexture(Format format, Rect const& rect) {
    Texture texture;
    texture.desc.format = format;
    Api const& gl = mDevice.gl;
    gl.GenTextures(1, &texture.name);
    mDevice.state.bindTexture(FullScreenProgram::kUnit, GL_TEXTURE_2D, texture.name);
    gl.TexStorage2D(GL_TEXTURE_2D, 1, glFormat(format).internalFormat, static_cast<GLsizei>(rect.width),
                    static_cast<GLsizei>(rect.height));
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST); // the only filter for depth textures
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

void DepthReader::blit(Texture const& source, uint32_t level, uint32_t layer, Rect const& rect) {
    const GLuint read = mFramebuffers.single(Framebuffers::Side::Read, source, level, layer);
    const GLuint draw = mFramebuffers.single(Framebuffers::Side::Draw, mDepth, 0, 0);
    const auto width = static_cast<GLint>(rect.width), height = static_cast<GLint>(rect.height);
    mDevice.state.bindFramebuffers(draw, read);
    // A blit obeys the scissor of the last draw.
    mDevice.state.setScissor({});
    mDevice.gl.BlitFramebuffer(rect.x, rect.y, rect.x + width, rect.y + height, 0, 0, width, height,
                               GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

GLuint DepthReader::copy(Texture const& texture, uint32_t level, uint32_t layer, Rect const& rect) {
    dropTextures();
    mDevice.beginCreation();
    mDepth = makeTexture(texture.desc.format, rect);
    mFloat = makeTexture(Format::R32F, rect);
    // Errors are asked for once, after both textures: the draw below must not run without one of them.
    if (!mDevice.created("texture", "depth read-back")) return 0;
    blit(texture, level, layer, rect);
    const GLuint target = mFramebuffers.single(Framebuffers::Side::Draw, mFloat, 0, 0);
    const Rect all{ 0, 0, rect.width, rect.height };
    return mProgram.draw(target, all, GL_TEXTURE_2D, mDepth.name, {}) ? target : 0;
}

} // namespace filament_core::backend::gles
