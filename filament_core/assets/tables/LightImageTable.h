// SPDX-License-Identifier: Apache-2.0
/// LightImageTable: an image of a light as shaders read it: mip levels of RGB9E5, each with a border of one texel.
///   In      linear colours.   Out: kLightImageHeaderWords words, where each level begins, and the levels
///           (shader::kImageHeaderWords); surface/light_images.glsl looks up.
///   Border  repeats the edge, continues the octahedral map, or is that of the next tile: look-ups need no cases.
///   Levels  means over areas; of what an area emits, means weighted by Gaussians of 2^level texels. At most
///           kMaxLightImageSize a side; a larger image is averaged to that.
///   Memory  4 B a texel and a third more.
///   Thread  any; pure. Fails: std::bad_alloc.
#pragma once

#include "base/math/Math.h"

#include <filament_core/Objects.h>

#include <cstdint>
#include <vector>

namespace filament_core::assets {

/// Linear colours, rows from the top. Every number is finite and at least 0.
struct LightPixels {
    uint32_t width = 0, height = 0;
    std::vector<float3> colors{};
};

/// Of formats that LightImageDesc allows; numbers that are none or negative become 0. `pixels` holds all of them.
LightPixels lightPixels(LightImageDesc const& desc);

/// Six faces beside or below each other as an octahedral map around -Z of the cube, of twice a face's side, at most
/// kMaxLightImageSize.
LightPixels octahedronOfCube(LightPixels const& faces);
/// Of six faces, between four texels of a face, as every API samples it; `direction` is not zero.
float3 colorOfCube(LightPixels const& faces, double3 direction);

/// Means over the areas that the new pixels cover.
LightPixels averaged(LightPixels const& image, uint32_t width, uint32_t height);

inline constexpr uint32_t kLightImageHeaderWords = 4; ///< columns, rows, the last level, the number

/// `number`: of the image, different for all images of an engine.
std::vector<uint32_t> lightImageTable(LightPixels const& image, LightImageShape shape, uint32_t number);

} // namespace filament_core::assets
