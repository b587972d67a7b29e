// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/ContextState.h"

#include <cmath>

namespace filament_core::backend::gles {

// The members start with the initial values of the specification, so only differing values are set here.
ContextState::ContextState(Api const& gl, Quirks const& quirks) : mGl(gl), mQuirks(quirks) {
    gl.ClipControl(GL_LOWER_LEFT_EXT, GL_ZERO_TO_ONE_EXT); // row 0 is y = -1 and depth is in [0, 1], as on Vulkan
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.Disable(GL_DITHER); // on by default, and may change bits
    gl.FrontFace(glFrontFace(mRaster.frontFace));
    mConstantAttributes.fill(GL_FLOAT); // (0, 0, 0, 1) is the initial value
}

void ContextState::enable(GLenum capability, bool wanted, bool& known) {
    if (wanted == known) return;
    known = wanted;
    if (wanted) {
        mGl.Enable(capability);
    } else {
        mGl.Disable(capability);
    }
}

// ---------------------------------------------------------------------------------------------- objects

void ContextState::useProgram(GLuint program) {
    if (program == mProgram) return;
    mProgram = program;
    mGl.UseProgram(program);
}

void ContextState::bindVertexArray(GLuint array) {
    if (array == mVertexArray) return;
    mVertexArray = array;
    mGl.BindVertexArray(array);
}

void ContextState::bindFramebuffers(GLuint draw, GLuint read) {
    if (draw != mDrawFramebuffer) mGl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, mDrawFramebuffer = draw);
    if (read != mReadFramebuffer) mGl.BindFramebuffer(GL_READ_FRAMEBUFFER, mReadFramebuffer = read);
}

void ContextState::bindUniforms(uint32_t slot, GLuint buffer, GLintptr offset, GLsizeiptr size) {
    const BufferSlot wanted{ buffer, offset, size };
    if (mUniforms[slot] == wanted) return;
    mUniforms[slot] = wanted;
    mGl.BindBufferRange(GL_UNIFORM_BUFFER, slot, buffer, offset, size);
}

void ContextState::bindStorage(uint32_t slot, GLuint buffer, GLintptr offset, GLsizeiptr size) {
    const BufferSlot wanted{ buffer, offset, size };
    if (mStorage[slot] == wanted) return;
    mStorage[slot] = wanted;
    mGl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, slot, buffer, offset, size);
}

void ContextState::bindTexture(uint32_t unit, GLenum target, GLuint texture) {
    TextureUnit& known = mTextures[unit];
    if (known.texture == texture && known.target == target) return;
    if (mActiveUnit != unit) mGl.ActiveTexture(GL_TEXTURE0 + (mActiveUnit = unit));
    known.target = target;
    known.texture = texture;
    mGl.BindTexture(target, texture);
}

void ContextState::bindSampler(uint32_t unit, GLuint sampler) {
    if (mTextures[unit].sampler == sampler) return;
    mTextures[unit].sampler = sampler;
    mGl.BindSampler(unit, sampler);
}

void ContextState::forgetProgram(GLuint program) {
    // A program in use would only be marked for deletion, and keep its memory.
    if (mProgram == program) useProgram(0);
}

void ContextState::forgetVertexArray(GLuint array) {
    if (mVertexArray == array) mVertexArray = 0;
}

void ContextState::forgetFramebuffer(GLuint framebuffer) {
    if (mDrawFramebuffer == framebuffer) mDrawFramebuffer = 0;
    if (mReadFramebuffer == framebuffer) mReadFramebuffer = 0;
}

void ContextState::forgetBuffer(GLuint buffer) {
    for (BufferSlot& slot : mUniforms) {
        if (slot.buffer == buffer) slot = {};
    }
    for (BufferSlot& slot : mStorage) {
        if (slot.buffer == buffer) slot = {};
    }
}

void ContextState::forgetTexture(GLuint texture) {
    for (TextureUnit& unit : mTextures) {
        if (unit.texture == texture) unit.texture = 0;
    }
}

void ContextState::forgetSampler(GLuint sampler) {
    for (TextureUnit& unit : mTextures) {
        if (unit.sampler == sampler) unit.sampler = 0;
    }
}

// ---------------------------------------------------------------------------------------------- values

void ContextState::setViewport(Viewport const& viewport) {
    if (mViewport == viewport) return;
    mViewport = viewport;
    mGl.Viewport(static_cast<GLint>(std::lround(viewport.x)), static_cast<GLint>(std::lround(viewport.y)),
                 static_cast<GLsizei>(std::lround(viewport.width)), static_cast<GLsizei>(std::lround(viewport.height)));
}

void ContextState::setScissor(std::optional<Rect> rect) {
    enable(GL_SCISSOR_TEST, rect.has_value(), mScissorTest);
    if (!rect || *rect == mScissor) return;
    mScissor = *rect;
    mGl.Scissor(rect->x, rect->y, static_cast<GLsizei>(rect->width), static_cast<GLsizei>(rect->height));
}

void ContextState::setRaster(RasterState const& raster) {
    if (raster == mRaster && mCull == (raster.cull != CullMode::None)) return;
    enable(GL_CULL_FACE, raster.cull != CullMode::None, mCull);
    if (raster.cull != CullMode::None) mGl.CullFace(raster.cull == CullMode::Front ? GL_FRONT : GL_BACK);
    if (raster.frontFace != mRaster.frontFace) mGl.FrontFace(glFrontFace(raster.frontFace));
    const bool offset = raster.depthBiasConstant != 0 || raster.depthBiasSlope != 0;
    enable(GL_POLYGON_OFFSET_FILL, offset, mPolygonOffset);
    if (offset) mGl.PolygonOffset(raster.depthBiasSlope, raster.depthBiasConstant);
    if (mQuirks.depthClamp) enable(GL_DEPTH_CLAMP_EXT, raster.depthClamp, mDepthClamp);
    enable(GL_SAMPLE_ALPHA_TO_COVERAGE, raster.alphaToCoverage, mAlphaToCoverage);
    mRaster = raster;
}

