// SPDX-License-Identifier: Apache-2.0
/// HeapCounter: counts how often this process allocates with `new`. Linking it replaces the global operators.
///   Thread  any; all threads are counted, including the workers and the driver thread.
///   Does not  see malloc: allocations of C libraries and device drivers are not counted.
///   Cost    one relaxed atomic increment per allocation.
#pragma once

#include <cstdint>

namespace filament_core::tools {

uint64_t heapAllocations();

} // namespace filament_core::tools
