// SPDX-License-Identifier: Apache-2.0
/// AllocationSweep: runs the same scenario repeatedly, first with its first allocation failing, then with its second,
/// and so on until a run has fewer allocations than that. Each run starts from nothing and leaves nothing.
///   In      a Scenario.   Out: test failures, and <build>/faults/NAME.txt: one line per failed allocation, with the
///           function that requested it and the outcome.
#pragma once

#include "tests/faults/FailingAllocator.h"

#include <filament_core/Result.h>

#include <functional>
#include <memory>
#include <string>

namespace filament_core::test {

class Scenario {
public:
    virtual ~Scenario() = default;
    /// While allocations fail: an error is fine if it says what happened.
    virtual Result<void> act() = 0;
    /// Memory is available again: everything works as before, or the device is lost and reports so.
    virtual void expectSound(Result<void> const& outcome) = 0;
};

struct Sweep {
    std::string name;
    Whose whose = Whose::App;
    Lasting lasting = Lasting::Once;
    Callers callers = Callers::All; ///< ThisProgram: blocks are not counted either, as those libraries keep some
    uint64_t stride = 1;            ///< fail every stride-th allocation; with FILAMENT_STRESS all
};

/// Returns how many allocations were failed.
uint64_t sweepAllocations(Sweep const& sweep, std::function<std::unique_ptr<Scenario>()> const& make);

} // namespace filament_core::test
