// SPDX-License-Identifier: Apache-2.0
/// SceneDemand: which effects a frame needs, and why. What is visible decides, not what the scene contains: lights
/// that reach no lit surface of the view are neither uploaded nor part of any shader (PrepareView.cpp applies the same
/// counts to each view). The colour pass draws the sky by it. Every effect that is added to the engine gets a line here.
///   In      what preparing the frame has found out.   Out: a plain value.
///   Thread  any; pure.   Memory: none; the words of describe() are on the heap.   Fails: never.
#pragma once

#include "filament_core/prepare/ViewCounts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace filament::prepare {

enum class Effect : uint8_t {
    Sun,       ///< the brightest
    LightList, ///< points, spots and all other suns
    IndirectLight,
    Sky,
    Blending,
    Deformation
};
inline constexpr size_t kEffects = 6;

/// Why an effect is needed (the first group), or not.
enum class DemandReason : uint8_t {
    ReachesLitSurfaces, ///< `count` lights shine on lit surfaces in view; `others` do not
    IsVisible,          ///< `count` draws of it are in view
    FillsBackground,

    NotInScene,
    OutOfView,         ///< none of `others` lights reaches into the view
    NothingLitVisible, ///< there is such light, but no lit surface in view
};

struct EffectDemand {
    bool isNeeded = false;
    DemandReason reason = DemandReason::NotInScene;
    uint32_t count = 0, others = 0; ///< see DemandReason
    friend bool operator==(EffectDemand const&, EffectDemand const&) = default;
};

struct SceneDemand {
    std::array<EffectDemand, kEffects> effects{};

    EffectDemand const& of(Effect effect) const { return effects[static_cast<size_t>(effect)]; }
    bool needs(Effect effect) const { return of(effect).isNeeded; }
    friend bool operator==(SceneDemand const&, SceneDemand const&) = default;
};

/// What findDemand() reads of a frame.
struct DemandInput {
    ViewCounts counts; ///< of the main view
    bool hasIndirectLight = false, hasSky = false;
    uint32_t deformed = 0; ///< objects in view that skins or morph targets move
};

SceneDemand findDemand(DemandInput const& input);

/// "light list". One name in explain(), reports and documents.
const char* nameOf(Effect effect);
/// The reason in words: "3 of 8 reach the view".
std::string describe(Effect effect, EffectDemand const& demand);

} // namespace filament::prepare
