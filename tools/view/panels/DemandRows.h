// SPDX-License-Identifier: Apache-2.0
/// DemandRows: Renderer::decisions() as the table that a panel shows.
///   Thread  any; values.
#pragma once

#include <filament_core/Renderer.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace filament_core::view {

inline bool isPass(EffectDecision const& decision) { return decision.state >= EffectDecision::State::Ran; }
inline bool isActive(EffectDecision const& decision) {
    return decision.state == EffectDecision::State::Needed || decision.state == EffectDecision::State::Ran;
}

struct DemandFilter {
    std::string_view words{}; ///< of name and reason
    bool onlyActive = false;  ///< what is needed, and passes that run
    bool onlyPasses = false;
};

/// Those that the filter shows, in their order. Refer to `decisions`.
std::vector<EffectDecision const*> demandRows(std::vector<EffectDecision> const& decisions, DemandFilter const& filter);

struct DemandTotals {
    uint32_t needed = 0, effects = 0, ran = 0, passes = 0;
    double milliseconds = 0;
    uint64_t attachmentBytes = 0; ///< passes that draw to the same image count it each
};
DemandTotals totalsOf(std::vector<EffectDecision> const& decisions);

} // namespace filament_core::view
