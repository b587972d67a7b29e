// SPDX-License-Identifier: Apache-2.0
/// EffectTable: one row per effect. findDemand(), explain() and the description of a frame walk these rows; an effect
/// that is added to the engine gets an enumerator in SceneDemand.h and a row here.
///   Thread  any; constant data.   Memory: none.   Fails: never.
#pragma once

#include "filament_core/prepare/SceneDemand.h"

namespace filament_core::prepare {

enum class EffectStage : uint8_t {
    Lighting,    ///< of surfaces and of the sky; none where a debug view lights nothing
    Geometry,    ///< how surfaces are drawn, lit or not
    PostProcess, ///< of the image
};

/// Finds the demand for one effect, from what the frame has or from the demand for the other effects as well.
struct DemandFunction {
    constexpr DemandFunction(EffectDemand (*function)(DemandInput const&)) : alone(function) {}
    constexpr DemandFunction(EffectDemand (*function)(DemandInput const&, SceneDemand const&)) : byOthers(function) {}

    EffectDemand (*alone)(DemandInput const&) = nullptr;
    EffectDemand (*byOthers)(DemandInput const&, SceneDemand const&) = nullptr; ///< called last
};

enum EffectFlags : uint8_t {
    kReadsDepth = 1,   ///< that of the prepass
    kChangesColor = 2, ///< makes another image of what the colour pass has drawn
};

struct EffectRow {
    Effect effect;
    const char* name; ///< in explain(), reports and documents
    EffectStage stage;
    DemandFunction demand;
    const char* setting = "";     ///< which switches it off, as --set says it
    uint8_t flags = 0;            ///< EffectFlags
    const char* unrequested = ""; ///< DemandReason::Unrequested in words

    constexpr bool has(EffectFlags flag) const { return (flags & flag) != 0; }
};

extern const std::array<EffectRow, kEffects> kEffectTable;

inline EffectRow const& rowOf(Effect effect) { return kEffectTable[static_cast<size_t>(effect)]; }

} // namespace filament_core::prepare
