// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Contenders.h"

namespace filament_core::bench {

void addRuntimes(Workload& workload, std::span<const RuntimeKind> kinds, Work work,
                 std::function<Contender(RuntimeKind)> const& make) {
    for (const RuntimeKind kind : kinds) {
        if (!isBuilt(kind)) continue;
        if (const char* why = whyLeftOut(kind, work))
            workload.leftOut.push_back({ toString(kind), why });
        else
            workload.contenders.push_back(make(kind));
    }
}

} // namespace filament_core::bench
