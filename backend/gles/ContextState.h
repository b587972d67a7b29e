// SPDX-License-Identifier: Apache-2.0
/// ContextState: a cache of the context's state; every setter returns at once if nothing changes.
///   Why     validation of redundant calls is a large part of an OpenGL ES frame; here each setter costs a compare.
///   Thread  the driver thread, context current. Every call that changes cached state goes through here.
///   Before  deleting a GL object call its forget...(): OpenGL unbinds deleted names and reuses them.
#pragma once

#include "backend/gles/Formats.h"
#include "backend/gles/Quirks.h"

#include <optional>

namespace filament_core::backend::gles {

inline constexpr uint32_t kMaxUniformSlots = kMaxBindGroups * kMaxBindings;
inline constexpr uint32_t kMaxStorageSlots = kMaxBindGroups * kMaxBindings;
inline constexpr uint32_t kMaxTextureUnits = kMaxBindGroups * kMaxBindings;

class ContextState {
public:
    /// Sets a new context to the state of the members.
    ContextState(Api const& gl, Quirks const& quirks);

    void useProgram(GLuint program);
    void bindVertexArray(GLuint array);
    void bindFramebuffers(GLuint draw, GLuint read);
    void bindUniforms(uint32_t slot, GLuint buffer, GLintptr offset, GLsizeiptr size);
    void bindStorage(uint32_t slot, GLuint buffer, GLintptr offset, GLsizeiptr size);
    void bindTexture(uint32_t unit, GLenum target, GLuint texture);
    void bindSampler(uint32_t unit, GLuint sampler);

    void setViewport(Viewport const& viewport);
    void setScissor(std::optional<Rect> rect); ///< none: whole framebuffer
    void setRaster(RasterState const& raster);
    void setDepthStencil(DepthStencilState const& wanted, uint8_t frontReference, uint8_t backReference);
    void setBlend(uint32_t attachment, BlendState const& wanted);
    /// Whether attachments of sRGB formats are encoded when written and decoded when blitted; else their bytes are.
    void convertSrgb(bool wanted);
    /// Write masks for clears: everything is written.
    void allowClears(uint32_t colorCount);
    /// The value of an attribute without an array, (0, 0, 0, 1), in the type that the shader declares.
    void setConstantAttribute(uint32_t location, GLenum scalarType);

    void forgetProgram(GLuint program);
    void forgetVertexArray(GLuint array);
    void forgetFramebuffer(GLuint framebuffer);
    void forgetBuffer(GLuint buffer);
    void forgetTexture(GLuint texture);
    void forgetSampler(GLuint sampler);

private:
    struct BufferSlot {
        GLuint buffer = 0;
        GLintptr offset = 0;
        GLsizeiptr size = 0;
        bool operator==(BufferSlot const&) const = default;
    };
    struct TextureUnit {
        GLenum target = 0;
        GLuint texture = 0;
        GLuint sampler = 0;
    };
    struct StencilReference {
        uint8_t front = 0, back = 0;
        bool operator==(StencilReference const&) const = default;
    };

    void enable(GLenum capability, bool wanted, bool& known);
    void setDepth(CompareOp compare, bool write);
    void setStencilFace(GLenum face, StencilFace const& wanted, uint8_t reference, StencilFace& known,
                        uint8_t& knownReference);
    void setColorMask(uint32_t attachment, uint8_t mask);

    Api const& mGl;
    Quirks const& mQuirks;
    GLuint mProgram = 0, mVertexArray = 0, mDrawFramebuffer = 0, mReadFramebuffer = 0;
    uint32_t mActiveUnit = 0;
    std::array<BufferSlot, kMaxUniformSlots> mUniforms{};
    std::array<BufferSlot, kMaxStorageSlots> mStorage{};
    std::array<TextureUnit, kMaxTextureUnits> mTextures{};
    std::array<GLenum, kMaxVertexAttributes> mConstantAttributes{};

    std::optional<Viewport> mViewport;
    Rect mScissor{ -1, -1, 0, 0 };
    RasterState mRaster{};
    CompareOp mDepthCompare = CompareOp::Less;
    StencilFace mStencilFront{}, mStencilBack{};
    StencilReference mStencilReference{};
    std::array<BlendState, kMaxColorAttachments> mBlend{};

    bool mScissorTest = false, mCull = false, mDepthTest = false, mDepthWrite = true, mStencilTest = false;
    bool mPolygonOffset = false, mDepthClamp = false, mAlphaToCoverage = false, mSrgb = true;
};

} // namespace filament_core::backend::gles
