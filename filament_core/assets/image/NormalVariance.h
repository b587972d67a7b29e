// SPDX-License-Identifier: Apache-2.0
/// withNormalVariance: the variance of the normals that each texel of a mip level averages, in alpha of a normal map.
///   In      a normal map with all levels, RGBA8 or RGBA16F, [0, 1]^3 for [-1, 1]^3; what its alpha holds is lost.
///   Out     the same normals. Alpha is 0 in the first level. In the others it is normalWidth() of the length of the
///           mean unit normal of what the texel covers of the first level (shaders/lib/normals.glsl).
///   Thread  any; the same bits everywhere (doubles without transcendental functions, in one order).
///   Memory  24 B per texel of the second level while it runs.
///   Cost    docs/gltf.md: of a model with four maps of 512 x 512.
#pragma once

#include "filament_core/assets/image/Image.h"

namespace filament_core::assets {

/// Starts with the first level that is not larger than `maxSize` in any direction (0: no limit).
Image withNormalVariance(Image image, uint32_t maxSize = 0);

} // namespace filament_core::assets
