// SPDX-License-Identifier: Apache-2.0
/// The pairs of frames that effects_bench compares: without and with an effect.
///   Thread  any; a pure function.   Memory: a few kB.   Fails: std::bad_alloc.
#pragma once

#include <filament_core/filament_core.h>

#include <functional>
#include <string>
#include <vector>

namespace filament_core::bench {

enum class Moving { Nothing, Model, Camera }; ///< the model turns by a degree a frame, the camera goes 2 mm

/// A model under a light, and the two views or scenes that are compared.
struct Pair {
    std::string name{}; ///< empty: passes are timed
    const char* file = nullptr;
    std::function<void(Scene&, View&)> plain{};  ///< the frame to compare with
    std::function<void(Scene&, View&)> effect{}; ///< the scene with the effect
    bool isUnseen = false;
    bool hasMirror = false; ///< a floor with screen-space reflections
    bool isCut = false;     ///< the model is loaded with section planes
    /// The effect is reflection probes in the middle: half the sides of their cubes; the model fits into 1 m.
    std::vector<float> probes{};
    Moving moving = Moving::Nothing;
};

std::vector<Pair> effectPairs();
/// The frame with screen-space reflections on or off, and without shadows.
std::function<void(Scene&, View&)> reflecting(bool isOn);

} // namespace filament_core::bench
