// SPDX-License-Identifier: Apache-2.0
/// Runtime: the same workloads on one threading library. One file each: OursRuntime.cpp, OneTbbRuntime.cpp,
/// OpenMpRuntime.cpp, EigenRuntime.cpp, AsioRuntime.cpp, StdAsyncRuntime.cpp, SerialRuntime.cpp; read them side by
/// side.
///   Use     enter(), then any of the workloads any number of times, then leave(); the caller measures time.
///   Thread  one thread, the same for all calls. `threads` includes it.
///   Rule    each is written as its users would write it: the calling thread takes part, groups are reused if the
///           library allows it, and nothing is tuned to the machine.
///   Limits  Eigen and Boost.Asio are optional when the program is built. whyLeftOut() says what a library cannot
///           express.
///   Fails   makeRuntime() never, for a runtime that isBuilt().
#pragma once

#include "bench/threading/SpinWork.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace filament_core::bench {

enum class RuntimeKind : uint8_t { Ours, OneTbb, OpenMp, Eigen, Asio, StdAsync, Serial };
inline constexpr RuntimeKind kAllRuntimes[] = { RuntimeKind::Ours,  RuntimeKind::OneTbb, RuntimeKind::OpenMp,
                                                RuntimeKind::Eigen, RuntimeKind::Asio,   RuntimeKind::StdAsync,
                                                RuntimeKind::Serial };
const char* toString(RuntimeKind kind); ///< "ours", "tbb", "openmp", "eigen", "asio", "async", "serial"

/// False for a library that was not found when the program was configured.
bool isBuilt(RuntimeKind kind);
/// "eigen (libeigen3-dev)": the runtimes that are not built, and the packages that they need. Empty if there are none.
std::string absentRuntimes();

/// A function of Runtime, spinJobs() included in Jobs.
enum class Work : uint8_t { Jobs, Tree, Loop, Chain, Graph, Relay, WakeUp };
/// Why the library of a runtime cannot express the work; nullptr if it can.
const char* whyLeftOut(RuntimeKind kind, Work work);

struct RuntimeOptions {
    unsigned threads = 1; ///< that work, including the caller
    bool pinned = false;  ///< thread i stays on coreOfThread(i) between enter() and leave()
};

class Runtime {
public:
    virtual ~Runtime() = default;

    virtual void enter() = 0;
    virtual void leave() = 0;

    /// Starts `count` jobs that do nothing and waits for them, `repeats` times.
    virtual void emptyJobs(uint32_t count, uint64_t repeats) = 0;
    /// A binary tree of calls: every inner node forks its left half, calls its right one and joins. Returns the leaves.
    virtual uint32_t tree(uint32_t depth) = 0;
    /// `count` items in one parallel loop, `repeats` times.
    virtual void loop(SpinWork const& work, uint64_t count, uint64_t repeats) = 0;
    /// `links` empty jobs, each the continuation of the previous one, which returns it when it ends (if the runtime
    /// supports this; otherwise as graph()); `repeats` times.
    virtual void chain(uint32_t links, uint64_t repeats) = 0;
    /// The same, but the order is declared in advance.
    virtual void graph(uint32_t links, uint64_t repeats) = 0;
    /// The same, but each job starts its successor itself, like any other job.
    virtual void relay(uint32_t links, uint64_t repeats) = 0;
    /// One job per entry, which spins that many steps, in this order.
    virtual void spinJobs(std::span<const uint32_t> steps) = 0;
    /// After `idle` nanoseconds without work: nanoseconds from "start a job" until another thread runs it.
    virtual std::optional<int64_t> wakeUp(int64_t idle) = 0;

    /// More jobs at once would take too long or too much memory; workloads scale down to this number and report it.
    virtual uint32_t affordableJobs() const { return std::numeric_limits<uint32_t>::max(); }
    /// The same for the leaves of a tree.
    virtual uint32_t affordableLeaves() const { return affordableJobs(); }
};

std::unique_ptr<Runtime> makeRuntime(RuntimeKind kind, RuntimeOptions const& options);

std::unique_ptr<Runtime> makeOursRuntime(RuntimeOptions const& options);
std::unique_ptr<Runtime> makeOneTbbRuntime(RuntimeOptions const& options);
std::unique_ptr<Runtime> makeOpenMpRuntime(RuntimeOptions const& options);
std::unique_ptr<Runtime> makeEigenRuntime(RuntimeOptions const& options); ///< if it isBuilt()
std::unique_ptr<Runtime> makeAsioRuntime(RuntimeOptions const& options);  ///< if it isBuilt()
std::unique_ptr<Runtime> makeStdAsyncRuntime(RuntimeOptions const& options);
std::unique_ptr<Runtime> makeSerialRuntime();

} // namespace filament_core::bench
