// SPDX-License-Identifier: Apache-2.0
/// decodeBlocks: a block-compressed image as plain texels, so that every device shows the same bits.
///   In      bytesOfBlocks() bytes. Any of them are valid: reserved codes of BC6 and BC7 are black, those of ASTC and
///           UASTC are magenta, as the specifications of the formats say for errors.
///   Out     RGBA, row 0 first, tightly packed: 8 bytes a texel if hasHalfTexels(), otherwise 4. Channels that a format
///           does not have are 0, alpha is 1. The codes are those of the file: sRGB stays sRGB.
///   Bits    exactly those of the specification where it states them in integers (BC6, BC7, ETC2, ASTC, UASTC); the
///           nearest codes of BC1 to BC5, which it states in real numbers; the nearest halves of EAC.
///   Thread  any; pure. Allocates nothing.
///   Cost    bench/filament_core/assets/README.md
///   Sources  Khronos Data Format Specification 1.3, chapters 18 to 23; UASTC LDR 4x4 Texture Specification (Binomial)
#pragma once

#include "filament_core/assets/blocks/BlockFormat.h"

#include <cstddef>
#include <span>

namespace filament_core::assets {

/// `isSrgb`: the colours of ASTC and UASTC are codes of sRGB, which are interpolated with other low bits
/// ("Weight Application"). `pixels` has width * height texels.
void decodeBlocks(BlockFormat format, bool isSrgb, std::span<const std::byte> blocks, uint32_t width, uint32_t height,
                  std::span<std::byte> pixels);

} // namespace filament_core::assets
