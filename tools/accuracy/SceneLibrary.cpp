// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/SceneLibrary.h"

#include "base/Suggest.h"

#include <algorithm>

namespace filament_core::accuracy {

Result<SceneLibrary> SceneLibrary::read(std::filesystem::path const& folder) {
    Result<std::vector<tools::SceneSpec>> scenes = tools::readScenes(folder);
    if (!scenes) return scenes.error();
    SceneLibrary library;
    library.mScenes = std::move(*scenes);
    return library;
}

Result<tools::SceneSpec const*> SceneLibrary::find(std::string const& name) const {
    const auto found = std::ranges::find(mScenes, name, &tools::SceneSpec::name);
    if (found != mScenes.end()) return &*found;
    return fail(ErrorCode::NotFound, "there is no scene '{}'{}", name, suggestion(name, namesOf(mScenes)));
}

} // namespace filament_core::accuracy
