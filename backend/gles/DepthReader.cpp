// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/DepthReader.h"

#include "backend/gles/ShaderObject.h"

namespace filament::backend::gles {
namespace {

constexpr uint32_t kUnit = 0;

constexpr std::string_view kVertexText = R"(#version 310 es
void main() { // one triangle over everything
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

constexpr std::string_view kFragmentText = R"(#version 310 es
precision highp float;
layout(binding = 0) uniform highp sampler2D depth;
layout(location = 0) out float value;
void main() { value = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r; }
)";

} // namespace

DepthReader::~DepthReader() {
    dropTextures();
    mDevice.state.forgetProgram(mProgram);
    mDevice.state.forgetVertexArray(mVertexArray);
    mDevice.gl.DeleteProgram(mProgram);
    mDevice.gl.DeleteVertexArrays(1, &mVertexArray);
}

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
    mDevice.state.bindTexture(kUnit, GL_TEXTURE_2D, texture.name);
    gl.TexStorage2D(GL_TEXTURE_2D, 1, glFormat(format).internalFormat, static_cast<GLsizei>(rect.width),
                    static_cast<GLsizei>(rect.height));
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST); // depth textures filter no other way
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

bool DepthReader::prepareProgram() {
    if (mProgram) return true;
    mProgram = linkProgram(mDevice, { kVertexText }, { kFragmentText }, "depth read-back");
    mDevice.gl.GenVertexArrays(1, &mVertexArray);
    return mProgram != 0;
}

void DepthReader::blit(Texture const& source, uint32_t level, uint32_t layer, Rect const& rect) {
    const GLuint read = mFramebuffers.single(Framebuffers::Side::Read, source, level, layer);
    const GLuint draw = mFramebuffers.single(Framebuffers::Side::Draw, mDepth, 0, 0);
    const auto width = static_cast<GLint>(rect.width), height = static_cast<GLint>(rect.height);
    mDevice.state.bindFramebuffers(draw, read);
    mDevice.state.setScissor({});
    mDevice.gl.BlitFramebuffer(rect.x, rect.y, rect.x + width, rect.y + height, 0, 0, width, height,
                               GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

void DepthReader::draw(GLuint target, Rect const& rect) {
    ContextState& state = mDevice.state;
    state.bindFramebuffers(target, target);
    state.setViewport({ 0, 0, static_cast<float>(rect.width), static_cast<float>(rect.height) });
    state.setScissor({});
    state.setRaster({ .cull = CullMode::None });
    state.setDepthStencil({}, 0, 0);
    state.setBlend(0, {});
    state.bindSampler(kUnit, 0);
    state.bindTexture(kUnit, GL_TEXTURE_2D, mDepth.name);
    state.useProgram(mProgram);
    state.bindVertexArray(mVertexArray);
    mDevice.gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

GLuint DepthReader::copy(Texture const& texture, uint32_t level, uint32_t layer, Rect const& rect) {
    if (!prepareProgram()) return 0;
    dropTextures();
    mDevice.beginCreation();
    mDepth = makeTexture(texture.desc.format, rect);
    mFloat = makeTexture(Format::R32F, rect);
    if (!mDevice.created("texture", "depth read-back")) return 0;
    blit(texture, level, layer, rect);
    const GLuint target = mFramebuffers.single(Framebuffers::Side::Draw, mFloat, 0, 0);
    draw(target, rect);
    return target;
}

} // namespace filament::backend::gles
