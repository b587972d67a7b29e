// SPDX-License-Identifier: Apache-2.0
/// GltfSplats: the splats of a primitive with KHR_gaussian_splatting.
///   Warns    splats with a number that is not finite are left out; rotations without length become the identity;
///            opacities are clamped. Negative scales: the file is of an earlier draft, which stored logarithms.
///   Fails    Corrupt: accessors of unequal length, of another type than the specification allows, or broken.
///   Thread   any.   Memory: twice the splats.
#pragma once

#include "filament_core/assets/gltf/GltfDocument.h"

#include <string>

namespace filament_core::assets {

/// Empty if nothing is left to draw, with a warning.
PrimitiveData buildSplats(GltfDocument const& document, GltfPrimitive const& primitive, std::string const& path,
                          Diagnostics& diagnostics);

} // namespace filament_core::assets
