// SPDX-License-Identifier: Apache-2.0
/// GltfMaterialSettings: which of the engine's glTF packages (shaders/material/gltf) a glTF material uses, with which
/// constants, parameters and maps.
///   In      a material as the loader made it.   Out: plain values; no engine, no device.
///   Cost    packages differ only where the code must: shading model, refraction, blending. Everything else is a
///           specialisation constant, and unused features are not in the pipeline. A material without layers uses
///           gltf_lit, whose text has none.
///   Thread  any.
#pragma once

#include "filament_core/assets/gltf/ModelData.h"

#include <filament_core/Objects.h>

#include <compare>
#include <string>
#include <utility>
#include <vector>

namespace filament_core {

struct GltfMap {
    std::string stem; ///< baseColor: baseColorMap, baseColorUvMatrix, baseColorUv, baseColorTransform
    assets::TextureRef texture;
};

using GltfParameters = std::vector<std::pair<const char*, ParameterValue>>; ///< literals

struct GltfMaterialSettings {
    std::string package;
    std::vector<MaterialConstant> constants; ///< only those that differ from the defaults
    GltfParameters parameters;
    std::vector<GltfMap> maps;
    std::vector<std::string> leftOut; ///< stems of maps that did not fit; only their factors count
};

/// The properties of a primitive that select its material.
struct GltfVertices {
    bool hasColor = false;
    bool hasNormals = true;  ///< without, base colour and emission are unlit (glTF 2.0, 3.9.7)
    bool hasTangents = true; ///< without, normal maps are ignored (glTF 2.0, 3.9.7)
    assets::TangentBasis basis{};
    auto operator<=>(GltfVertices const&) const = default;
};
GltfVertices verticesOf(assets::PrimitiveData const& primitive);

/// `scale`: metres in the file's scene per metre of the mesh, > 0; the absorption of a volume grows with it.
/// `maxMaps`: maps that the device can sample beside the engine's textures; the maps of the last layers go first.
GltfMaterialSettings settingsOf(assets::MaterialData const& material, GltfVertices const& vertices, float scale = 1,
                                size_t maxMaps = SIZE_MAX);

/// The package with section planes (GltfLoadOptions::sectionPlanes) in the place of the one of `settings`. There are
/// fewer of them: that with layers draws what has none, and masked ones draw opaque materials, without holes.
void useSections(GltfMaterialSettings& settings);

/// The `parameters` of settingsOf() in place of those that are there. Allocates only if they have never been as many.
void readParameters(assets::MaterialData const& material, GltfVertices const& vertices, float scale,
                    GltfParameters& parameters);

} // namespace filament_core
