// SPDX-License-Identifier: Apache-2.0
/// Report: results for programs (JUnit XML) and for people (one self-contained HTML file).
///   In      results, and the folder that contains their images.
///   Out     OUT/junit.xml, OUT/report.html: images, differences, both images in turn, the first differing pixel.
///   Fails   Unreadable with the path. A missing image is left out.
///   Thread  any.
#pragma once

#include "tools/conformance/Results.h"

namespace filament_core::conformance {

std::string junitOf(Results const& results);
std::string htmlOf(Results const& results, std::filesystem::path const& folder);

/// Removes the images of cases that passed from `results` and from the folder of the results: a million cases would
/// have 20 GB of them.
void dropPassedPictures(std::filesystem::path const& folder, Results& results);

/// results.json, times.json, junit.xml and report.html.
Result<void> writeReport(std::filesystem::path const& folder, Results const& results);

/// For the terminal: a line for each simulated machine; empty without.
std::string machineLines(Results const& results);
/// For the terminal: counts, kill rate, time.
std::string summaryLine(Results const& results);

} // namespace filament_core::conformance
