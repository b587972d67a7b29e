// SPDX-License-Identifier: Apache-2.0
/// ComparisonPage: the results of comparePictures() as a section of the accuracy report and as JSON.
///   Out     OUT/comparison.json, OUT/comparison/ROW-*.png, OUT/comparison.fragment.html, which the report includes
///           together with the images.
///   Fails   Unreadable with the path.
///   Thread  one.
#pragma once

#include "toolkit/json/JsonReader.h"
#include "tools/accuracy/comparison/Comparison.h"

namespace filament_core::accuracy {

tools::Json jsonOf(ComparisonResults const& results);

Result<void> writeComparison(ComparisonResults const& results, std::filesystem::path const& out);

/// Text for a terminal: one line per row, followed by its steps.
std::string textOf(ComparisonResults const& results);

} // namespace filament_core::accuracy
