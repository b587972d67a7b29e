// SPDX-License-Identifier: Apache-2.0
/// DarkLights: takes the light of some lights out of a frame and leaves everything else as it is: which lights are
/// listed, where their shadow maps lie, which variants draw. So frames with different dark lights differ in nothing
/// but amounts of light, and the shares of lights add up (<filament_core/Shares.h>).
///   In      ViewInput::darkLights and darkEnvironment.
///   When    after probes and grids, which write the environment's factor; before lists by channel, which copy lights.
///   Memory  the arena: a copy of the lights of a view.   Cost: none if nothing is dark.
#pragma once

#include "filament_core/prepare/PrepareView.h"

namespace filament_core::prepare {

/// Whether that light is dark.
inline bool isDark(ViewInput const& input, size_t record) {
    return !input.darkLights.empty() && input.darkLights[record] != 0;
}

void darken(Arena& arena, scene::SceneData const& scene, ViewInput const& input, PreparedView& view);

} // namespace filament_core::prepare
