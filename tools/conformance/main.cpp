// SPDX-License-Identifier: Apache-2.0
// filament-conformance [options]: draws every scene on every backend with every number of workers and compares the
// pictures. Exit status 0: no case failed. 1: some did, or the run could not be made. 130: stopped by Ctrl-C, with a
// report of the cases until then. docs/conformance.md.
#include "toolkit/mutations/Mutations.h"
#include "toolkit/program/Console.h"
#include "toolkit/program/Program.h"
#include "tools/conformance/Against.h"
#include "tools/conformance/Machines.h"
#include "tools/conformance/Report.h"
#include "tools/conformance/Runner.h"
#include "tools/conformance/random/RandomRun.h"

#include <cstdio>

namespace filament_core::conformance {
namespace {

using tools::failed;

/// Prints what differs from the report of --against, as the run prints what differs in itself.
Result<void> compareWithOther(Options const& options, Results& results) {
    if (options.against.empty()) return {};
    if (const Result<void> done = compareWithReport(options.out, results, options.against); !done) return done;
    const std::string configuration = againstConfiguration(options.against);
    for (CaseResult const& result : results.cases) {
        for (std::string const& reason : result.reasons) {
            if (reason.starts_with(configuration))
                std::printf("%-8s %s: %s\n", "failed", result.name.c_str(), reason.c_str());
        }
    }
    std::printf("%s", againstLine(results, options.against).c_str());
    return {};
}

int finish(Options const& options, Results& results) {
    if (const Result<void> compared = compareWithOther(options, results); !compared) return failed(compared.error());
    if (!options.passedPictures) dropPassedPictures(options.out, results);
    if (const Result<void> written = writeReport(options.out, results); !written) return failed(written.error());
    std::printf("%s%s\n%s\n", machineLines(results).c_str(), summaryLine(results).c_str(),
                (options.out / "report.html").c_str());
    return summaryOf(results).failed ? 1 : 0;
}

/// A shard whose cases were all skipped has no pictures.
Result<void> copyPictures(std::filesystem::path const& from, std::filesystem::path const& to) {
    if (!std::filesystem::exists(from / "images")) return {};
    using std::filesystem::copy_options;
    std::error_code error;
    std::filesystem::create_directories(to / "images", error);
    std::filesystem::copy(from / "images", to / "images", copy_options::recursive | copy_options::overwrite_existing,
                          error); // without "recursive" it would copy nothing
    if (!error) return {};
    return fail(ErrorCode::Unreadable, "{}/images: {}", from.string(), error.message());
}

/// Reads the results of shards and copies their pictures.
int mergeShards(Options const& options) {
    std::vector<Results> parts;
    for (std::filesystem::path const& folder : options.merge) {
        Result<Results> part = readResults(folder);
        if (!part) return failed(part.error());
        parts.push_back(std::move(*part));
        if (const Result<void> copied = copyPictures(folder, options.out); !copied) return failed(copied.error());
    }
    Result<Results> merged = merge(std::move(parts));
    return merged ? finish(options, *merged) : failed(merged.error());
}

int list(std::vector<SceneSpec> const& cases) {
    for (SceneSpec const& spec : cases) std::printf("%s\n", spec.name.c_str());
    for (Mutation const& mutation : mutations())
        std::printf("mutation %s: %s\n", std::string(mutation.name).c_str(), std::string(mutation.what).c_str());
    for (SimulatedMachine const& machine : simulatedMachines())
        std::printf("machine %s (%s): %s\n", std::string(machine.name).c_str(),
                    machine.sameBits ? "the same bits" : "other bits", std::string(machine.what).c_str());
    return 0;
}

int bisectAndPrint(Options const& options, std::vector<SceneSpec> const& cases) {
    const Result<std::string> found = bisectCase(options, cases);
    tools::clearProgress();
    if (!found) return failed(found.error());
    std::printf("%s\n", found->empty() ? "every attachment of every pass has the same bits" : found->c_str());
    return found->empty() ? 0 : 1;
}

int drawRandom(Options const& options) {
    const tools::StopOnInterrupt scope;
    const Result<RandomResults> results = runRandom(options);
    tools::clearProgress();
    if (!results) return failed(results.error());
    std::printf("%u random materials from seed %llu: %zu failed\n", results->drawn,
                static_cast<unsigned long long>(options.seed), results->findings.size());
    if (tools::isInterrupted()) return tools::kInterruptedStatus;
    return results->findings.empty() ? 0 : 1;
}

int run(Options const& options) {
    if (!options.merge.empty()) return mergeShards(options);
    if (options.random > 0) return drawRandom(options);
    Result<std::vector<SceneSpec>> scenes = readScenes(options.scenes);
    if (!scenes) return failed(scenes.error());
    overrideQuality(*scenes, options);
    if (!options.bisect.empty()) return bisectAndPrint(options, *scenes);
    const std::vector<SceneSpec> cases = casesOf(std::move(*scenes), options);
    if (options.list) return list(cases);
    std::error_code error;
    std::filesystem::remove_all(options.out / "images", error); // those of an earlier run
    const tools::StopOnInterrupt scope;
    Result<Results> results = runCases(options, cases);
    tools::clearProgress();
    if (!results) return failed(results.error());
    if (options.shard.count > 1) results->shard = { options.shard, static_cast<uint32_t>(cases.size()) };
    const int status = finish(options, *results);
    if (!tools::isInterrupted()) return status;
    tools::printWarning(fmt::format("interrupted after {} of {} cases", results->cases.size(), cases.size()));
    return tools::kInterruptedStatus;
}

} // namespace
} // namespace filament_core::conformance

int main(int argc, char** argv) {
    using namespace filament_core;
    return tools::runProgram("filament-conformance", argc, argv, conformance::parseOptions, conformance::run);
}
