// SPDX-License-Identifier: Apache-2.0
/// Page: the report as an HTML file: plots, tables, the command beside every number.
///   Out     OUT/results.json, OUT/results.csv, OUT/plots/NAME.svg, the page, and its pictures in a folder of its name
///           (PagePictures.h).
///   Plots   by tools/plot/plot.py; where it cannot run, a warning says why and the page has its tables only.
///   Fails   Unreadable with the path.
///   Thread  one.
#pragma once

#include "tools/accuracy/Results.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace filament::accuracy {

struct ReportPlaces {
    std::filesystem::path out, page;
    std::vector<std::filesystem::path> include; ///< fragments with further sections; OUT/*.fragment.html too
    bool plots = true;
};

/// `plots`: where the page finds the plot of each effect, and of "frames".
std::string htmlOf(Results const& results, std::map<std::string, std::string> const& plots,
                   std::vector<std::string> const& sections);

Result<void> writeReport(Results const& results, ReportPlaces const& places);

} // namespace filament::accuracy
