// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/MachineRun.h"

#include "base/Assert.h"
#include "toolkit/pictures/ImageCompare.h"
#include "toolkit/program/ChildProcess.h"
#include "toolkit/program/Console.h"
#include "tools/conformance/Baselines.h"
#include "tools/conformance/Journal.h"
#include "tools/conformance/Machines.h"

#include <filament_core/Image.h>

#include <algorithm>
#include <cstdio>
#include <thread>

namespace filament_core::conformance {
namespace {

using Path = std::filesystem::path;

/// The results of the children of one machine, by case.
struct MachineOutcome {
    std::string device;
    std::map<std::string, CaseResult> cases;
    std::map<std::string, std::string> faults;
};

std::string lastLineOf(Path const& file) {
    std::ifstream lines(file);
    std::string last;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty()) last = line;
    }
    return last;
}

/// Runs the children of one machine, one after the other until every case has a result.
class MachineChildren {
public:
    MachineChildren(Options const& options, SimulatedMachine const& machine, MachineLimits const& limits)
            : mOptions(options), mMachine(machine), mFolder(options.out / "machines" / machine.name),
              mSilence(machine.isEmulated() ? limits.emulatedSilence : limits.silence) {}

    Result<MachineOutcome> draw(std::vector<std::string> cases) {
        std::error_code error;
        std::filesystem::create_directories(mFolder, error);
        if (error) return fail(ErrorCode::Unreadable, "{}: {}", mFolder.string(), error.message());
        while (!cases.empty()) {
            const Result<std::string> end = runChild(cases);
            if (!end) return end.error();
            take(readJournal(journal()), *end, cases);
        }
        return std::move(mOutcome);
    }

private:
    Path journal() const { return mFolder / "journal.txt"; }
    Path log() const { return mFolder / "log.txt"; }

    /// Runs a child; returns how it ended.
    Result<std::string> runChild(std::vector<std::string> const& cases) {
        std::error_code ignored;
        std::filesystem::remove(journal(), ignored);
        tools::ChildCommand command{ wordsFor(cases), {}, log() };
        if (!mMachine.variable.first.empty()) command.environment.emplace_back(mMachine.variable);
        Result<tools::ChildProcess> child = tools::ChildProcess::start(command);
        if (!child) return child.error();
        return waitFor(*child);
    }

