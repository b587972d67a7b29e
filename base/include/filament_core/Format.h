// SPDX-License-Identifier: Apache-2.0
/// How texels and vertices are stored. Names list components from the first byte up; packed formats from the low bit.
#pragma once

#include <cstdint>

namespace filament_core {

// clang-format off
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
    R8I, R32I, RG32I, RGBA8I, ///< can only be sampled
    Count,
};

/// Storage of one vertex attribute. N = normalised to [0, 1] or [-1, 1]; integers reach the shader as uint or int.
enum class VertexFormat : uint8_t {
    None,
    Float, Float2, Float3, Float4,
    Half2, Half4,
    UByte4, UByte4N, Byte4, Byte4N,
    UShort2, UShort2N, UShort4, UShort4N,
    Short2, Short2N, Short4, Short4N,
    UInt, Count,
};
// clang-format on

/// Storage of one index.
enum class IndexFormat : uint8_t { UInt16, UInt32 };

/// The texels of a texture: images, or a volume.
enum class TextureKind : uint8_t { Texture2D, Texture2DArray, Cube, CubeArray, Texture3D };

/// How vertices form primitives.
enum class PrimitiveType : uint8_t { Triangles, TriangleStrip, Lines, LineStrip, Points };

} // namespace filament_core
