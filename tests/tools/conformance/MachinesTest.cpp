// SPDX-License-Identifier: Apache-2.0
// Child processes that simulate other machines: the result of a case if they draw it, draw something else, crash or
// hang.
#include "tools/conformance/Machines.h"
#include "tests/toolkit/pictures/Pictures.h"
#include "toolkit/machine/Machine.h"
#include "toolkit/paths/Paths.h"
#include "tools/conformance/Baselines.h"
#include "tools/conformance/Journal.h"
#include "tools/conformance/MachineRun.h"
#include "tools/conformance/Report.h"
#include "tools/conformance/Runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <set>

namespace filament_core::conformance {
namespace {

using testing::HasSubstr;
using Path = std::filesystem::path;

Path freshImageFolder(const char* name) {
    const Path folder = tools::buildDir() / "conformance-machine-tests" / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "images");
    return folder;
}

// ---------------------------------------------------------------------------------------------- the table, the option

TEST(Machines, HaveNamesOfTheirOwnAndChangeSomethingOrAreEmulated) {
    std::set<std::string_view> names;
    for (SimulatedMachine const& machine : simulatedMachines()) {
        EXPECT_TRUE(names.insert(machine.name).second) << machine.name;
        EXPECT_EQ(findMachine(machine.name), &machine);
        EXPECT_NE(machine.variable.first.empty(), machine.emulated.empty()) << machine.name;
        EXPECT_FALSE(machine.what.empty()) << machine.name;
    }
    EXPECT_EQ(findMachine("width-64"), nullptr);
}

Result<std::optional<Options>> parsed(std::vector<const char*> words) {
    words.insert(words.begin(), "filament-conformance");
    return parseOptions(static_cast<int>(words.size()), words.data());
}

TEST(Machines, AreChosenByNameOrAllThatAreNotEmulated) {
    const auto machinesOf = [](std::vector<const char*> const& words) { return parsed(words)->value().machines; };
    EXPECT_TRUE(machinesOf({}).empty());
    EXPECT_TRUE(machinesOf({ "--machines", "none" }).empty());
    EXPECT_EQ(machinesOf({ "--machines", "libm", "width-128", "libm" }),
              (std::vector<std::string>{ "libm", "width-128" }));
    std::vector<std::string> quick;
    for (SimulatedMachine const& machine : simulatedMachines()) {
        if (!machine.isEmulated()) quick.emplace_back(machine.name);
    }
    EXPECT_EQ(machinesOf({ "--machines", "all" }), quick);
    const auto unknown = parsed({ "--machines", "pentium" });
    ASSERT_FALSE(unknown.ok());
    EXPECT_THAT(unknown.error().message, HasSubstr("--machines"));
    EXPECT_THAT(unknown.error().message, HasSubstr("pentium"));
}

// ---------------------------------------------------------------------------------------------- a program that
// misbehaves

/// Answers like filament-conformance, but behaves as the names of the cases say.
constexpr const char* kActor = R"sh(#!/bin/sh
while [ $# -gt 0 ]; do
    case $1 in
    --journal) journal=$2; shift ;;
    --cases) shift; break ;;
    esac
    shift
done
[ "$1" = "refuses" ] && echo "no such device" && exit 1
echo "{\"devices\":{\"vulkan\":\"acted by $LP_NATIVE_VECTOR_WIDTH\"}}" > "$journal"
for name in "$@"; do
    echo "{\"begins\":\"$name\"}" >> "$journal"
    hash=reference
    reasons='[]'
    case $name in
    crashes*) echo "malloc(): invalid size"; kill -SEGV $$ ;;
    exits*) exit 3 ;;
    hangs*) exec sleep 1000 ;;
    differs*) hash=other ;;
    complains*) reasons='["gles: 7 pixels differ"]' ;;
    esac
    echo "{\"name\":\"$name\",\"status\":\"passed\",\"reasons\":$reasons,\"hash\":\"$hash\",\"image\":\"images/$name.png\"}" >> "$journal"
done
)sh";

