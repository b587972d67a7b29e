// SPDX-License-Identifier: Apache-2.0
/// sortItems: SortItems by key, stable.
///   In      items, overwritten.   Out: the sorted items, in the memory of `items` or of the arena.
///   How     radix sort from the lowest digit up (Knuth, The Art of Computer Programming 3, section 5.2.5). Digits
///           cover only bits in which the keys differ at all, wherever those lie: copies of one mesh need a single
///           pass. A few items are cheaper to compare.
///   Thread  large arrays count and move each digit in jobs over ranges. A stable order is unique: the result does not
///           depend on the ranges.
///   Memory  the arena: as much as the items, and 8 KiB a range.
///   Fails   never. Cost: bench/filament_core/prepare, beside std::sort.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/SortKey.h"
#include "jobsystem/JobSystem.h"

#include <span>

namespace filament_core::prepare {

/// Items that one job counts and moves at a time, at least.
inline constexpr size_t kSortRange = 16 * 1024;

/// The items' `renderable` grow, as culling leaves them: that is what stable refers to.
std::span<const SortItem> sortItems(jobs::JobSystem& jobs, Arena& arena, std::span<SortItem> items);

} // namespace filament_core::prepare
