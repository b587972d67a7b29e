// SPDX-License-Identifier: Apache-2.0
/// ViewsOfFrames: what a frame is made of a View: its input, the view that is drawn for it, and whether it fits its
/// target.
///   Thread  any; pure.   Memory: none.
///   Fails   the checks assert: a view that does not fit its target is a bug of the caller.
#pragma once

#include "filament_core/prepare/DebugViews.h"
#include "filament_core/prepare/ViewInput.h"

#include <filament_core/View.h>

namespace filament_core::engine {

/// As if all of the view's pixels were drawn, and no others. `effects`: of the view, clamped.
prepare::ViewInput wholeInputOf(View const& view, Effects effects, uint64_t contents);

/// `target`: pixels.
void checkPlace(View const& view, uint2 target);
void checkNumbers(View const& view, Format target);

inline bool joinsLastImage(View const& view) {
    return view.viewport && view.viewport->contents == TargetContents::Keep;
}

/// Calls `use(View)` with what is drawn: numbers are drawn by the debug view that shows them.
template <class Use>
auto withDebugViewOf(View const& view, Use&& use) {
    if (view.aov == Aov::None) return use(view);
    View shown = view;
    shown.debugView = prepare::debugViewOf(view.aov);
    return use(shown);
}

} // namespace filament_core::engine
