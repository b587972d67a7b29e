// SPDX-License-Identifier: Apache-2.0
/// GltfMaterialSettings: a glTF material in the words of the engine's glTF packages (shaders/material/gltf):
/// which package, specialised to what, with which parameters and maps.
///   In      a material as the loader made it.   Out: plain values; no engine, no device.
///   Cost    a package is chosen by what has to be compiled differently: shading model, refraction, blending.
///           Everything else is a specialisation constant, and what is not used is not in the pipeline. Without any
///           layer the package is gltf_lit, whose text has none.
///   Thread  any.
#pragma once

#include "filament_core/assets/gltf/MaterialData.h"

#include <filament/Objects.h>

#include <string>
#include <utility>
#include <vector>

namespace filament {

struct GltfMap {
    std::string stem; ///< baseColor: baseColorMap, baseColorUvMatrix, baseColorUv, baseColorTransform
    assets::TextureRef texture;
};

struct GltfMaterialSettings {
    std::string package;
    std::vector<MaterialConstant> constants; ///< only those that differ from their defaults
    std::vector<std::pair<const char*, ParameterValue>> parameters;
    std::vector<GltfMap> maps;
};

/// `scale`: metres in the file's scene for a metre of the mesh, > 0; what a volume absorbs grows with it.
GltfMaterialSettings settingsOf(assets::MaterialData const& material, bool hasVertexColor, float scale = 1);

} // namespace filament
