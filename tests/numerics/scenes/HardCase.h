// SPDX-License-Identifier: Apache-2.0
/// HardCase: one row of the table of scenes that break renderers. A feature joins by adding a row.
///   Every row is drawn on both APIs, which must agree to the bit, without a word from a validation layer and without
///   an inf or NaN; on top of that it states the expected image, in one of three ways:
///     twin     another scene of the same appearance (the same one at the origin, at scale 1, with the geometry baked);
///              displayed, the two differ by at most `tolerance` of 255
///     mirrored the twin's image is this one with left and right swapped
///     holds    claims about the scene-linear image, from a closed form in double precision (Exact.h)
#pragma once

#include "tests/numerics/scenes/Stage.h"

#include <functional>
#include <string>
#include <vector>

namespace filament_core::hard {

using SceneBuilder = std::function<void(Stage&)>;

struct HardCase {
    std::string name; ///< a claim that can be false; file names and ctest filters use it
    SceneBuilder scene;
    SceneBuilder twin{};
    uint32_t tolerance = 1;
    bool mirrored = false;
    std::function<void(Picture const&)> holds{};
};

std::vector<HardCase> distanceRows(); ///< far from the origin, tiny and huge
std::vector<HardCase> shapeRows();    ///< odd transforms and vertices
std::vector<HardCase> lightRows();    ///< noon, moonlight, lamps; what half floats cannot hold
std::vector<HardCase> lensRows();     ///< near planes and odd targets
std::vector<HardCase> fileRows();     ///< degenerate glTF attributes; surfaces in one place

} // namespace filament_core::hard
