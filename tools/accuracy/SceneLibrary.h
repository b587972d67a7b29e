// SPDX-License-Identifier: Apache-2.0
/// SceneLibrary: the scenes that errors are measured in, by name: files as those of the conformance tests
/// (docs/conformance.md), in a folder.
///   Fails   NotFound with the nearest name; what the scene files themselves say.
///   Thread  read-only after read().
#pragma once

#include "tools/conformance/SceneAssets.h"

namespace filament::accuracy {

class SceneLibrary {
public:
    static Result<SceneLibrary> read(std::filesystem::path const& folder);
    /// The pointer lives as long as the library.
    Result<conformance::SceneSpec const*> find(std::string const& name) const;

private:
    std::vector<conformance::SceneSpec> mScenes;
};

} // namespace filament::accuracy
