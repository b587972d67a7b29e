// SPDX-License-Identifier: Apache-2.0
/// Api: the OpenGL ES functions as a table, one per context, found through eglGetProcAddress.
///   Why     nothing links against libGLESv2, and every driver in the process may use another implementation.
///   Use     gl.BindTexture(...) for glBindTexture. Call entries below "optional" only if Quirks allows it: an
///           implementation may return an entry point for a function that it does not have.
#pragma once

#include <EGL/egl.h>
#include <GLES3/gl32.h>

#include <GLES2/gl2ext.h>

namespace filament_core::backend::gles {

// OpenGL ES 3.1
// clang-format off
#define FILAMENT_GL_CORE_FUNCTIONS(X)                                                                           \
    X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindBufferRange) X(BindFramebuffer) X(BindSampler)         \
    X(BindTexture) X(BindVertexArray) X(BindVertexBuffer) X(BlendEquationSeparate) X(BlendFuncSeparate)         \
    X(BlitFramebuffer) X(BufferData) X(BufferSubData) X(CheckFramebufferStatus) X(ClearBufferfi)                \
    X(ClearBufferfv) X(ClearBufferuiv) X(ClientWaitSync) X(ColorMask) X(CompileShader)                          \
    X(CompressedTexSubImage2D) X(CompressedTexSubImage3D) X(CopyBufferSubData) X(CreateProgram) X(CreateShader) \
    X(CullFace) X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) X(DeleteQueries) X(DeleteSamplers)      \
    X(DeleteShader) X(DeleteSync) X(DeleteTextures) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) X(Disable)  \
    X(DispatchCompute) X(DrawArrays) X(DrawArraysInstanced) X(DrawBuffers) X(DrawElementsInstanced) X(Enable)   \
    X(EnableVertexAttribArray) X(FenceSync) X(Finish) X(Flush) X(FramebufferTexture2D)                          \
    X(FramebufferTextureLayer) X(FrontFace) X(GenBuffers) X(GenFramebuffers) X(GenQueries) X(GenSamplers)       \
    X(GenTextures) X(GenVertexArrays) X(GetActiveAttrib) X(GetAttribLocation) X(GetError) X(GetFloatv)          \
    X(GetIntegeri_v) X(GetIntegerv) X(GetProgramBinary) X(GetProgramInfoLog) X(GetProgramInterfaceiv)           \
    X(GetProgramResourceiv) X(GetProgramiv) X(GetQueryObjectuiv) X(GetShaderInfoLog) X(GetShaderiv)             \
    X(GetString) X(GetStringi) X(InvalidateFramebuffer) X(InvalidateSubFramebuffer) X(LinkProgram)              \
    X(MapBufferRange) X(MemoryBarrier) X(PixelStorei) X(PolygonOffset) X(ProgramBinary) X(ProgramParameteri)    \
    X(ReadBuffer) X(ReadPixels) X(SamplerParameterf) X(SamplerParameteri) X(Scissor) X(ShaderSource)            \
    X(StencilFuncSeparate) X(StencilMask) X(StencilMaskSeparate) X(StencilOpSeparate) X(TexParameteri)          \
    X(TexStorage2D) X(TexStorage2DMultisample) X(TexStorage3D) X(TexSubImage2D) X(TexSubImage3D) X(UnmapBuffer) \
    X(UseProgram) X(VertexAttrib4f) X(VertexAttribBinding) X(VertexAttribFormat) X(VertexAttribI4i)             \
    X(VertexAttribI4ui) X(VertexAttribIFormat) X(VertexBindingDivisor) X(Viewport)

// Optional, core since ES 3.2: looked up without a suffix, then as OES, EXT and KHR.
#define FILAMENT_GL_OPTIONAL_FUNCTIONS(X)                                                                       \
    X(BlendEquationSeparatei) X(BlendFuncSeparatei) X(ColorMaski) X(DebugMessageCallback) X(Disablei)           \
    X(DrawElementsInstancedBaseVertex) X(Enablei) X(GetGraphicsResetStatus) X(ObjectLabel) X(PopDebugGroup)     \
    X(PushDebugGroup)

// Optional, extensions only; looked up like those above.
#define FILAMENT_GL_EXTENSION_FUNCTIONS(X)                                                                      \
    X(ClipControl, PFNGLCLIPCONTROLEXTPROC)                                                                     \
    X(DrawArraysInstancedBaseInstance, PFNGLDRAWARRAYSINSTANCEDBASEINSTANCEEXTPROC)                             \
    X(DrawElementsInstancedBaseVertexBaseInstance, PFNGLDRAWELEMENTSINSTANCEDBASEVERTEXBASEINSTANCEEXTPROC)     \
    X(GetQueryObjectui64v, PFNGLGETQUERYOBJECTUI64VEXTPROC)                                                     \
    X(QueryCounter, PFNGLQUERYCOUNTEREXTPROC)                                                                   \
    X(TextureView, PFNGLTEXTUREVIEWEXTPROC)
// clang-format on

struct Api {
#define X(name) decltype(&::gl##name) name = nullptr;
    FILAMENT_GL_CORE_FUNCTIONS(X)
    FILAMENT_GL_OPTIONAL_FUNCTIONS(X)
#undef X
#define X(name, type) type name = nullptr;
    FILAMENT_GL_EXTENSION_FUNCTIONS(X)
#undef X

    using Lookup = __eglMustCastToProperFunctionPointerType (*)(const char*);
    /// Null if all of ES 3.1 is available, otherwise the name of the first missing function.
    const char* load(Lookup lookup);
};

} // namespace filament_core::backend::gles
