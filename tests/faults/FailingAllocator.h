// SPDX-License-Identifier: Apache-2.0
/// FailingAllocator: the test program's operator new, which can be made to fail.
///   In      an AllocationFailure, for its lifetime: whose allocation fails, and which one.
///   Out     whether it occurred and in which function; the number of live blocks and their bytes.
///   Thread  one AllocationFailure at a time. "The app thread" is the one that makes it.
///   Limits  direct calls of malloc() (C libraries, drivers) do not fail.
///   Cost    an atomic load and two counters per allocation.
#pragma once

#include <cstdint>
#include <string>

namespace filament_core::test {

enum class Whose : uint8_t {
    App,    ///< the thread that requests the failure
    Driver, ///< a driver thread
    Jobs,   ///< any thread, inside of a job
};
const char* toString(Whose whose);

enum class Callers : uint8_t {
    All,
    ThisProgram, ///< not the libraries of a device, which handle exhausted memory in their own ways
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

    /// Ends it, and returns whether an allocation failed.
    bool stop();
    /// For the last failure: the innermost functions of the engine on the stack of the first failed allocation.
    static std::string lastSite();
};

/// Blocks from operator new that have not been deleted, over all threads, and what the heap gave for them.
int64_t liveBlocks();
int64_t liveBytes();

} // namespace filament_core::test
