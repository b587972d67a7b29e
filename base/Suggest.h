// SPDX-License-Identifier: Apache-2.0
/// suggestion: "; did you mean 'roughness'?" for a misspelt name; empty if no known name is near.
///   Nearness is the Levenshtein distance, ignoring case: at most a third of the name's length, or 2 if that is more.
#pragma once

#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core {

std::string suggestion(std::string_view name, std::span<const std::string_view> known);

/// The names of the items, for suggestion(). Views into the items.
template <std::ranges::range Items>
std::vector<std::string_view> namesOf(Items const& items) {
    std::vector<std::string_view> names;
    for (auto const& item : items) names.push_back(item.name);
    return names;
}

} // namespace filament_core
