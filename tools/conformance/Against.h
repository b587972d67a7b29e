// SPDX-License-Identifier: Apache-2.0
/// Against: this run beside the report of another machine, driver or release: which cases have other bits, in which
/// pixels, and in which pass that began.
///   In      results with their folder; the folder of the other report. Pictures are compared where both have them
///           (--pictures all), as 8 bits a channel; whether a case differs is decided by the hashes of all bits.
///   Out     a comparison in each case that both reports have. One that differs fails, with the other image and the
///           difference in FOLDER/images.
///   Fails   as readResults(). An image that cannot be read or written is named in the comparison.
///   Thread  any.
#pragma once

#include "tools/conformance/Results.h"

namespace filament_core::conformance {

Result<void> compareWithReport(std::filesystem::path const& folder, Results& results,
                               std::filesystem::path const& other);

/// The name of the comparison with the report in that folder.
std::string againstConfiguration(std::filesystem::path const& other);

/// For the terminal: how many cases have the same bits, which ones only one report has.
std::string againstLine(Results const& results, std::filesystem::path const& other);

} // namespace filament_core::conformance