class ActedMachines : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        mOptions.out = freshImageFolder(info->name());
        mOptions.program = mOptions.out / "actor.sh";
        std::ofstream(mOptions.program) << kActor;
        std::filesystem::permissions(mOptions.program, std::filesystem::perms::owner_all);
        if (tools::cpuFeatures() != tools::kPromisedFeatures)
            GTEST_SKIP() << "no bits are promised here: the processor lacks AVX or FMA";
    }

    /// Draws a finished run with these cases, whose images exist, again on `machine`.
    Results drawn(std::string const& machine, std::vector<std::string> const& names) {
        Results results;
        for (std::string const& name : names) {
            results.cases.push_back({ .name = name,
                                      .status = Status::Passed,
                                      .hash = "reference",
                                      .image = "images/" + name + ".png" });
            EXPECT_TRUE(savePng(mOptions.out / results.cases.back().image, grey(100)).ok());
            Image other = grey(100);
            other.pixels[0] = std::byte{ 103 }, other.pixels[40] = std::byte{ 99 };
            const Path there = mOptions.out / "machines" / machine / "images";
            std::filesystem::create_directories(there);
            EXPECT_TRUE(savePng(there / (name + ".png"), other).ok());
        }
        mOptions.machines = { machine };
        const Result<void> done = drawOnMachines(mOptions, results, { .silence = std::chrono::seconds(2) });
        EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.error().message);
        return results;
    }

    static Comparison const& comparisonOf(Results const& results, std::string const& name) {
        for (CaseResult const& result : results.cases) {
            if (result.name == name && result.comparisons.size() == 1) return result.comparisons[0];
        }
        ADD_FAILURE() << name << " has no comparison";
        static const Comparison kNone;
        return kNone;
    }

    Options mOptions;
};

TEST_F(ActedMachines, WithTheSameBitsPassTheCaseAndNameTheirDevice) {
    const Results results = drawn("width-128", { "a", "b" });
    EXPECT_EQ(summaryOf(results).passed, 2u);
    EXPECT_EQ(summaryOf(results, "width-128").identical, 2u);
    EXPECT_EQ(results.machines.at("width-128"), "acted by 128");
    EXPECT_EQ(comparisonOf(results, "a").configuration, "machine width-128");
}

TEST_F(ActedMachines, WithOtherBitsFailTheCaseWherePromisedAndShowThePixels) {
    const Results results = drawn("width-128", { "a", "differs" });
    Comparison const& comparison = comparisonOf(results, "differs");
    EXPECT_FALSE(comparison.passed);
    EXPECT_EQ(comparison.differing, 2u);
    EXPECT_EQ(comparison.maxDifference, 3u);
    for (std::string const& file : { comparison.image, comparison.difference })
        EXPECT_TRUE(std::filesystem::exists(mOptions.out / file)) << file;
    EXPECT_EQ(results.cases[0].status, Status::Passed);
    EXPECT_EQ(results.cases[1].status, Status::Failed);
    EXPECT_THAT(results.cases[1].reasons, testing::ElementsAre("machine width-128: 2 pixels differ"));
}

TEST_F(ActedMachines, WithOtherBitsAreOnlyCountedWhereNothingIsPromised) {
    const Results results = drawn("caps-sse4.1", { "a", "differs" });
    EXPECT_EQ(summaryOf(results).failed, 0u);
    EXPECT_EQ(comparisonOf(results, "differs").differing, 2u);
    EXPECT_EQ(summaryOf(results, "caps-sse4.1").differing, 1u);
}

TEST_F(ActedMachines, ThatDieOrHangFailTheirCaseAndTheNextOnesAreDrawn) {
    const Results results = drawn("width-128", { "a", "crashes", "b", "exits", "hangs", "crashes-again", "c" });
    EXPECT_EQ(summaryOf(results, "width-128").identical, 3u);
    EXPECT_EQ(summaryOf(results, "width-128").faults, 4u);
    EXPECT_EQ(summaryOf(results).failed, 4u);
    EXPECT_THAT(comparisonOf(results, "crashes").fault, HasSubstr("signal 11"));
    EXPECT_THAT(comparisonOf(results, "crashes").fault, HasSubstr("malloc(): invalid size"));
    EXPECT_THAT(comparisonOf(results, "crashes-again").fault, HasSubstr("signal 11"));
    EXPECT_THAT(comparisonOf(results, "exits").fault, HasSubstr("exit status 3"));
    EXPECT_THAT(comparisonOf(results, "hangs").fault, HasSubstr("nothing for 2 s"));
    for (const char* name : { "a", "b", "c" }) EXPECT_TRUE(comparisonOf(results, name).isIdentical()) << name;
}

TEST_F(ActedMachines, WhoseOwnBackendsDisagreeFailTheCase) {
    const Results results = drawn("width-128", { "complains" });
    EXPECT_EQ(comparisonOf(results, "complains").fault, "gles: 7 pixels differ");
    EXPECT_EQ(results.cases[0].status, Status::Failed);
}

