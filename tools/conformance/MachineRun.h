// SPDX-License-Identifier: Apache-2.0
/// drawOnMachines: draws the cases of a run again in child processes, once for each machine of --machines, and compares
/// their images with those of this process.
///   In      a finished run: its results, with the reference images in OUT/images.
///   Out     a Comparison "machine NAME" in each case. A case fails if the machine promises the same bits and they
///           differ, or if its child crashed. OUT/machines/NAME has the child's images and output.
///   Crash   if a child crashes, the case that it was drawing fails; another child continues with the next case.
///   Hang    a child that does not finish a case within MachineLimits::silence is killed; the case fails, too.
///   Fails   a machine whose emulator is not installed, a folder that cannot be written. Nothing else ends the run.
///   Thread  the caller's; one child at a time.
///   Cost    for each machine the time of the run again, without threads and mutants; more while Mesa's cache is cold.
#pragma once

#include "tools/conformance/Options.h"
#include "tools/conformance/Results.h"

#include <chrono>

namespace filament_core::conformance {

struct MachineLimits {
    std::chrono::seconds silence{ 300 };
    std::chrono::seconds emulatedSilence{ 3600 };
};

Result<void> drawOnMachines(Options const& options, Results& results, MachineLimits const& limits = {});

} // namespace filament_core::conformance
