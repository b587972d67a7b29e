// SPDX-License-Identifier: Apache-2.0
#include "backend/api/Format.h"

#include <algorithm>
#include <array>
#include <bit>

namespace filament_core::backend {
namespace {

using enum FormatKind;

// clang-format off
constexpr std::array<FormatInfo, static_cast<size_t>(Format::Count)> kFormats{ {
        { "None", 0, 1, 0, Color, false, false, false },
        { "R8", 1, 1, 1, Color, false, false, true },
        { "RG8", 2, 1, 2, Color, false, false, true },
        { "RGBA8", 4, 1, 4, Color, false, false, true },
        { "RGBA8Srgb", 4, 1, 4, Color, false, true, true },
        { "R8UI", 1, 1, 1, UnsignedInteger, false, false, true },
        { "R32UI", 4, 1, 1, UnsignedInteger, false, false, true },
        { "RG32UI", 8, 1, 2, UnsignedInteger, false, false, true },
        { "RGBA8UI", 4, 1, 4, UnsignedInteger, false, false, true },
        { "RGB10A2", 4, 1, 4, Color, false, false, true },
        { "R16F", 2, 1, 1, Color, true, false, true },
        { "RG16F", 4, 1, 2, Color, true, false, true },
        { "RGBA16F", 8, 1, 4, Color, true, false, true },
        { "R32F", 4, 1, 1, Color, true, false, true },
        { "RG32F", 8, 1, 2, Color, true, false, true },
        { "RGBA32F", 16, 1, 4, Color, true, false, true },
        { "R11G11B10F", 4, 1, 3, Color, true, false, true },
        { "RGB9E5", 4, 1, 3, Color, true, false, false },
        { "D16", 2, 1, 1, Depth, false, false, true },
        { "D32F", 4, 1, 1, Depth, true, false, true },
        { "D32FS8", 8, 1, 2, DepthStencil, true, false, true },
        { "BC1", 8, 4, 4, Color, false, false, false },
        { "BC1Srgb", 8, 4, 4, Color, false, true, false },
        { "BC2", 16, 4, 4, Color, false, false, false },
        { "BC2Srgb", 16, 4, 4, Color, false, true, false },
        { "BC3", 16, 4, 4, Color, false, false, false },
        { "BC3Srgb", 16, 4, 4, Color, false, true, false },
        { "BC4", 8, 4, 1, Color, false, false, false },
        { "BC5", 16, 4, 2, Color, false, false, false },
        { "BC6HUfloat", 16, 4, 3, Color, true, false, false },
        { "BC7", 16, 4, 4, Color, false, false, false },
        { "BC7Srgb", 16, 4, 4, Color, false, true, false },
        { "R8I", 1, 1, 1, SignedInteger, false, false, false },
        { "R32I", 4, 1, 1, SignedInteger, false, false, false },
        { "RG32I", 8, 1, 2, SignedInteger, false, false, false },
        { "RGBA8I", 4, 1, 4, SignedInteger, false, false, false },
} };

constexpr std::array<VertexFormatInfo, static_cast<size_t>(VertexFormat::Count)> kVertexFormats{ {
        { "None", 0, 0, false, false },
        { "Float", 4, 1, false, false },
        { "Float2", 8, 2, false, false },
        { "Float3", 12, 3, false, false },
        { "Float4", 16, 4, false, false },
        { "Half2", 4, 2, false, false },
        { "Half4", 8, 4, false, false },
        { "UByte4", 4, 4, false, true },
        { "UByte4N", 4, 4, true, false },
        { "Byte4", 4, 4, false, true },
        { "Byte4N", 4, 4, true, false },
        { "UShort2", 4, 2, false, true },
        { "UShort2N", 4, 2, true, false },
        { "UShort4", 8, 4, false, true },
        { "UShort4N", 8, 4, true, false },
        { "Short2", 4, 2, false, true },
        { "Short2N", 4, 2, true, false },
        { "Short4", 8, 4, false, true },
        { "Short4N", 8, 4, true, false },
        { "UInt", 4, 1, false, true },
} };
// clang-format on

} // namespace

FormatInfo const& formatInfo(Format format) { return kFormats[static_cast<size_t>(format)]; }

VertexFormatInfo const& vertexFormatInfo(VertexFormat format) { return kVertexFormats[static_cast<size_t>(format)]; }

uint64_t imageBytes(Format format, uint32_t width, uint32_t height) {
    FormatInfo const& info = formatInfo(format);
    const uint64_t columns = (width + info.blockSize - 1u) / info.blockSize;
    const uint64_t rows = (height + info.blockSize - 1u) / info.blockSize;
    return columns * rows * info.bytesPerBlock;
}

uint32_t fullMipCount(uint32_t width, uint32_t height) {
    return static_cast<uint32_t>(std::bit_width(std::max({ width, height, 1u })));
}

} // namespace filament_core::backend
