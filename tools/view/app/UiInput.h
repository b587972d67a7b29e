// SPDX-License-Identifier: Apache-2.0
/// UiInput: passes InputEvents to Dear ImGui's current context.
///   Out     true: the interface wants the event for itself: the pointer is over a panel, or a text is being edited.
///   Thread  that of the context.
#pragma once

#include "tools/view/app/InputEvent.h"

namespace filament::view {

/// Once for each context: which keys edit texts and walk through widgets.
void prepareUiInput();
bool passToUi(InputEvent const& event);

} // namespace filament::view
