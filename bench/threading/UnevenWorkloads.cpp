// SPDX-License-Identifier: Apache-2.0
// Work that does not divide evenly: jobs of power-law sizes, and a core that is shared with another process.
// "ideal" and "fair" are not runtimes: they are computed from the serial time of the same round.
#include "bench/threading/Placement.h"
#include "bench/threading/Workloads.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

namespace filament_core::bench {
namespace {

// ---------------------------------------------------------------------------------------------------- power law

/// The jobs of the round: new ones each round, the same for all contenders.
struct PowerLaw {
    double stepsPerNs = stepsFor(1);
    uint32_t count = 0;
    uint32_t seed = 0;
    std::vector<uint32_t> steps;
    double serialNs = 0;

    /// Pareto with exponent 1.3 from 1 us on (inverse transform of the uniform), cut off at 500 us: the largest 1 % of
    /// the jobs contain a fifth of the work.
    void draw() {
        constexpr double kSmallestNs = 1e3, kLargestNs = 500e3, kExponent = 1.3;
        std::mt19937 random(++seed);
        std::uniform_real_distribution<double> uniform(1e-9, 1.0);
        steps.resize(count);
        for (uint32_t& job : steps) {
            const double ns = std::min(kSmallestNs * std::pow(uniform(random), -1 / kExponent), kLargestNs);
            job = static_cast<uint32_t>(ns * stepsPerNs);
        }
    }

    double total(size_t jobs) const {
        return std::accumulate(steps.begin(), steps.begin() + static_cast<ptrdiff_t>(jobs), 0.0);
    }

    double idealNs(unsigned threads) const {
        const double largest = *std::max_element(steps.begin(), steps.end());
        return std::max(serialNs / threads, serialNs * largest / total(steps.size()));
    }
};

Workload powerLaw(Settings const& settings) {
    auto jobs = std::make_shared<PowerLaw>();
    jobs->count = settings.quick ? 128 : 4096;
    Workload workload{ .name = "power_law",
                       .title = fmt::format("{} jobs of power-law sizes", jobs->count),
                       .unit = "ms",
                       .kind = "uneven",
                       .contenders = {},
                       .targets = { { .figure = Figure::Ratio, .other = "ideal", .limit = 1.03 } } };
    const auto make = [&](RuntimeKind kind) -> Contender {
        std::shared_ptr<Runtime> runtime = makeRuntime(kind, { .threads = settings.threads });
        const size_t affordable = std::min<size_t>(jobs->count, runtime->affordableJobs());
        const auto sample = [=](std::vector<double>& figures) {
            if (kind == RuntimeKind::Serial) jobs->draw(); // the first contender of the round
            const double ns = timeOnce(*runtime, [&](Runtime& r) { r.spinJobs({ jobs->steps.data(), affordable }); });
            if (kind == RuntimeKind::Serial) jobs->serialNs = ns;
            figures.push_back(ns * 1e-6 * jobs->total(jobs->count) / jobs->total(affordable));
        };
        return { toString(kind), sample, scaledNote(static_cast<uint32_t>(affordable), jobs->count, "jobs") };
    };
    workload.contenders.push_back(make(RuntimeKind::Serial));
    workload.contenders.push_back({ "ideal", [=](std::vector<double>& figures) {
                                       figures.push_back(jobs->idealNs(settings.threads) * 1e-6);
                                   } });
    using enum RuntimeKind;
    addRuntimes(workload, std::array{ Ours, OneTbb, OpenMp, Eigen, Asio, StdAsync }, Work::Jobs, make);
    return workload;
}

// -------------------------------------------------------------------------------------------------- hogged core

/// The equivalent number of cores if another process takes half of one of them.
double coresLeft(Settings const& settings) {
    return std::min<double>(settings.threads, static_cast<double>(allowedCores().size())) - 0.5;
}

struct Hogged {
    const char* name;
    const char* title;
    bool pinned;
    Work kind;
    std::function<void(Runtime&)> work;
    std::vector<RuntimeKind> against;
};

Result<Workload> hoggedCore(Settings const& settings, Hogged const& hogged) {
    auto hog = std::make_shared<HogProcess>(coreOfThread(1));
    if (!hog->isRunning()) return fail(ErrorCode::Unsupported, "{}: no second process could be started", hogged.name);
    Workload workload{
        .name = hogged.name, .title = hogged.title, .unit = "ms", .kind = "uneven", .contenders = {}, .targets = {}
    };
    if (hogged.pinned) workload.targets = { { .figure = Figure::Ratio, .other = "fair", .limit = 1.15 } };

    auto serialNs = std::make_shared<double>(0);
    workload.contenders.push_back(
            { "serial", [=, serial = std::shared_ptr(makeSerialRuntime())](std::vector<double>& figures) {
                 *serialNs = timeOnce(*serial, hogged.work);
                 figures.push_back(*serialNs * 1e-6);
             } });
    workload.contenders.push_back({ "fair", [=, left = coresLeft(settings)](std::vector<double>& figures) {
                                       figures.push_back(*serialNs * 1e-6 / left);
                                   } });
    addRuntimes(workload, hogged.against, hogged.kind, [&](RuntimeKind kind) -> Contender {
        std::shared_ptr<Runtime> runtime = makeRuntime(kind, { .threads = settings.threads, .pinned = hogged.pinned });
        return { toString(kind), [=](std::vector<double>& figures) {
                    hog->hog();
                    figures.push_back(timeOnce(*runtime, hogged.work) * 1e-6);
                    hog->relent();
                } };
    });
    return workload;
}

} // namespace

void addUnevenWorkloads(WorkloadList& list, Settings const& settings) {
    list.push_back({ "power_law", [=] { return powerLaw(settings); } });

    const double wholeNs = settings.quick ? 2e6 : 100e6;
    const auto jobs = [wholeNs](Runtime& runtime) {
        static const std::vector<uint32_t> kSteps(static_cast<size_t>(wholeNs / 20e3),
                                                  static_cast<uint32_t>(stepsFor(20e3)));
        runtime.spinJobs(kSteps);
    };
    const auto loop = [wholeNs](Runtime& runtime) {
        runtime.loop(SpinWork::ofItems(20), static_cast<uint64_t>(wholeNs / 20), 1);
    };
    using enum RuntimeKind;
    const std::vector<RuntimeKind> forJobs{ Ours, OneTbb, OpenMp, Eigen, Asio },
            forLoops{ Ours, OneTbb, OpenMp, Eigen, Asio, StdAsync };
    for (Hogged const& hogged : {
                 Hogged{ "hogged_jobs_pinned", "hogged core, jobs of 20 us, pinned", true, Work::Jobs, jobs, forJobs },
                 Hogged{ "hogged_jobs", "hogged core, jobs of 20 us, unpinned", false, Work::Jobs, jobs, forJobs },
                 Hogged{ "hogged_loop_pinned", "hogged core, parallel-for, pinned", true, Work::Loop, loop, forLoops },
                 Hogged{ "hogged_loop", "hogged core, parallel-for, unpinned", false, Work::Loop, loop, forLoops },
         })
        list.push_back({ hogged.name, [=] { return hoggedCore(settings, hogged); } });
}

} // namespace filament_core::bench