    std::string waitFor(tools::ChildProcess& child) {
        using Clock = std::chrono::steady_clock;
        auto heard = Clock::now();
        for (uintmax_t size = 0;;) {
            if (const auto end = child.poll()) return end->text();
            std::error_code none; // no journal yet
            const uintmax_t now = std::filesystem::file_size(journal(), none);
            if (!none && now != size) {
                size = now, heard = Clock::now();
                tools::showProgress(fmt::format("machine {}: {}", mMachine.name, readJournal(journal()).open));
            }
            if (Clock::now() - heard > mSilence) {
                child.kill();
                return fmt::format("nothing for {} s", mSilence.count());
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }

    /// Adds the journal's results to the outcome and removes from `cases` those that are done, at least one.
    void take(JournalContents contents, std::string const& end, std::vector<std::string>& cases) {
        for (auto const& [backend, device] : contents.devices) mOutcome.device = device;
        for (CaseResult& result : contents.cases) {
            std::erase(cases, result.name);
            mOutcome.cases[result.name] = std::move(result);
        }
        const auto blame = [&](std::string const& name) {
            std::string last = lastLineOf(log());
            mOutcome.faults[name] = fmt::format("the process ended: {}{}{}", end, last.empty() ? "" : "; ", last);
        };
        const auto open = std::ranges::find(cases, contents.open);
        if (open != cases.end()) {
            blame(*open);
            cases.erase(open);
        } else if (contents.cases.empty()) { // it crashed before the first case, as would the next one
            for (std::string const& name : cases) blame(name);
            cases.clear();
        }
    }

    std::vector<std::string> wordsFor(std::vector<std::string> const& cases) const {
        std::vector<std::string> words = mMachine.launcher();
        const auto add = [&](std::initializer_list<std::string> more) {
            words.insert(words.end(), more.begin(), more.end());
        };
        add({ mOptions.program, "--scenes", mOptions.scenes, "--assets", mOptions.assets, "--baselines", "none" });
        add({ "--threads", "off", "--mutations", "off", "--out", mFolder, "--journal", journal() });
        if (!mOptions.requireDevice.empty()) add({ "--require-device", mOptions.requireDevice });
        if (!mOptions.exact) add({ "--set", "exact=off" });
        for (auto const& [name, value] : mOptions.quality) add({ "--set", name + "=" + value });
        add({ "--backends" });
        for (const Backend backend : mOptions.backends) add({ toString(backend) });
        add({ "--cases" });
        words.insert(words.end(), cases.begin(), cases.end());
        return words;
    }

    Options const& mOptions;
    SimulatedMachine const& mMachine;
    const Path mFolder;
    const std::chrono::seconds mSilence;
    MachineOutcome mOutcome;
};

Comparison compareCase(Options const& options, SimulatedMachine const& machine, CaseResult const& here,
                       MachineOutcome const& there) {
    Comparison comparison{ .configuration = machineConfiguration(machine.name) };
    const auto found = there.cases.find(here.name);
    if (found == there.cases.end()) {
        const auto fault = there.faults.find(here.name);
        comparison.fault = fault == there.faults.end() ? "was not drawn" : fault->second;
        return comparison;
    }
    CaseResult const& drawn = found->second;
    for (std::string const& reason : drawn.reasons) comparison.fault += (comparison.fault.empty() ? "" : "; ") + reason;
    if (drawn.hash == here.hash || drawn.hash.empty()) return comparison;
    const Path picture = options.out / "machines" / machine.name / drawn.image;
    if (const Result<void> done = compareFiles(options.out, here.image, picture, comparison); !done)
        comparison.fault = done.error().message;
    return comparison;
}

void judge(bool isPromised, Comparison& comparison, CaseResult& result) {
    comparison.passed = comparison.isIdentical() || !isPromised;
    if (comparison.passed) return;
    const std::string what =
            comparison.fault.empty() ? fmt::format("{} pixels differ", comparison.differing) : comparison.fault;
    result.reasons.push_back(fmt::format("{}: {}", comparison.configuration, what));
    tools::clearProgress();
    std::printf("%-8s %s: %s\n", toString(Status::Failed), result.name.c_str(), result.reasons.back().c_str());
    result.status = Status::Failed;
}

std::vector<std::string> drawnCases(Results const& results) {
    std::vector<std::string> names;
    for (CaseResult const& result : results.cases) {
        if (!result.hash.empty()) names.push_back(result.name);
    }
    return names;
}

} // namespace

Result<void> drawOnMachines(Options const& options, Results& results, MachineLimits const& limits) {
    const std::vector<std::string> names = drawnCases(results);
    const bool isOneOfThem = tools::cpuFeatures() == tools::kPromisedFeatures; // this process draws those bits
    for (std::string const& name : options.machines) {
        SimulatedMachine const* machine = findMachine(name);
        FILAMENT_ASSERT(machine, "parseOptions() checks the names of --machines");
        tools::showProgress("machine " + name);
        const Result<MachineOutcome> outcome = MachineChildren(options, *machine, limits).draw(names);
        if (!outcome) return fail(outcome.error().code, "machine {}: {}", name, outcome.error().message);
        results.machines[name] = outcome->device;
        for (CaseResult& result : results.cases) {
            if (result.hash.empty()) continue;
            Comparison comparison = compareCase(options, *machine, result, *outcome);
            judge(machine->sameBits && isOneOfThem, comparison, result);
            result.comparisons.push_back(std::move(comparison));
        }
    }
    return {};
}

} // namespace filament_core::conformance
