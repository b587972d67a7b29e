// SPDX-License-Identifier: Apache-2.0
/// kNone: the index of nothing, where a file leaves an optional index out.
#pragma once

#include <cstdint>

namespace filament_core::assets {

inline constexpr uint32_t kNone = ~0u;

} // namespace filament_core::assets
