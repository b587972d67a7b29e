// SPDX-License-Identifier: Apache-2.0
/// ModelChecker: runs a few threads over the job system's lock-free parts in every order and with every stale read that
/// the memory model allows, and says what went wrong in which run.
///   In      a Scenario: objects over ModelAtomics (ModelAtomics.h) and two to four threads that use them.
///   Out     a Report: how many runs, and the first failure with the steps that led to it.
///   Finds   broken require()s, threads that all sleep though the scenario may not rest, data races on Plain values,
///           accesses to an atomic before its construction or after its destruction, runs without an end.
///   How     every atomic operation is one step. A depth-first search over the choices "who goes next", "which store
///           does it read", "whom does the kernel wake" runs the scenario from its start for each leaf (Godefroid 1997,
///           "Model checking for programming languages using VeriSoft"), on coroutines. Sleep sets leave out runs that
///           differ from others in the order of independent steps only.
///   Memory  that of ModelMemory.h, with its limits.  Cost: about a microsecond a step.
///   Thread  one; the scenario must not depend on anything but its own objects.
#pragma once

#include "tests/jobsystem/ModelMemory.h"
#include "tests/jobsystem/ModelOperation.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace filament::jobs::model {

class Scenario {
public:
    virtual ~Scenario() = default;
    virtual int threads() const = 0;
    virtual void run(int thread) = 0;
    /// All threads that have not returned sleep: is that how it should end? Looks at what no thread changes any more.
    virtual bool mayRest() { return false; }
    /// After every run that ended well.
    virtual void atEnd() {}
};

struct Options {
    std::function<void(Operation&)> mutate; ///< changes operations before they are made; see Mutation
    int preemptions = -1;    ///< at most so many switches away from a thread that could go on; -1: any, with sleep sets
    int spuriousReturns = 0; ///< of the futex, a run
    uint32_t maxSteps = 400; ///< a run that is longer has failed
    uint64_t maxRuns = 50'000'000; ///< of all kinds; reaching it is a failure
};

struct Report {
    uint64_t runs = 0;   ///< different to the end
    uint64_t pruned = 0; ///< given up: equal to an earlier one up to the order of independent steps
    uint64_t steps = 0;
    int preemptions = -1; ///< the bound, if there was one
    std::string failure;  ///< empty if all is well; the rule in the first line, then the steps

    bool ok() const { return failure.empty(); }
};

/// Explores all runs until one fails.
Report explore(std::function<std::unique_ptr<Scenario>()> const& make, Options const& options = {});

/// A rule of the scenario.
void require(bool condition, const char* rule);

/// For loops that look until another thread has done something. The thread goes on when a store was made that it has
/// not seen, and then it sees the last store of everything: stores become visible in the end.
void pause();

/// One line for the log of the tests.
void printExplored(std::string const& what, Report const& report);
/// Sanitizers make a step ten times as slow and find nothing in the one thread that explores: there with at most two
/// preemptions.
Options boundedIfSanitized(Options options);
/// The environment's FILAMENT_STRESS: 0 for the tests of every day, else how much more to do.
uint64_t stressFactor();

// ---------------------------------------------------------------------------------------------- for ModelAtomics.h

struct Outcome {
    uint64_t value = 0; ///< before the operation
    bool succeeded = true;
};

void created(const void* object, uint64_t initial);
void destroyed(const void* object);
Outcome perform(const void* object, Operation operation);

/// Who touched a plain value last, to tell races.
class RaceDetector {
public:
    void read();
    void write();

private:
    std::array<uint16_t, kMaxThreads> mReadAt{}, mWrittenAt{};
};

} // namespace filament::jobs::model
