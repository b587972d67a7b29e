// SPDX-License-Identifier: Apache-2.0
/// runViewer(): opens the window of a command line, and shows frames until it is closed, or until there were enough.
///   Out     the exit status. The time from the start of the process's work to the first frame in the window is
///           printed.
///   Thread  the main thread.
#pragma once

#include "tools/view/app/ViewerOptions.h"

namespace filament_core::view {

int runViewer(ViewerOptions const& options);

} // namespace filament_core::view
