// SPDX-License-Identifier: Apache-2.0
/// PanelText: numbers and names as panels write them.
///   Thread  any; pure functions.   Fails: never.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace filament_core::view {

/// Whether every word of the filter occurs in the text, in any order and any case (of ASCII). An empty filter: yes.
bool matchesFilter(std::string_view text, std::string_view filter);

std::string millisecondsText(double milliseconds); ///< "12.3 ms", "0.012 ms"; "" for 0 and what is not a number
std::string differenceText(double milliseconds);   ///< with its sign: "+1.25 ms"
std::string bytesText(uint64_t bytes);             ///< "512 B", "1.50 MB" of 10^6 B, as Renderer::explain() counts

} // namespace filament_core::view
