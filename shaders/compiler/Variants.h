// SPDX-License-Identifier: Apache-2.0
/// Which variants of a material exist: one for every combination of what the scene may ask of it and no filter
/// excludes.
///   Thread  any. Fails: never.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

#include <cstdint>
#include <vector>

namespace filament::shader {

/// The bits that can change the code of such a material: none for post-process ones, no lights for unlit ones,
/// kVariantHalf only where the material asks for it. What is given in object space can be deformed.
uint16_t selectableBits(MaterialDefinition const& definition);

/// Ascending; always contains 0. `selectable`: see above.
std::vector<uint16_t> variantKeys(uint16_t selectable, uint16_t filteredBits);

} // namespace filament::shader
