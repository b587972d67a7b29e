// SPDX-License-Identifier: Apache-2.0
/// formatInfo(f), vertexFormatInfo(f): the only table about formats; a backend adds only its native enum.
#pragma once

#include <filament_core/Format.h>

#include <cstdint>

namespace filament_core::backend {

using filament_core::Format;
using filament_core::IndexFormat;
using filament_core::PrimitiveType;
using filament_core::TextureKind;
using filament_core::VertexFormat;

enum class FormatKind : uint8_t { Color, UnsignedInteger, SignedInteger, Depth, DepthStencil };

struct FormatInfo {
    const char* name;
    uint8_t bytesPerBlock; ///< bytes of one texel, or of one 4x4 block
    uint8_t blockSize;     ///< 1, or 4 for the BC formats
    uint8_t components;
    FormatKind kind;
    bool isFloat; ///< stores values beyond [0, 1]
    bool isSrgb;
    bool isRenderable; ///< every supported device can attach it to a framebuffer
};

FormatInfo const& formatInfo(Format format);

inline bool isCompressed(Format format) { return formatInfo(format).blockSize > 1; }
inline bool hasDepth(Format format) { return formatInfo(format).kind >= FormatKind::Depth; }
inline bool hasStencil(Format format) { return formatInfo(format).kind == FormatKind::DepthStencil; }

/// What passes store in a colour attachment: of sRGB the bytes themselves, as of the format without it. Shaders encode,
/// because a driver's encoding has other bits on other processors (docs/conformance.md, "Scope of the guarantee").
inline Format attachmentFormat(Format format) { return format == Format::RGBA8Srgb ? Format::RGBA8 : format; }

/// Whether blits and mip generation may write it: they filter what is decoded, so a driver would have to encode.
inline bool isWritable(Format format) { return formatInfo(format).isRenderable && !formatInfo(format).isSrgb; }

/// Bytes of one tightly packed image of width x height texels (partial blocks count whole).
uint64_t imageBytes(Format format, uint32_t width, uint32_t height);

/// Levels of a full mip chain: floor(log2(max(width, height))) + 1.
uint32_t fullMipCount(uint32_t width, uint32_t height);

struct VertexFormatInfo {
    const char* name;
    uint8_t bytes;
    uint8_t components;
    bool normalized;
    bool integer; ///< the shader declares uint or int vectors
};

VertexFormatInfo const& vertexFormatInfo(VertexFormat format);

} // namespace filament_core::backend
