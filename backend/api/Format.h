// SPDX-License-Identifier: Apache-2.0
/// Format: how a texel is stored. The names list components from the first byte up; packed formats from the low bit.
///   formatInfo(f) is the one table about formats; a backend adds only its native enum.
#pragma once

#include <cstdint>

namespace filament::backend {

enum class Format : uint8_t {
    None,
    R8, RG8, RGBA8, RGBA8Srgb,
    R8UI, R32UI, RG32UI, RGBA8UI,
    RGB10A2,
    R16F, RG16F, RGBA16F,
    R32F, RG32F, RGBA32F,
    R11G11B10F, RGB9E5,
    D16, D32F, D32FS8,
    BC1, BC1Srgb, BC2, BC2Srgb, BC3, BC3Srgb, BC4, BC5, BC6HUfloat, BC7, BC7Srgb,
    Count,
};

enum class FormatKind : uint8_t { Color, UnsignedInteger, Depth, DepthStencil };

struct FormatInfo {
    const char* name;
    uint8_t bytesPerBlock; ///< bytes of one texel, or of one 4x4 block
    uint8_t blockSize;     ///< 1, or 4 for the BC formats
    uint8_t components;
    FormatKind kind;
    bool isFloat; ///< stores values beyond [0, 1]
    bool isSrgb;
    bool isRenderable; ///< may be an attachment on every device we accept
};

FormatInfo const& formatInfo(Format format);

inline bool isCompressed(Format format) { return formatInfo(format).blockSize > 1; }
inline bool hasDepth(Format format) { return formatInfo(format).kind >= FormatKind::Depth; }
inline bool hasStencil(Format format) { return formatInfo(format).kind == FormatKind::DepthStencil; }

/// Bytes of one tightly packed image of width x height texels (partial blocks count whole).
uint64_t imageBytes(Format format, uint32_t width, uint32_t height);

/// Levels of a full mip chain: floor(log2(max(width, height))) + 1.
uint32_t fullMipCount(uint32_t width, uint32_t height);

/// Storage of one vertex attribute. N = normalised to [0, 1] or [-1, 1]; integers reach the shader as uint/int.
enum class VertexFormat : uint8_t {
    None,
    Float, Float2, Float3, Float4,
    Half2, Half4,
    UByte4, UByte4N, Byte4, Byte4N,
    UShort2, UShort2N, UShort4, UShort4N,
    Short2, Short2N, Short4, Short4N,
    UInt, Count,
};

struct VertexFormatInfo {
    const char* name;
    uint8_t bytes;
    uint8_t components;
    bool normalized;
    bool integer; ///< the shader declares uint or int vectors
};

VertexFormatInfo const& vertexFormatInfo(VertexFormat format);

} // namespace filament::backend
