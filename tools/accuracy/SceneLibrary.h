// SPDX-License-Identifier: Apache-2.0
/// SceneLibrary: the scenes in which errors are measured, by name: a folder of files in the format of the conformance
/// tests (docs/conformance.md).
///   Fails   NotFound with the nearest name; errors of the scene files.
///   Thread  read-only after read().
#pragma once

#include "toolkit/scenes/SceneAssets.h"

namespace filament_core::accuracy {

class SceneLibrary {
public:
    static Result<SceneLibrary> read(std::filesystem::path const& folder);
    /// The pointer is valid as long as the library.
    Result<tools::SceneSpec const*> find(std::string const& name) const;

private:
    std::vector<tools::SceneSpec> mScenes;
};

} // namespace filament_core::accuracy
