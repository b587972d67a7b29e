// SPDX-License-Identifier: Apache-2.0
/// GltfUvSets: the up to four sets of texture coordinates that a primitive keeps, of any number in the file.
///   In      attributes with all sets (GltfAttributes::uvSets), and maps with the set of the file.
///   Out     GltfAttributes::uv, and maps whose uvSet is 0 to 3. Sets 0 and 1 stay where they are, unless maps use
///           higher ones, which take the places that the maps leave free. If maps use more than two sets, those of base
///           colour and emission take the first two places, because unlit materials have no others. Materials of one
///           primitive (variants) have the same places, and so has a material in all of its primitives.
///   Limits  four sets for the materials of a primitive, two of them for base colours and emission: those of the first
///           maps. Other maps follow the first set, with a warning.
///   Thread  one. Cost: linear in primitives and materials.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"

namespace filament_core::assets {

void chooseUvSets(GltfDocument& document);

/// Of materials that are used: the maps that do not follow their set.
void warnAboutUvSets(GltfDocument& document, Diagnostics& diagnostics);

} // namespace filament_core::assets
