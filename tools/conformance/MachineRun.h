// SPDX-License-Identifier: Apache-2.0
/// drawOnMachines: draws the cases of a run again in child processes, once for each machine of --machines, and compares
/// their pictures with those of this process.
///   In      a finished run: its results, with the reference pictures in OUT/images.
///   Out     a Comparison "machine NAME" in each case; a case fails if its bits are promised there and differ, or if its
///           child died. OUT/machines/NAME has the child's pictures and what it said.
///   Crash   of a child: a fault of the case that it was drawing; another child goes on with the next case.
///   Hang    a child that has not finished a case for MachineLimits::silence is killed: a fault as well.
///   Fails   a machine whose emulator is not installed, a folder that cannot be written. Nothing else ends the run.
///   Thread  the caller's; one child at a time.
///   Cost    as much again as the run without threads and mutants, for each machine; more while Mesa's cache is cold.
#pragma once

#include "tools/conformance/Options.h"
#include "tools/conformance/Results.h"

#include <chrono>

namespace filament::conformance {

struct MachineLimits {
    std::chrono::seconds silence{ 300 };
    std::chrono::seconds emulatedSilence{ 3600 };
};

Result<void> drawOnMachines(Options const& options, Results& results, MachineLimits const& limits = {});

} // namespace filament::conformance
