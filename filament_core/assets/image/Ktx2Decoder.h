// SPDX-License-Identifier: Apache-2.0
/// decodeKtx2: the texels of a KTX 2.0 file.
///   In      the bytes of the file, untrusted; `name` is used in error messages.
///   Reads   BC1 to BC7, ETC1, ETC2, EAC and ASTC LDR (blocks/BlockFormat.h); plain formats of 1 to 4 channels with 4
///           to 32 bits; Basis Universal's ETC1S (BasisLZ) and UASTC LDR 4x4. Supercompressed with Zstandard or zlib.
///           Two-dimensional textures, arrays and cubes. Not video, nor colours that are multiplied by alpha.
///   Out     RGBA8 where 8 bits hold all of it, RGBA8Srgb if the file is sRGB; otherwise RGBA16F, or on request
///           RGBA32F. KTXswizzle and KTXorientation are applied. Row 0 is at the top, faces are +x -x +y -y +z
///           -z. On request BC7, BC7Srgb or BC6HUfloat instead, without decoding (keepsBc7, keepsBc6). Of Basis
///           textures, by the channels of their descriptor:
///             ETC1S  RGB: r g b 1.  RGB, AAA: r g b a.  RRR: r r r 1.  RRR, GGG: r r r g.
///             UASTC  RGB: r g b 1.  RGBA: r g b a.  RRR: r r r 1.  RRRG: r r r g.  RG: r g 0 1.
///   Thread  any; no shared state.
///   Memory  the result, and one level decompressed.
///   Limits, fails  as readKtx2(); the length of every level is checked before memory is allocated.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/Image.h"
#include "filament_core/assets/image/Ktx2File.h"

#include <span>
#include <string_view>

namespace filament_core::assets {

struct Ktx2Options {
    bool isFull = false;     ///< RGBA32F instead of RGBA16F
    uint32_t maxSize = 0;    ///< starts with the first level of the file that is not larger, or its last; 0: no limit
    bool isOneLevel = false; ///< leaves out all levels but the first
    /// Blocks of BC7 stay as they are, if the file has all levels, down to 1 x 1, and its texels need no rearrangement.
    bool keepsBc7 = false;
    /// As keepsBc7, for blocks of BC6H without a sign, whatever the levels of the file.
    bool keepsBc6 = false;
};

struct Ktx2Texture {
    Image image; ///< the levels of the file that are wanted, in sequence
    bool isCube = false, isArray = false;
    bool isSrgb = false; ///< what the file says of its colours
};

Result<Ktx2Texture> decodeKtx2(std::span<const std::byte> bytes, std::string_view name,
                               Ktx2Options const& options = {});

} // namespace filament_core::assets
