// SPDX-License-Identifier: Apache-2.0
/// AllocationSweep: the same scenario over and over, the first time with its first allocation failing, then with its
/// second, and so on until one run has fewer allocations than that. Each run starts from nothing and ends in nothing.
///   In      a Scenario.   Out: test failures, and <build>/faults/NAME.txt: a line for each allocation that failed,
///           with the function that asked and what came of it.
#pragma once

#include "tests/faults/FailingAllocator.h"

#include <filament/Result.h>

#include <functional>
#include <memory>
#include <string>

namespace filament::test {

class Scenario {
public:
    virtual ~Scenario() = default;
    /// While allocations fail: an error is fine, as long as it says what happened.
    virtual Result<void> act() = 0;
    /// Memory is back: everything works as if nothing had been, or the device is lost and says so.
    virtual void expectSound(Result<void> const& outcome) = 0;
};

struct Sweep {
    std::string name;
    Whose whose = Whose::App;
    Lasting lasting = Lasting::Once;
    Callers callers = Callers::All; ///< ThisProgram: blocks are not counted either, as those libraries keep some
    uint64_t stride = 1;            ///< every so many allocations; with FILAMENT_STRESS all
};

/// Returns how many allocations were failed.
uint64_t sweepAllocations(Sweep const& sweep, std::function<std::unique_ptr<Scenario>()> const& make);

} // namespace filament::test
