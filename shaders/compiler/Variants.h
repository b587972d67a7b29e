// SPDX-License-Identifier: Apache-2.0
/// The variants of a material: one for every combination of features that the scene may request and that no filter
/// excludes.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

#include <cstdint>
#include <vector>

namespace filament_core::shader {

/// The bits that can change the code of such a material: no lights for unlit materials, kVariantHalf only if the
/// material requests it, kVariantMerged for post-process materials with currentPixel parameters. Materials in object
/// space can be deformed; opaque and masked ones leave depth.
uint16_t selectableBits(MaterialDefinition const& definition);

/// Ascending; always contains 0. `selectable`: see above.
std::vector<uint16_t> variantKeys(uint16_t selectable, uint16_t filteredBits);

} // namespace filament_core::shader
