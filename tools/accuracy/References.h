// SPDX-License-Identifier: Apache-2.0
/// References: the picture that an effect's values are compared with.
///   Thread  one at a time.
///   Fails   errors of the scenes, the engine and tools/reference.
#pragma once

#include "tools/accuracy/Effect.h"
#include "tools/accuracy/Integrals.h"
#include "tools/accuracy/SceneLibrary.h"
#include "tools/accuracy/Studio.h"

namespace filament_core::accuracy {

/// Where references are rendered.
struct ReferenceStage {
    Studio& studio;
    SceneLibrary const& scenes;
    tools::SceneFolders const& folders;
    jobs::JobSystem& jobs;
};

struct Truth {
    Picture picture;
    Edges edges = Edges::Count;
    double standardError = 0; ///< relative, of a traced picture
};

/// The scene's own settings, then `base`, then `set`.
Result<Settings> settingsFor(tools::SceneSpec const& scene, std::vector<std::string> const& base,
                             std::vector<std::string> const& set);

Result<Picture> shoot(Studio& studio, tools::SceneSpec const& scene, Settings const& settings, uint2 size, bool linear);

/// Not for Integral, which has no picture, or OtherBackend, which has one per value.
Result<Truth> makeTruth(Reference const& reference, tools::SceneSpec const& scene, std::vector<std::string> const& base,
                        ReferenceStage const& stage);

} // namespace filament_core::accuracy
