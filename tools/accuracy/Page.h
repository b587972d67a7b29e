// SPDX-License-Identifier: Apache-2.0
/// Page: the report as an HTML file, which tools/plot/plot.py makes from data: figures, tables, the command beside
/// every number. The same data give the same page without a measurement: plot.py accuracy-page docs/accuracy -o
/// docs/accuracy.html
///   Out     OUT/results.json, OUT/results.csv, OUT/plots/NAME.svg; the page; in the folder of its name results.json,
///           the fragments, and their images (PagePictures.h).
///   Fails   Unreadable with the path, also if plot.py cannot make the page. Without its plots it is a warning.
///   Thread  one.
#pragma once

#include "tools/accuracy/Results.h"

#include <filesystem>
#include <vector>

namespace filament_core::accuracy {

struct ReportPlaces {
    std::filesystem::path out, page;
    std::vector<std::filesystem::path> include; ///< fragments with further sections; OUT/*.fragment.html too
    bool plots = true;
};

Result<void> writeReport(Results const& results, ReportPlaces const& places);
/// Of the JSON of results (Results.h).
Result<void> writeReport(tools::Json const& data, ReportPlaces const& places);

} // namespace filament_core::accuracy
