// SPDX-License-Identifier: Apache-2.0
/// FailingAllocator: this test program's operator new, which can be told to fail.
///   In      whose allocation, and which one: an AllocationFailure, for as long as it lives.
///   Out     whether it struck and for which function; how many blocks live.
///   Thread  one AllocationFailure at a time. "The app thread" is the one that makes it.
///   Limits  what calls malloc() itself (C libraries, drivers) does not fail.
///   Cost    an atomic load and two counters an allocation.
#pragma once

#include <cstdint>
#include <string>

namespace filament::test {

enum class Whose : uint8_t {
    App,    ///< the thread that asks for the failure
    Driver, ///< a driver thread
    Jobs,   ///< any thread, inside of a job
};
const char* toString(Whose whose);

enum class Callers : uint8_t {
    All,
    ThisProgram, ///< not the libraries of a device, who have their own ways with exhausted memory
};

enum class Lasting : uint8_t {
    Once,    ///< this allocation fails, the next one succeeds
    Onwards, ///< this one and all that follow
};

class AllocationFailure {
public:
    /// The `at`-th allocation of that thread from now on throws std::bad_alloc; from 1.
    AllocationFailure(Whose whose, uint64_t at, Lasting lasting = Lasting::Once, Callers callers = Callers::All);
    ~AllocationFailure();
    AllocationFailure(AllocationFailure const&) = delete;
    AllocationFailure& operator=(AllocationFailure const&) = delete;

    /// Ends it, and tells whether an allocation failed.
    bool stop();
    /// Of the failure that struck last: the innermost functions of the engine on the stack of its first allocation.
    static std::string lastSite();
};

/// Blocks that operator new gave and operator delete has not taken back, of all threads.
int64_t liveBlocks();

} // namespace filament::test
