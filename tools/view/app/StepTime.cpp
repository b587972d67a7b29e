// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/StepTime.h"

#include <time.h>

namespace filament_core::view {

double threadSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace filament_core::view
