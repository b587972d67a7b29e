// SPDX-License-Identifier: Apache-2.0
/// readMaterials: the engine's materials for a glTF model, unpacked and specialised beside frames.
///   In      a model from the loader, and properties of the engine (GltfMaterialChoice).
///   Out     by materialKey(): each material that the primitives of the model are drawn with, in any of its variants.
///           GltfMaterials takes them from there.
///   Thread  any; with jobs. Each package is unpacked once.
///   Memory  the code of all variants for both APIs: about 3 MB a material.
///   Fails   std::bad_alloc.
///   Cost    20 to 40 ms a package, 1 to 5 ms a material.
#pragma once

#include "filament_core/assets/gltf/ModelData.h"
#include "filament_core/engine/gltf/GltfMaterialSettings.h"
#include "filament_core/scene/Materials.h"
#include "jobsystem/JobSystem.h"
#include "shaders/package/EngineMaterials.h"

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace filament_core {

/// The properties of an engine, constant while it lives, and of loading that select the material of a glTF material.
struct GltfMaterialChoice {
    /// Of an engine material; exact by default. Any thread.
    std::function<std::span<const std::byte>(std::string_view)> package = &shader::engineMaterial;
    size_t maxMaps = SIZE_MAX;  ///< see settingsOf()
    bool sectionPlanes = false; ///< GltfLoadOptions::sectionPlanes, of the model
};

/// Equal for settings that share a material: the package and its constants.
std::string materialKey(GltfMaterialSettings const& settings);

/// What createMaterial() takes for such settings.
MaterialDesc materialDesc(GltfMaterialSettings const& settings, GltfMaterialChoice const& choice);

/// glTF 2.0, section 3.9.6: of primitives without one.
assets::MaterialData const& materialOf(assets::ModelData const& model, uint32_t index);

using GltfReadyMaterials = std::map<std::string, scene::Material>;

GltfReadyMaterials readMaterials(assets::ModelData const& model, GltfMaterialChoice const& choice,
                                 jobs::JobSystem& jobs);

} // namespace filament_core
