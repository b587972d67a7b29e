// SPDX-License-Identifier: Apache-2.0
/// HeapCounter: how often this process asked for memory with `new`. Linking it replaces the global operators.
///   Thread  any; every thread is counted, the workers and the driver thread as well.
///   Does not  see malloc: what C libraries and device drivers take is theirs.
///   Cost    one relaxed atomic increment an allocation.
#pragma once

#include <cstdint>

namespace filament::tools {

uint64_t heapAllocations();

} // namespace filament::tools
