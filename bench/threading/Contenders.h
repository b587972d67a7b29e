// SPDX-License-Identifier: Apache-2.0
/// Contenders: the runtimes as contenders of a workload.
///   Thread  main thread.
///   Fails   never; a runtime that cannot take part is left out.
#pragma once

#include "bench/threading/Runtime.h"
#include "bench/threading/Workload.h"

#include <functional>
#include <span>

namespace filament_core::bench {

/// Adds each of these runtimes that isBuilt(): what `make` returns, or the reason why its library cannot express the
/// work.
void addRuntimes(Workload& workload, std::span<const RuntimeKind> kinds, Work work,
                 std::function<Contender(RuntimeKind)> const& make);

} // namespace filament_core::bench
