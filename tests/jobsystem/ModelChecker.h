// SPDX-License-Identifier: Apache-2.0
/// ModelChecker: runs a few threads over the job system's lock-free parts in every order and with every stale read that
/// the memory model allows, and reports which run failed and how.
///   In      a Scenario: objects over ModelAtomics (ModelAtomics.h) and the threads that use them: two to four for all
///           runs, up to twenty for random ones.
///   Out     a Report: how many runs, and the first failure with the steps that led to it.
///   Finds   broken require()s, threads that all sleep when the scenario may not rest, data races on Plain values,
///           accesses to an atomic before its construction or after its destruction, endless runs.
///   How     every atomic operation is one step. A depth-first search over the choices "which thread runs next", "which
///           store does it read" and "which thread does the kernel wake" runs the scenario from its start for each leaf
///           (Godefroid 1997, "Model checking for programming languages using VeriSoft"), on coroutines. Sleep sets
///           skip runs that differ from others only in the order of independent steps. With Options::schedules, the
///           choices are random instead (ModelSchedule.h).
///   Memory  that of ModelMemory.h, with its limits.  Cost: about a microsecond per step.
///   Thread  one; the scenario may only depend on its own objects.
#pragma once

#include "tests/jobsystem/ModelMemory.h"
#include "tests/jobsystem/ModelOperation.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace filament_core::jobs::model {

class Scenario {
public:
    virtual ~Scenario() = default;
    virtual int threads() const = 0;
    virtual void run(int thread) = 0;
    /// All threads that have not returned are asleep: may it end like this? Called when nothing changes any more.
    virtual bool mayRest() { return false; }
    /// Called after every successful run.
    virtual void atEnd() {}
};

struct Options {
    std::function<void(Operation&)> mutate; ///< changes operations before they are made; see Mutation
    int preemptions = -1;    ///< at most so many switches away from a runnable thread; -1: any number, with sleep sets
    uint64_t schedules = 0;  ///< so many random runs; 0: all runs
    uint64_t seed = 1;       ///< of random runs
    int spuriousReturns = 0; ///< of the futex, per run
    uint32_t maxSteps = 400; ///< a longer run has failed
    uint64_t maxRuns = 50'000'000; ///< of all kinds; reaching it is a failure
};

struct Report {
    uint64_t runs = 0;   ///< distinct and complete
    uint64_t pruned = 0; ///< abandoned: equal to an earlier one up to the order of independent steps
    uint64_t steps = 0;
    int preemptions = -1;  ///< the bound, if there was one
    bool isRandom = false; ///< not all runs
    std::string failure;   ///< empty if all is well; the rule in the first line, then the steps

    bool ok() const { return failure.empty(); }
};

/// Explores all runs, or Options::schedules random ones, until one fails.
Report explore(std::function<std::unique_ptr<Scenario>()> const& make, Options const& options = {});

/// A rule of the scenario.
void require(bool condition, const char* rule);

/// For loops that poll until another thread has done something. The thread continues after a store that it has not
/// seen, and then sees the last store of everything: stores eventually become visible.
void pause();
/// For loops that poll until another thread has made a step, in random runs: all others come first for a while.
void yield();

/// One line for the log of the tests.
void printExplored(std::string const& what, Report const& report);
/// Sanitizers make a step ten times slower and find nothing in the single exploring thread, so they run with at most
/// two preemptions.
Options boundedIfSanitized(Options options);
/// The environment variable FILAMENT_STRESS: 0 for ordinary tests, otherwise a factor for the amount of work.
uint64_t stressFactor();

// ---------------------------------------------------------------------------------------------- for ModelAtomics.h

struct Outcome {
    uint64_t value = 0; ///< before the operation
    bool succeeded = true;
};

void created(const void* object, uint64_t initial);
void destroyed(const void* object);
Outcome perform(const void* object, Operation operation);

/// Detects races: records the last accesses to a plain value.
class RaceDetector {
public:
    void read();
    void write();

private:
    std::array<uint16_t, kMaxThreads> mReadAt{}, mWrittenAt{};
};

} // namespace filament_core::jobs::model
