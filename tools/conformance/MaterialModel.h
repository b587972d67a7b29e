// SPDX-License-Identifier: Apache-2.0
/// MaterialModel: a scene whose "model" is a material: { "material": "PATH.mat" } with, as wanted,
///   "values"   { "NAME": "1,0.5" }: parameters and constants, before those of the file's "// show:" line;
///   "mesh"     instead of the file's;
///   "edits"    { "TEXT": "OTHER TEXT" }: pieces of the file that are replaced before it is compiled.
///   Paths are relative to the scene file.
///   Fails  InvalidArgument: file, field, what would be right; and as readMaterialFile().
#pragma once

#include "tools/conformance/SceneFile.h"
#include "tools/materials/MaterialStand.h"

namespace filament::conformance {

/// What such a scene says.
struct MaterialModelFile {
    std::shared_ptr<const tools::MaterialFile> file; ///< compiled
    std::string mesh;                                ///< empty: the file's
    tools::MaterialValues values;
};

bool isMaterialModel(SceneSpec const& spec);
Result<MaterialModelFile> readMaterialModel(SceneSpec const& spec);
Result<tools::MaterialStand> makeMaterialModel(Engine& engine, SceneSpec const& spec);

} // namespace filament::conformance
