// SPDX-License-Identifier: Apache-2.0
/// The cost table that the library brings along, quality_costs.json beside this file, as the build put it in.
#pragma once

#include <string_view>

namespace filament::engine {

std::string_view defaultQualityCostsJson();

} // namespace filament::engine
