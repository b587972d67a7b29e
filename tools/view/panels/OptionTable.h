// SPDX-License-Identifier: Apache-2.0
/// OptionTable: every option of a View as a row of a panel, in groups, so that a new option appears by itself.
///   Thread   any.   Memory: pointers to the engine's tables.
#pragma once

#include <filament_core/View.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

struct OptionGroup {
    const char* title;
    std::vector<Option const*> options;
};

/// All options of a View, each in one group, in the order of the engine's table.
std::vector<OptionGroup> makeOptionGroups();

/// Whether costs are known for an option: QualityCosts rates those of Quality.
bool isRated(Option const& option);

/// The value of a View that nobody changed.
std::string defaultValue(Option const& option);

/// Numbers of "1,0.5,2"; empty if they are not as many as the option has.
std::vector<float> optionNumbers(Option const& option, std::string_view value);
std::string optionText(Option const& option, std::span<const float> numbers);

} // namespace filament_core::view
