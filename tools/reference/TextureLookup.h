// SPDX-License-Identifier: Apache-2.0
/// lookUp: samples a texture at a coordinate, as the GPU filters its largest level, in double precision.
///   In      RGBA8 or RGBA8Srgb images of ModelData with their samplers.
///   Out     linear components; sRGB is decoded before filtering, alpha never.
///   Differs from the engine: no mip levels. The mean over many samples of a pixel is the exact result that mip maps
///   approximate. The magnification filter is used at any distance.
///   Thread  pure functions.
#pragma once

#include "filament_core/assets/gltf/ModelData.h"

namespace filament_core::reference {

double4 lookUp(assets::Image const& image, Sampler const& sampler, double2 uv);

/// The texel for a coordinate outside [0, size).
int wrapped(int coordinate, int size, backend::WrapMode mode);

} // namespace filament_core::reference
