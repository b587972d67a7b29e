// SPDX-License-Identifier: Apache-2.0
/// MaterialTerms: every shading model and every layer alone, and all layers together, as changes of one material.
///   In      terms.mat, whose parameters are color, metallic, roughness, strength (of the layer), smallRoughness (of a
///           coat and of what refracts), tint (of a sheen, of cloth, of what is below a surface) and normalMap.
///   Thread  any; pure.
#pragma once

#include "tools/materials/MaterialFile.h"

#include <string>
#include <vector>

namespace filament::tools {

struct MaterialTerm {
    std::string name;
    std::vector<TextEdit> edits;
};

/// The first is the standard model.
std::vector<MaterialTerm> materialTerms();
Result<std::shared_ptr<const MaterialFile>> readMaterialTerm(MaterialTerm const& term);

} // namespace filament::tools
