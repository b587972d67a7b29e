// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Formats.h"

namespace filament_core::backend::gles {
namespace {

constexpr std::array<GlFormat, static_cast<size_t>(Format::Count)> kFormats{ {
        { 0, 0, 0 }, // None
        { GL_R8, GL_RED, GL_UNSIGNED_BYTE },
        { GL_RG8, GL_RG, GL_UNSIGNED_BYTE },
        { GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE },
        { GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE },
        { GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE },
        { GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT },
        { GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT },
        { GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE },
        { GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV },
        { GL_R16F, GL_RED, GL_HALF_FLOAT },
        { GL_RG16F, GL_RG, GL_HALF_FLOAT },
        { GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT },
        { GL_R32F, GL_RED, GL_FLOAT },
        { GL_RG32F, GL_RG, GL_FLOAT },
        { GL_RGBA32F, GL_RGBA, GL_FLOAT },
        { GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV },
        { GL_RGB9_E5, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV },
        { GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT },
        { GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT },
        { GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV },
        { GL_COMPRESSED_RGBA_S3TC_DXT1_EXT, 0, 0 },
        { GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT, 0, 0 },
        { GL_COMPRESSED_RGBA_S3TC_DXT3_EXT, 0, 0 },
        { GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT, 0, 0 },
        { GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, 0, 0 },
        { GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT, 0, 0 },
        { GL_COMPRESSED_RED_RGTC1_EXT, 0, 0 },
        { GL_COMPRESSED_RED_GREEN_RGTC2_EXT, 0, 0 },
        { GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT, 0, 0 },
        { GL_COMPRESSED_RGBA_BPTC_UNORM_EXT, 0, 0 },
        { GL_COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT, 0, 0 },
        { GL_R8I, GL_RED_INTEGER, GL_BYTE },
        { GL_R32I, GL_RED_INTEGER, GL_INT },
        { GL_RG32I, GL_RG_INTEGER, GL_INT },
        { GL_RGBA8I, GL_RGBA_INTEGER, GL_BYTE },
} };

constexpr std::array<GLenum, static_cast<size_t>(VertexFormat::Count)> kVertexTypes{
    0,
    GL_FLOAT,
    GL_FLOAT,
    GL_FLOAT,
    GL_FLOAT,
    GL_HALF_FLOAT,
    GL_HALF_FLOAT,
    GL_UNSIGNED_BYTE,
    GL_UNSIGNED_BYTE,
    GL_BYTE,
    GL_BYTE,
    GL_UNSIGNED_SHORT,
    GL_UNSIGNED_SHORT,
    GL_UNSIGNED_SHORT,
    GL_UNSIGNED_SHORT,
    GL_SHORT,
    GL_SHORT,
    GL_SHORT,
    GL_SHORT,
    GL_UNSIGNED_INT,
};

template <size_t N, class E>
constexpr GLenum lookUp(const GLenum (&table)[N], E value) {
    return table[static_cast<size_t>(value)];
}

} // namespace

GlFormat const& glFormat(Format format) { return kFormats[static_cast<size_t>(format)]; }

GLenum glVertexType(VertexFormat format) { return kVertexTypes[static_cast<size_t>(format)]; }

GLenum glTextureTarget(DeviceTextureDesc const& desc) {
    if (desc.samples > 1) return GL_TEXTURE_2D_MULTISAMPLE;
    static constexpr GLenum kTargets[] = { GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_CUBE_MAP,
                                           GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_3D };
    return lookUp(kTargets, desc.type);
}

bool isLayered(GLenum target) {
    return target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_CUBE_MAP_ARRAY || target == GL_TEXTURE_3D;
}

GLenum glTopology(PrimitiveType topology) {
    static constexpr GLenum kModes[] = { GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_LINES, GL_LINE_STRIP, GL_POINTS };
    return lookUp(kModes, topology);
}

GLenum glCompare(CompareOp op) {
    static constexpr GLenum kOps[] = { GL_ALWAYS,  GL_NEVER,    GL_LESS,   GL_EQUAL, GL_LEQUAL,
                                       GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS };
    return lookUp(kOps, op);
}

GLenum glStencilOp(StencilOp op) {
    static constexpr GLenum kOps[] = { GL_KEEP, GL_ZERO,   GL_REPLACE,   GL_INCR,
                                       GL_DECR, GL_INVERT, GL_INCR_WRAP, GL_DECR_WRAP };
    return lookUp(kOps, op);
}

GLenum glBlendFactor(BlendFactor factor) {
    static constexpr GLenum kFactors[] = { GL_ZERO,
                                           GL_ONE,
                                           GL_SRC_COLOR,
                                           GL_ONE_MINUS_SRC_COLOR,
                                           GL_DST_COLOR,
                                           GL_ONE_MINUS_DST_COLOR,
                                           GL_SRC_ALPHA,
                                           GL_ONE_MINUS_SRC_ALPHA,
                                           GL_DST_ALPHA,
                                           GL_ONE_MINUS_DST_ALPHA,
                                           GL_SRC_ALPHA_SATURATE };
    return lookUp(kFactors, factor);
}

GLenum glBlendOp(BlendOp op) {
    static constexpr GLenum kOps[] = { GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX };
    return lookUp(kOps, op);
}

GLenum glWrap(WrapMode mode) {
    static constexpr GLenum kModes[] = { GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE };
    return lookUp(kModes, mode);
}

GLenum glFilter(Filter filter) { return filter == Filter::Linear ? GL_LINEAR : GL_NEAREST; }

GLenum glMinFilter(SamplerDesc const& desc) {
    const bool linear = desc.minFilter == Filter::Linear;
    switch (desc.mipFilter) {
    case MipFilter::None:
        return glFilter(desc.minFilter);
    case MipFilter::Nearest:
        return linear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
    case MipFilter::Linear:
        return linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
    }
    return GL_NEAREST;
}

const char* glErrorName(GLenum error) {
    switch (error) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    default:
        return "an unknown GL error";
    }
}

} // namespace filament_core::backend::gles
