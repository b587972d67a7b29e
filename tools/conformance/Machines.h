// SPDX-License-Identifier: Apache-2.0
/// Machines: other processors that this one can simulate: an environment that makes Mesa's JIT compiler or the C
/// library assume another processor, or an emulator. Child processes draw the cases there again (MachineRun.h).
///   Table   the only place that lists where the same bits are promised, and why; docs/conformance.md repeats it.
///   Thread  any; constants.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core::conformance {

struct SimulatedMachine {
    std::string_view name;
    std::pair<std::string_view, std::string_view> variable; ///< name and value; empty: none
    std::string_view emulated;                              ///< a processor of qemu-x86_64; empty: none
    bool sameBits = true;                                   ///< promised
    std::string_view what;                                  ///< what is different there

    bool isEmulated() const { return !emulated.empty(); }
    /// The command that runs the program there; empty: none is needed.
    std::vector<std::string> launcher() const;
};

std::span<const SimulatedMachine> simulatedMachines();
SimulatedMachine const* findMachine(std::string_view name);

/// "all" for --machines: all except the emulated ones, which take a minute for a second's work.
std::vector<std::string> quickMachines();

} // namespace filament_core::conformance
