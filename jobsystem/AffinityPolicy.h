// SPDX-License-Identifier: Apache-2.0
/// AffinityPolicy: the cores on which the workers of a job system may run. A plain value, part of JobSystemOptions.
///   Cores   the operating system's numbers, within the affinity mask of the thread that creates the system.
///   Fails   never: a request that cannot be met is named in a warning and ignored (Affinity.h).
#pragma once

#include <cstdint>
#include <vector>

namespace filament_core::jobs {

struct AffinityPolicy {
    enum class Kind : uint8_t {
        None,     ///< the operating system moves workers freely
        Pin,      ///< every worker stays on one core
        BigCores, ///< workers move among the cores of the most capable class; on a uniform machine all cores
    };

    Kind kind = Kind::None;
    std::vector<int> avoidedCores{}; ///< no worker runs there, whatever the kind
    /// Workers place themselves again each time they wake up, because a system that moves processes between groups of
    /// cores (Android's cpusets) undoes their pinning. One system call per wake-up.
    bool repinsAfterWaits = false;

    static AffinityPolicy none() { return {}; }
    static AffinityPolicy pin() { return { Kind::Pin }; }
    static AffinityPolicy bigCores() { return { Kind::BigCores }; }
    /// Everywhere except on `core`, which is the driver thread's.
    static AffinityPolicy avoid(int core) { return none().avoiding(core); }
    AffinityPolicy avoiding(int core) const;

    bool isNone() const { return kind == Kind::None && avoidedCores.empty(); }
};

} // namespace filament_core::jobs
