// SPDX-License-Identifier: Apache-2.0
/// InteriorPage: the results of measureInteriors() as JSON, as tables and as pictures.
///   Out     OUT/interiors.json; for each interior OUT/NAME.png: its first camera with each technique, the traced image
///           last, and OUT/NAME-all.png: all cameras, one below the other.
///   Fails   Unreadable with the path.
///   Thread  one.
#pragma once

#include "tools/accuracy/interiors/InteriorTable.h"

namespace filament_core::accuracy {

Result<void> writeInteriors(InteriorResults const& results, std::filesystem::path const& out);

/// Tables in Markdown, for docs/interiors.md and the terminal.
std::string textOf(InteriorResults const& results);

} // namespace filament_core::accuracy
