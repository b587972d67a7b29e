// SPDX-License-Identifier: Apache-2.0
// threading_bench [--filter REGEX] [--rounds N] [--workers N] [--json FILE] [--plot FILE] [--quick] [--list]
//                 [--contention]
// Compares the job system with oneTBB, OpenMP, Eigen, Boost.Asio, std::async and a serial loop, measured in turns.
// README.md says how to read the results.
// Google Benchmark registers, filters and runs. A workload is one benchmark, and each of its iterations is a round:
// every contender once, in order, timed separately. (Google Benchmark's random interleaving shuffles whole repetitions;
// figures of different contenders would not belong together, and ratios within a round could not be formed.)
#include "bench/threading/Contention.h"
#include "bench/threading/Placement.h"
#include "bench/threading/Report.h"
#include "bench/threading/Workloads.h"
#include "toolkit/machine/Machine.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/program/CommandLine.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

namespace {

using namespace filament_core;
using namespace filament_core::bench;

struct Options {
    Settings settings;
    std::string filter = ".";
    std::string json, plot;
    bool list = false, contention = false;
};

/// A terminal line that is overwritten; prints nothing if the output is not a terminal.
void showProgress(std::string const& name, int round, int rounds) {
    if (!isatty(STDERR_FILENO)) return;
    if (round < rounds)
        fmt::print(stderr, "\r\x1b[K{}: round {} of {}", name, round + 1, rounds);
    else
        fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
}

/// Collects what the benchmarks measured and prints each as soon as it is done.
class Reporter final : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(Context const&) override { return true; } // printMachine() says more
    void ReportRuns(std::vector<Run> const& runs) override {
        for (Run const& run : runs)
            if (run.error_occurred)
                fmt::print(stderr, "threading_bench: {} is left out: {}\n", run.run_name.str(), run.error_message);
        if (mResults.size() > mPrinted) mTable.print(mResults[mPrinted++]);
    }
    void Finalize() override { mTable.printSummary(); }

    void add(Measured measured) { mResults.push_back(std::move(measured)); }
    std::vector<Measured> const& results() const { return mResults; }

private:
    std::vector<Measured> mResults;
    size_t mPrinted = 0;
    Table mTable;
};

void runWorkload(benchmark::State& state, WorkloadEntry const& entry, Settings const& settings, Reporter& reporter) {
    showProgress(entry.name, 0, settings.rounds);
    Result<Workload> workload = entry.make();
    if (!workload) {
        showProgress(entry.name, settings.rounds, settings.rounds);
        state.SkipWithError(workload.error().message.c_str());
        return;
    }
    if (settings.quick) workload->targets.clear();
    Rounds rounds(std::move(*workload));
    int round = 0;
    for (auto _ : state) {
        showProgress(entry.name, round++, settings.rounds);
        state.SetIterationTime(rounds.runOne() * 1e-9);
    }
    showProgress(entry.name, settings.rounds, settings.rounds);
    reporter.add(std::move(rounds).finish());
}

/// tools/plot draws FILE.json. Its messages go to the same streams as ours.
bool plot(std::string const& json, std::string const& picture, const char* what = "bench") {
    const std::string python = tools::plotPython(), script = tools::sourceDir() / "tools/plot/plot.py";
    const pid_t child = fork();
    if (child == 0) {
        execl(python.c_str(), python.c_str(), script.c_str(), what, json.c_str(), "-o", picture.c_str(), nullptr);
        _exit(127);
    }
    int status = -1;
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int finish(Options const& options, MachineDescription const& machine, Reporter const& reporter) {
    if (reporter.results().empty()) {
        fmt::print(stderr, "threading_bench: error: nothing was measured; --list names the workloads\n");
        return 1;
    }
    if (options.json.empty() && options.plot.empty()) return 0;
    const std::string json = options.json.empty() ? options.plot + ".json" : options.json;
    if (Result<void> written = writeJson(json, machine, options.settings, reporter.results()); !written) {
        fmt::print(stderr, "threading_bench: error: {}\n", written.error().message);
        return 1;
    }
    if (options.plot.empty() || plot(json, options.plot)) return 0;
    fmt::print(stderr,
               "threading_bench: error: no plot; the figures are in {}, draw them with tools/plot/plot.py bench\n",
               json);
    return 1;
}

int runContention(Options const& options, MachineDescription const& machine) {
    const std::vector<ContentionRow> rows = measureContention(options.settings.quick);
    if (options.json.empty() && options.plot.empty()) return 0;
    const std::string json = options.json.empty() ? options.plot + ".json" : options.json;
    if (Result<void> written = writeJson(json, machine, rows); !written) {
        fmt::print(stderr, "threading_bench: error: {}\n", written.error().message);
        return 1;
    }
    if (options.plot.empty() || plot(json, options.plot, "contention")) return 0;
    fmt::print(stderr, "threading_bench: error: no plot; the counts are in {}\n", json);
    return 1;
}

int run(Options const& options) {
    Reporter reporter;
    const WorkloadList workloads = allWorkloads(options.settings);
    for (WorkloadEntry const& entry : workloads)
        benchmark::RegisterBenchmark(
                entry.name.c_str(),
                [&](benchmark::State& state) { runWorkload(state, entry, options.settings, reporter); })
                ->Iterations(options.settings.rounds)
                ->UseManualTime();
    if (options.list) {
        for (WorkloadEntry const& entry : workloads) fmt::print("{}\n", entry.name);
        return 0;
    }
    MachineDescription machine = tools::machineFacts();
    machine.emplace_back("allowed", fmt::format("cores {}", fmt::join(allowedCores(), ",")));
    if (options.contention) return runContention(options, machine);
    if (const std::string absent = absentRuntimes(); !absent.empty())
        machine.emplace_back("left out", fmt::format("not found when this program was configured: {}", absent));
    printMachine(machine, options.settings);
    benchmark::RunSpecifiedBenchmarks(&reporter, options.filter);
    return finish(options, machine, reporter);
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    Settings& settings = options.settings;
    int workers = static_cast<int>(allowedCores().size()) - 1;
    filament_core::tools::CommandLine app(
            "Threads measured against oneTBB, OpenMP, Eigen, Boost.Asio, std::async and a serial loop, in turns");
    app.option("--filter", options.filter, "only workloads whose name matches this regular expression");
    app.option("--rounds", settings.rounds, "rounds: every contender once").inRange(1, 10'000);
    app.option("--workers", workers, "threads besides the caller; default: one less than the allowed cores")
            .inRange(0, 254);
    app.option("--json", options.json, "write all figures to this file");
    app.option("--plot", options.plot, "draw the figures into this .png or .svg (tools/plot)");
    app.flag("--quick", settings.quick, "three rounds of small sizes: takes seconds, only tests that it works");
    app.flag("--contention", options.contention,
             "instead: count what threads do to each other, by job, with 1 to 16 workers");
    app.flag("--list", options.list, "list the workloads and exit");
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    settings.threads = static_cast<unsigned>(workers) + 1;
    if (settings.quick) {
        settings.sampleNs = 5e4;
        if (!app.wasGiven("--rounds")) settings.rounds = 3;
    }
    return run(options);
}
