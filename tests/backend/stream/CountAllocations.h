// SPDX-License-Identifier: Apache-2.0
/// Replaces the global operator new of this test program by a counting one.
#pragma once

#include <cstdint>

namespace filament_core {

/// Heap allocations of the whole process so far, all threads.
uint64_t allocationCount();

} // namespace filament_core
