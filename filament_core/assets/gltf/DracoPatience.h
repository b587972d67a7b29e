// SPDX-License-Identifier: Apache-2.0
/// DracoPatience: how long the Draco streams of one file may take (Draco.h). Thread: shared by the jobs that decode
/// them.
#pragma once

#include <atomic>

namespace filament_core::assets {

struct DracoPatience {
    double seconds = 2;             ///< of the processor, for a stream
    double secondsPerVertex = 2e-5; ///< besides; sound streams take a hundredth of that
    std::atomic<bool> isLost{ false };
};

} // namespace filament_core::assets