TEST_F(ActedMachines, ThatDoNotStartDrawingAreAFaultOfEveryCase) {
    const Results results = drawn("width-128", { "refuses", "a" });
    EXPECT_EQ(summaryOf(results, "width-128").faults, 2u);
    EXPECT_THAT(comparisonOf(results, "a").fault, HasSubstr("exit status 1; no such device"));
}

TEST_F(ActedMachines, WithoutTheirProgramAreAnErrorThatNamesIt) {
    Results results{ .cases = { { .name = "a", .hash = "reference" } } };
    mOptions.program = "/nowhere/filament-conformance";
    mOptions.machines = { "libm" };
    const Result<void> done = drawOnMachines(mOptions, results);
    ASSERT_FALSE(done.ok());
    EXPECT_THAT(done.error().message, HasSubstr("machine libm: '/nowhere/filament-conformance' cannot be started"));
}

TEST_F(ActedMachines, AreInTheReportsAndReadBackFromThem) {
    const Results results = drawn("width-128", { "a", "differs", "crashes" });
    ASSERT_TRUE(writeReport(mOptions.out, results).ok());
    const Result<Results> again = readResults(mOptions.out);
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(toJson(*again), toJson(results));
    const Json machine = toJson(results).at("machines").at("width-128");
    EXPECT_EQ(machine.at("cases"), 3);
    EXPECT_EQ(machine.at("identical"), 1);
    EXPECT_EQ(machine.at("faults"), 1);
    EXPECT_TRUE(machine.at("sameBitsPromised"));
    EXPECT_THAT(htmlOf(results, mOptions.out), HasSubstr("<td>width-128</td>"));
    EXPECT_THAT(machineLines(results), HasSubstr("machine width-128: 1 of 3 cases have the same bits"));
}

TEST(JournalFile, HasWhatEndedAndWhatIsOpenEvenIfItsLastLineIsCutOff) {
    const Path file = freshImageFolder("journal") / "journal.txt";
    EXPECT_TRUE(readJournal(file).cases.empty()) << "no file: nothing happened";
    {
        Journal journal(file);
        journal.devices({ { "vulkan", "llvmpipe" } });
        journal.begins("a");
        journal.ends({ .name = "a", .status = Status::Passed, .hash = "1234" });
        journal.begins("b");
    }
    const JournalContents contents = readJournal(file);
    EXPECT_EQ(contents.devices.at("vulkan"), "llvmpipe");
    ASSERT_EQ(contents.cases.size(), 1u);
    EXPECT_EQ(contents.cases[0].hash, "1234");
    EXPECT_EQ(contents.open, "b");
    std::ofstream(file, std::ios::app) << R"({"name":"b","sta)";
    EXPECT_EQ(readJournal(file).open, "b");
}

// ---------------------------------------------------------------------------------------------- the real program

// Without a machine that draws other bits, nobody would know whether the overrides take effect.
TEST(RealMachines, DrawOtherBitsWithoutFmaAndTheSameWithOtherVectors) {
    if (tools::cpuFeatures() != tools::kPromisedFeatures) GTEST_SKIP() << "no bits are promised here";
    Options options;
    options.scenes = tools::sourceDir() / "tests/conformance/scenes";
    options.assets = tools::assetDir();
    options.out = tools::buildDir() / "conformance-machine-tests" / "real";
    options.program = tools::buildDir() / "bin" / "filament-conformance";
    options.threads = options.mutations = false;
    options.cases = { "roughness-chart" };
    options.machines = { "width-128", "caps-sse4.1" };
    auto scenes = readScenes(options.scenes);
    ASSERT_TRUE(scenes.ok()) << scenes.error().message;
    const Result<Results> results = runCases(options, casesOf(std::move(*scenes), options));
    ASSERT_TRUE(results.ok()) << results.error().message;
    const MachineSummary narrow = summaryOf(*results, "width-128"), old = summaryOf(*results, "caps-sse4.1");
    EXPECT_EQ(narrow.identical, 1u);
    EXPECT_THAT(results->machines.at("width-128"), HasSubstr("128 bits"));
    EXPECT_EQ(old.differing, 1u);
    EXPECT_EQ(old.faults, 0u);
    EXPECT_EQ(summaryOf(*results).failed, 0u);
}

} // namespace
} // namespace filament_core::conformance
