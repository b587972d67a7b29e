// SPDX-License-Identifier: Apache-2.0
/// checkAsset: which texels of a model's materials have values that no real material has (`--check-asset`).
///   In      a .gltf or .glb. Materials that its default scene shows; vertex colours do not count.
///   Out     for each material the share of texels that break a rule, each counted for the first rule that it breaks.
///           Texels of the coordinates 0 to 1, as many as the largest map has; maps with other coordinates count at the
///           same numbers. Texels that are cut out or invisible do not count. Unlit and specular-glossiness materials
///           have no such values: they are named as not checked.
///   Thread  one.   Memory: the images of the model.
///   Fails   InvalidArgument without a model; as assets::loadGltf().
#pragma once

#include "base/Result.h"
#include "filament_core/assets/files/PathInside.h"
#include "filament_core/assets/gltf/ModelData.h"

#include <filament_core/DebugViews.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace filament_core::tools {

struct MaterialFindings {
    std::string name;                                  ///< of the material, or "material 3"
    bool isChecked = false;                            ///< it has the values that the rules are about
    uint64_t texels = 0;                               ///< that count
    std::array<uint64_t, kPlausibilityRules> broken{}; ///< texels by PlausibilityRule
};

struct AssetFindings {
    std::string file;
    std::vector<MaterialFindings> materials;
    std::vector<std::string> warnings; ///< of the loader
    bool isPlausible() const;
};

/// `index`: of the material.
MaterialFindings checkMaterial(assets::ModelData const& model, uint32_t index);
/// `files`: which buffers and images are opened.
Result<AssetFindings> checkAsset(std::filesystem::path const& model, assets::FilesFrom files);

/// A line for each rule that a material breaks, and a line of the sum.
std::string textOf(AssetFindings const& findings);

} // namespace filament_core::tools
