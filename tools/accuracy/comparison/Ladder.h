// SPDX-License-Identifier: Apache-2.0
/// Ladder: leads from the engine's image to the path tracer's, one named approximation at a time.
///   Idea     the first rung is the engine's image, the last one the exact light. Between two neighbours exactly one
///            approximation is made exact: first in the engine, then, once both compute the same thing, in the
///            reference. The differences between neighbours add up to the whole difference, pixel by pixel, and each
///            has a name, except one: there should be no difference between the engine at its finest and the reference
///            with the same approximations.
///   Adding   one row of kRungs in Ladder.cpp.
///   Thread   any; constants.
#pragma once

#include "tools/accuracy/TracedMaterial.h"
#include "tools/reference/Reference.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::accuracy {

enum class RungKind : uint8_t { Engine, Reference };

/// The features that a scene must have for an approximation to matter.
enum class Needs : uint8_t { Nothing, Environment, Lights, Coat, Sheen, Refraction, NoRefraction, Solid };

/// The features of a scene.
struct LadderScene {
    bool hasEnvironment = true, hasLights = false;
    MaterialFeatures material{};
};

/// One image of the ladder.
struct Rung {
    RungKind kind = RungKind::Engine;
    // For the engine.
    uint32_t supersampling = 1;     ///< a side; the mean of so many squared samples
    std::vector<std::string> set{}; ///< settings beyond the scene's own
    // For the reference.
    reference::Integrator integrator = reference::Integrator::Path;
    uint32_t maxBounces = 64;
    reference::BsdfModel bsdf{};

    // What the next rung does better than this one. Unused in the last rung.
    std::string_view name{};        ///< "splitSum"
    std::string_view title{};       ///< "Split sum"
    std::string_view approximate{}; ///< what is done here
    std::string_view exact{};       ///< what the next rung does
    Needs needs = Needs::Nothing;   ///< without it, this rung is the next one
};

/// The name of the step that should change nothing.
inline constexpr std::string_view kUnexplained = "unexplained";

/// First the engine's frame, last the path tracer's. Rungs without effect in this scene are omitted.
std::vector<Rung> ladder(LadderScene const& scene);

/// A change of the whole model that no rung contains; shown beside the ladder.
struct Alternative {
    reference::BsdfModel bsdf{};
    std::string_view name{}, title{}, text{};
};
std::span<const Alternative> alternatives();

} // namespace filament_core::accuracy
