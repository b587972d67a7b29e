// SPDX-License-Identifier: Apache-2.0
/// MaterialTerms: every shading model and every layer alone, and all layers together, as variations of one material.
///   In      terms.mat, whose parameters are color, metallic, roughness, strength (of the layer), smallRoughness (for
///           coats and refraction), tint (for sheen, cloth and subsurface) and normalMap.
///   Thread  any; pure.
#pragma once

#include "toolkit/materials/MaterialFile.h"

#include <string>
#include <vector>

namespace filament_core::tools {

struct MaterialTerm {
    std::string name;
    std::vector<TextEdit> edits;
};

/// The first is the standard model.
std::vector<MaterialTerm> materialTerms();
/// `filteredVariants`: VariantBits that are never requested.
Result<std::shared_ptr<const MaterialFile>> readMaterialTerm(MaterialTerm const& term, uint16_t filteredVariants = 0);

} // namespace filament_core::tools
