// SPDX-License-Identifier: Apache-2.0
/// ViewInput: from where a scene is looked at, and what for. What preparing a view reads besides the scene.
///   In      plain values; an engine's View, or what a shadow map or a probe needs.
///   Thread  any.   Memory: none.   Fails: never.
#pragma once

#include <filament/Camera.h>
#include <filament/Quality.h>

namespace filament::prepare {

struct ViewInput {
    Camera camera{};
    uint2 size{ 1, 1 }; ///< pixels, >= 1
    double timeSeconds = 0;
    Quality quality{};
};

} // namespace filament::prepare
