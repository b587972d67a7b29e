// SPDX-License-Identifier: Apache-2.0
/// AffinityPolicy: on which cores the workers of a job system may run. A plain value, part of JobSystemOptions.
///   Cores   the operating system's numbers, of the affinity mask of the thread that makes the system.
///   Fails   never: what cannot be had is named in a warning and left out (Affinity.h).
#pragma once

#include <cstdint>
#include <vector>

namespace filament::jobs {

struct AffinityPolicy {
    enum class Kind : uint8_t {
        None,     ///< the operating system moves workers as it likes
        Pin,      ///< every worker stays on one core
        BigCores, ///< workers move among the cores of the most capable class; on a uniform machine these are all
    };

    Kind kind = Kind::None;
    std::vector<int> avoidedCores{}; ///< where no worker runs, whatever the kind

    static AffinityPolicy none() { return {}; }
    static AffinityPolicy pin() { return { Kind::Pin }; }
    static AffinityPolicy bigCores() { return { Kind::BigCores }; }
    /// Everywhere but on `core`: the driver thread's.
    static AffinityPolicy avoid(int core) { return none().avoiding(core); }
    AffinityPolicy avoiding(int core) const;

    bool isNone() const { return kind == Kind::None && avoidedCores.empty(); }
};

} // namespace filament::jobs
