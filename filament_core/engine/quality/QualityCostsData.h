// SPDX-License-Identifier: Apache-2.0
/// The cost table included in the library: quality_costs.json beside this file, embedded by the build.
#pragma once

#include <string_view>

namespace filament_core::engine {

std::string_view defaultQualityCostsJson();

} // namespace filament_core::engine
