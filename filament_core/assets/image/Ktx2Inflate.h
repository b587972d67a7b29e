// SPDX-License-Identifier: Apache-2.0
/// checkLevel, inflatedLevel: the bytes of a level without Zstandard or zlib. `expected` is how many they are, which
/// the caller knows from the size of the level.
///   Memory  `expected` bytes in `buffer`; none for plain levels.
///   Fails   Corrupt with file and level, unless it is exactly as long.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/Ktx2File.h"

#include <span>
#include <string_view>
#include <vector>

namespace filament_core::assets {

/// What can be told before memory is allocated.
Result<void> checkLevel(Ktx2File const& file, uint32_t level, uint64_t expected, std::string_view name);

/// checkLevel() has passed.
Result<std::span<const std::byte>> inflatedLevel(Ktx2File const& file, uint32_t level, uint64_t expected,
                                                 std::string_view name, std::vector<std::byte>& buffer);

} // namespace filament_core::assets
