// SPDX-License-Identifier: Apache-2.0
/// ShareEffects: the effects that shares tell apart, in the order of the pipeline.
///   Thread  any; pure.
#pragma once

#include <filament_core/View.h>

#include <span>
#include <string_view>

namespace filament_core::engine {

struct ShareEffect {
    std::string_view name; ///< as its option
    void (*leaveOut)(View& view);
    /// Whether it makes the same of a sum of lights as of each. None: it does.
    bool (*isAdditive)(View const& view) = nullptr;

    bool isIn(View const& view) const;
    bool addsUp(View const& view) const { return !isAdditive || isAdditive(view); }
};

std::span<const ShareEffect> shareEffects();

} // namespace filament_core::engine
