// SPDX-License-Identifier: Apache-2.0
/// allocationCount(): how often this test program has called operator new, in all its forms.
#pragma once

#include <cstdint>

namespace filament_core::framegraph {

uint64_t allocationCount();

} // namespace filament_core::framegraph
