// SPDX-License-Identifier: Apache-2.0
/// The native enums of this backend: every value of backend/api that has one.
///   Thread  any; constant tables.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/gles/Api.h"

namespace filament_core::backend::gles {

/// How a format is stored and how its texels travel: exactly the bytes that Format.h promises.
struct GlFormat {
    GLenum internalFormat = 0;
    GLenum format = 0; ///< 0 for block-compressed formats
    GLenum type = 0;
};

GlFormat const& glFormat(Format format);

/// One attribute as parameters of glVertexAttribFormat / glVertexAttribIFormat.
GLenum glVertexType(VertexFormat format);

GLenum glTextureTarget(DeviceTextureDesc const& desc);
/// Whether the target's images are addressed by level and layer: arrays and 3D textures.
bool isLayered(GLenum target);
GLenum glTopology(PrimitiveType topology);
GLenum glCompare(CompareOp op); ///< None maps to GL_ALWAYS
GLenum glStencilOp(StencilOp op);
GLenum glBlendFactor(BlendFactor factor);
GLenum glBlendOp(BlendOp op);
GLenum glWrap(WrapMode mode);
GLenum glMinFilter(SamplerDesc const& desc);
GLenum glFilter(Filter filter);

/// FrontFace refers to the image with row 0 at the top. OpenGL uses window coordinates with y up and row 0 at y = 0,
/// so its clockwise looks counter-clockwise in the image.
inline GLenum glFrontFace(FrontFace face) { return face == FrontFace::CounterClockwise ? GL_CW : GL_CCW; }

/// "GL_OUT_OF_MEMORY" and the like.
const char* glErrorName(GLenum error);

} // namespace filament_core::backend::gles
