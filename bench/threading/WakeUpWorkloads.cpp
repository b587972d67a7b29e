// SPDX-License-Identifier: Apache-2.0
// The time until a sleeping worker starts a job, after the app thread has computed alone for a while.
#include "bench/threading/Clock.h"
#include "bench/threading/FutexSleeper.h"
#include "bench/threading/Placement.h"
#include "bench/threading/Workloads.h"

#include <fmt/format.h>

#include <array>
#include <optional>

namespace filament_core::bench {
namespace {

struct WakeUp {
    const char* name;
    const char* title;
    int64_t idleNs;
    bool pinned;
};

/// The cost of the operating system alone: a thread that sleeps on a futex, without any runtime.
Contender futexContender(WakeUp const& what, int wakeUps) {
    return { "futex",
             [=](std::vector<double>& figures) {
                 const std::optional<PinnedScope> pin =
                         what.pinned ? std::optional<PinnedScope>(std::in_place, coreOfThread(0)) : std::nullopt;
                 FutexSleeper sleeper(what.pinned);
                 sleeper.wakeUp(1'000'000); // now the thread exists
                 for (int i = 0; i < wakeUps; ++i)
                     figures.push_back(static_cast<double>(sleeper.wakeUp(what.idleNs)) * 1e-3);
             },
             "no runtime" };
}

Result<Workload> wakeUp(Settings const& settings, WakeUp const& what) {
    if (settings.threads < 2)
        return fail(ErrorCode::Unsupported, "{}: nobody to wake; run with --workers 1 or more", what.name);
    Workload workload{
        .name = what.name, .title = what.title, .unit = "us", .kind = "wakeup", .contenders = {}, .targets = {}
    };
    if (what.pinned) workload.targets = { { .limit = 50 }, { .figure = Figure::P99, .limit = 200 } };
    workload.targets.push_back({ .figure = Figure::Ratio, .other = "futex", .limit = 1.5 });
    const int wakeUps = settings.quick ? 2 : 20; // per round
    using enum RuntimeKind;
    const std::array kinds{ Ours, OneTbb, OpenMp, Eigen, Asio, StdAsync };
    addRuntimes(workload, kinds, Work::WakeUp, [&](RuntimeKind kind) -> Contender {
        std::shared_ptr<Runtime> runtime = makeRuntime(kind, { .threads = settings.threads, .pinned = what.pinned });
        return { toString(kind), [=](std::vector<double>& figures) {
                    runtime->enter();
                    runtime->emptyJobs(8, 1); // now the threads exist
                    for (int i = 0; i < wakeUps; ++i)
                        if (const auto latency = runtime->wakeUp(what.idleNs))
                            figures.push_back(static_cast<double>(*latency) * 1e-3);
                    settle();
                    runtime->leave();
                } };
    });
    workload.contenders.push_back(futexContender(what, wakeUps));
    return workload;
}

} // namespace

void addWakeUpWorkloads(WorkloadList& list, Settings const& settings) {
    for (WakeUp const& what : {
                 WakeUp{ "wake_150us_pinned", "wake-up after 150 us, pinned", 150'000, true },
                 WakeUp{ "wake_150us", "wake-up after 150 us, unpinned", 150'000, false },
                 WakeUp{ "wake_3ms_pinned", "wake-up after 3 ms, pinned", 3'000'000, true },
                 WakeUp{ "wake_3ms", "wake-up after 3 ms, unpinned", 3'000'000, false },
         })
        list.push_back({ what.name, [=] { return wakeUp(settings, what); } });
}

} // namespace filament_core::bench
