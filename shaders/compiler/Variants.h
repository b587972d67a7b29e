// SPDX-License-Identifier: Apache-2.0
/// Which variants of a material exist: one for every combination of what the scene may ask of it and no filter
/// excludes.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/package/Package.h"

#include <cstdint>
#include <vector>

namespace filament::shader {

/// The bits that can change the code of such a material: none for unlit and post-process ones. kVariantHalf only where
/// the material asks for it.
uint16_t selectableBits(MaterialDomain domain, ShadingModel shading, bool halfPrecision);

/// Ascending; always contains 0. `selectable`: see above.
std::vector<uint16_t> variantKeys(uint16_t selectable, uint16_t filteredBits);

} // namespace filament::shader
