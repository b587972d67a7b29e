// SPDX-License-Identifier: Apache-2.0
/// Settings: everything that a row of the accuracy table can change, by name: "specularVisibility=fast", "samples=4",
/// "environment.faceSize=64", "bake.lightmap=8".
///   Names   the options of View; those of this file for the options of loading files, with the prefix of the loader;
///           "bake.grid" in metres and "bake.lightmap" in texels a metre (Bakes.h).
///   Fails   NotFound, InvalidArgument: the word, and what is valid.
///   Thread  any.
#pragma once

#include "base/Result.h"

#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>
#include <filament_core/View.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::accuracy {

/// The light that is baked before a scene is drawn.
struct BakeChoice {
    double gridMeters = 0;     ///< between probes of an irradiance grid; 0: no grid
    double texelsPerMeter = 0; ///< of a lightmap; 0: none
    friend bool operator==(BakeChoice const&, BakeChoice const&) = default;
};

struct Settings {
    View view{}; ///< but camera, size and what belongs to the scene
    EnvironmentLoadOptions environment{};
    GltfLoadOptions model{};
    EngineOptions engine{}; ///< but backend and cache
    BakeChoice bake{};
    /// The words that set options of loading, in order. With equal texts, equal files are loaded and equal engines
    /// made.
    std::string environmentKey{}, modelKey{}, engineKey{};
};

Result<void> change(Settings& settings, std::string_view word);
Result<void> change(Settings& settings, std::span<const std::string> words);

/// All values of a choice that are worth measuring; nothing for an unknown choice.
std::vector<std::string> valuesOf(std::string_view choice);

} // namespace filament_core::accuracy
