// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/FullScreenProgram.h"

#include "backend/gles/ShaderObject.h"

namespace filament_core::backend::gles {
namespace {

constexpr std::string_view kVertexText = R"(#version 310 es
void main() { // one triangle over everything
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

} // namespace

FullScreenProgram::~FullScreenProgram() {
    mDevice.state.forgetProgram(mProgram);
    mDevice.state.forgetVertexArray(mVertexArray);
    mDevice.gl.DeleteProgram(mProgram);
    mDevice.gl.DeleteVertexArrays(1, &mVertexArray);
}

bool FullScreenProgram::prepare() {
    if (mProgram) return true;
    const std::array<StageText, 2> stages{ { { GL_VERTEX_SHADER, { kVertexText } },
                                             { GL_FRAGMENT_SHADER, { mFragment } } } };
    mProgram = linkProgram(mDevice, stages, mName);
    if (!mVertexArray) mDevice.gl.GenVertexArrays(1, &mVertexArray);
    return mProgram != 0;
}

bool FullScreenProgram::draw(GLuint framebuffer, Rect const& rect, GLenum target, GLuint texture,
                             DepthStencilState const& depthStencil) {
    if (!prepare()) return false;
    ContextState& state = mDevice.state;
    state.bindFramebuffers(framebuffer, framebuffer);
    state.setViewport({ static_cast<float>(rect.x), static_cast<float>(rect.y), static_cast<float>(rect.width),
                        static_cast<float>(rect.height) });
    state.setScissor(rect);
    state.setRaster({ .cull = CullMode::None });
    state.setDepthStencil(depthStencil, 0, 0);
    state.setBlend(0, {});
    state.bindSampler(kUnit, 0);
    state.bindTexture(kUnit, target, texture);
    state.useProgram(mProgram);
    state.bindVertexArray(mVertexArray);
    mDevice.gl.DrawArrays(GL_TRIANGLES, 0, 3);
    return true;
}

} // namespace filament_core::backend::gles
