// SPDX-License-Identifier: Apache-2.0
/// suggestion: "; did you mean 'roughness'?" for a misspelt name, empty when nothing is near.
///   Nearness is the Levenshtein distance, ignoring case: at most a third of the name's length, at least 2.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace filament {

std::string suggestion(std::string_view name, std::span<const std::string_view> known);

} // namespace filament
