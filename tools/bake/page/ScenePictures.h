// SPDX-License-Identifier: Apache-2.0
/// drawScene: one view of a scene three times: by the engine with the plain environment, by the engine with what was
/// baked, and by the path tracer.
///   Out     scene-linear images without a visible sky, and how far the first two are from the third.
///   Device  the first that there is, Vulkan before OpenGL ES. Without one the engine's images are missing, and
///           `problem` says why: a bake that took hours must not fail for want of them.
///   Thread  one at a time; works on the job system.
///   Fails   errors of the path tracer.
///   Cost    seconds: loads the model twice, and compiles its materials.
#pragma once

#include "toolkit/pictures/BlockErrors.h"
#include "tools/bake/Options.h"
#include "tools/reference/Reference.h"

#include <filament_core/Camera.h>
#include <filament_core/IrradianceGrid.h>

namespace filament_core::bake {

/// What the second image has in place of the plain scene.
struct BakedParts {
    std::filesystem::path model;              ///< with lightmaps; empty: that of the options
    std::optional<IrradianceGridDesc> grid{}; ///< lights it
};

struct EnginePicture {
    tools::Picture picture;
    tools::BlockErrors errors; ///< beside the traced one
};

struct ScenePictures {
    std::optional<EnginePicture> before, after;
    tools::Picture traced;
    std::string device;  ///< that drew
    std::string problem; ///< in one line; empty: none
};

Result<ScenePictures> drawScene(Options const& options, Camera const& camera, reference::TracedScene const& scene,
                                BakedParts const& baked, jobs::JobSystem& jobs);

/// As a display shows it: through the engine's ACES curve.
Image shownImage(tools::Picture const& picture);

} // namespace filament_core::bake
