// SPDX-License-Identifier: Apache-2.0
/// MaterialModel: a scene whose "model" is a material: { "material": "PATH.mat" } and optionally
///   "values"   { "NAME": "1,0.5" }: parameters and constants, which override those of the file's "// show:" line;
///   "mesh"     replaces the file's mesh;
///   "edits"    { "TEXT": "OTHER TEXT" }: pieces of the file to replace before compiling;
///   "variantFilter"  [ "skinning" ]: variants that the scene never requests, which saves compiling them.
///   Paths are relative to the scene file.
///   Fails  InvalidArgument: file, field, what is valid; and as readMaterialFile().
#pragma once

#include "toolkit/materials/MaterialStand.h"
#include "toolkit/scenes/SceneFile.h"

namespace filament_core::tools {

/// The contents of such a scene.
struct MaterialModelFile {
    std::shared_ptr<const MaterialFile> file; ///< compiled
    std::string mesh;                         ///< empty: the file's
    MaterialValues values;
};

bool isMaterialModel(SceneSpec const& spec);
Result<MaterialModelFile> readMaterialModel(SceneSpec const& spec);
Result<MaterialStand> makeMaterialModel(Engine& engine, SceneSpec const& spec);

/// All values of a copy: the file's, the model's, its own; later ones replace earlier ones.
MaterialValues valuesOfCopy(MaterialModelFile const& model, SceneSpec const& spec, size_t copy);
/// All copies of the scene, with a root each: those with values of their own as other instances of the stand's
/// material.
Result<std::vector<Node>> addMaterialCopies(Engine& engine, Scene& scene, SceneSpec const& spec, MaterialStand& stand);

} // namespace filament_core::tools
