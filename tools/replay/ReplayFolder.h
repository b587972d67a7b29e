// SPDX-License-Identifier: Apache-2.0
/// replayFolder: what filament-replay does with a saved frame.
///   In      checked options.   Out: text for the terminal, and whether all bits are those that were recorded.
///   Thread  one; the drivers live on it.
///   Fails   in one line: the folder, its files, the device, a pass or draw that is not there.
#pragma once

#include "toolkit/record/SavedFrame.h"
#include "tools/replay/Options.h"

#include <map>

namespace filament_core::replay {

struct Report {
    std::string text; ///< lines
    bool isEqual = true;
};

/// Edits of the streams of an API on their way to the device: for tests, which look for the defect.
using Edits = std::map<Backend, record::EditMaker>;

Result<Report> replayFolder(Options const& options, Edits const& edits = {});

} // namespace filament_core::replay