void ContextState::setDepth(CompareOp compare, bool write) {
    enable(GL_DEPTH_TEST, compare != CompareOp::None, mDepthTest);
    if (compare == CompareOp::None) return; // without the test, nothing is written either
    if (compare != mDepthCompare) mGl.DepthFunc(glCompare(mDepthCompare = compare));
    if (write != mDepthWrite) mGl.DepthMask((mDepthWrite = write) ? GL_TRUE : GL_FALSE);
}

void ContextState::setStencilFace(GLenum face, StencilFace const& wanted, uint8_t reference, StencilFace& known,
                                  uint8_t& knownReference) {
    if (wanted == known && reference == knownReference) return;
    mGl.StencilFuncSeparate(face, glCompare(wanted.compare), reference, wanted.readMask);
    mGl.StencilOpSeparate(face, glStencilOp(wanted.fail), glStencilOp(wanted.depthFail), glStencilOp(wanted.pass));
    if (wanted.writeMask != known.writeMask) mGl.StencilMaskSeparate(face, wanted.writeMask);
    known = wanted;
    knownReference = reference;
}

void ContextState::setDepthStencil(DepthStencilState const& wanted, uint8_t frontReference, uint8_t backReference) {
    setDepth(wanted.depthCompare, wanted.depthWrite);
    enable(GL_STENCIL_TEST, wanted.stencilTest, mStencilTest);
    if (!wanted.stencilTest) return;
    setStencilFace(GL_FRONT, wanted.front, frontReference, mStencilFront, mStencilReference.front);
    setStencilFace(GL_BACK, wanted.back, backReference, mStencilBack, mStencilReference.back);
}

void ContextState::setColorMask(uint32_t attachment, uint8_t mask) {
    if (mBlend[attachment].writeMask == mask) return;
    mBlend[attachment].writeMask = mask;
    const auto bit = [mask](uint32_t i) { return static_cast<GLboolean>((mask >> i) & 1); };
    if (mQuirks.indexedBlend) {
        mGl.ColorMaski(attachment, bit(0), bit(1), bit(2), bit(3));
    } else {
        mGl.ColorMask(bit(0), bit(1), bit(2), bit(3));
    }
}

void ContextState::setBlend(uint32_t attachment, BlendState const& wanted) {
    if (!mQuirks.indexedBlend && attachment > 0) return; // all attachments follow the first
    BlendState& known = mBlend[attachment];
    if (known == wanted) return;
    setColorMask(attachment, wanted.writeMask);
    if (wanted.enabled != known.enabled) {
        if (mQuirks.indexedBlend) {
            (wanted.enabled ? mGl.Enablei : mGl.Disablei)(GL_BLEND, attachment);
        } else {
            (wanted.enabled ? mGl.Enable : mGl.Disable)(GL_BLEND);
        }
    }
    const GLenum factors[] = { glBlendFactor(wanted.srcColor), glBlendFactor(wanted.dstColor),
                               glBlendFactor(wanted.srcAlpha), glBlendFactor(wanted.dstAlpha) };
    const GLenum ops[] = { glBlendOp(wanted.colorOp), glBlendOp(wanted.alphaOp) };
    if (mQuirks.indexedBlend) {
        mGl.BlendFuncSeparatei(attachment, factors[0], factors[1], factors[2], factors[3]);
        mGl.BlendEquationSeparatei(attachment, ops[0], ops[1]);
    } else {
        mGl.BlendFuncSeparate(factors[0], factors[1], factors[2], factors[3]);
        mGl.BlendEquationSeparate(ops[0], ops[1]);
    }
    known = wanted;
}

void ContextState::convertSrgb(bool wanted) {
    if (mQuirks.srgbWriteControl) enable(GL_FRAMEBUFFER_SRGB_EXT, wanted, mSrgb);
}

void ContextState::allowClears(uint32_t colorCount) {
    const uint32_t masks = mQuirks.indexedBlend ? colorCount : 1;
    // Unlike in Vulkan, a clear obeys the write masks of the last draw.
    for (uint32_t i = 0; i < masks; ++i) setColorMask(i, 0xF);
    if (!mDepthWrite) mGl.DepthMask(mDepthWrite = GL_TRUE);
    if (mStencilFront.writeMask != 0xFF || mStencilBack.writeMask != 0xFF) {
        mGl.StencilMask(0xFF);
        mStencilFront.writeMask = mStencilBack.writeMask = 0xFF;
    }
}

void ContextState::setConstantAttribute(uint32_t location, GLenum scalarType) {
    if (mConstantAttributes[location] == scalarType) return;
    mConstantAttributes[location] = scalarType;
    switch (scalarType) {
    case GL_INT:
        mGl.VertexAttribI4i(location, 0, 0, 0, 1);
        break;
    case GL_UNSIGNED_INT:
        mGl.VertexAttribI4ui(location, 0, 0, 0, 1);
        break;
    default:
        mGl.VertexAttrib4f(location, 0, 0, 0, 1);
        break;
    }
}

} // namespace filament_core::backend::gles
