// SPDX-License-Identifier: Apache-2.0
/// CubePicture: the radiance of a cube map in a KTX 2.0 file, which is baked like a panorama.
///   In      a cube of floats (16 or 32 bits, RGB9E5, R11G11B10F, BC6H) or codes of 16 bits; its first level of at most
///           kMaxCubeFace texels a side. Other levels are ignored: who filtered them, and how, is not known.
///           Faces are those of the specification, seen from inside as every API samples them (IblDirections.h).
///   Out     an IblCube whose first level has `size` texels a side, a power of two; repaired values are counted. A
///           smaller cube is interpolated, a larger one averaged.
///   Thread  runs on the job system; the same bits for any number of workers.
///   Memory  about 44 bytes per texel of the level that is read.
///   Fails   Corrupt, Unsupported: one line with file, reason and cure.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/environment/IblCube.h"

#include <span>
#include <string_view>

namespace filament_core::assets {

inline constexpr uint32_t kMaxCubeFace = 2048;

struct CubePicture {
    IblCubeLevel radiance; ///< as in the file; its size need not be a power of two
    HdrRepairs repairs;
};

Result<CubePicture> decodeCubePicture(std::span<const std::byte> ktx2, std::string_view name);

/// The faces one below the other, and back.
HdrImage imageFromPicture(CubePicture const& picture);
void setImage(CubePicture& picture, HdrImage const& faces);

/// `size` is a power of two.
IblCube cubeFromPicture(CubePicture const& picture, uint32_t size, jobs::JobSystem& jobs);

} // namespace filament_core::assets
