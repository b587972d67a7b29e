// SPDX-License-Identifier: Apache-2.0
#include "tools/common/ChildProcess.h"
#include "tools/common/Interrupt.h"
#include "tools/conformance/BuiltModel.h"
#include "tools/conformance/Journal.h"
#include "tools/conformance/Mutations.h"
#include "tools/conformance/Runner.h"
#include "tools/paths/Paths.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>

namespace filament::conformance {
namespace {

Options optionsFor(std::string const& name) {
    Options options;
    options.scenes = tools::sourceDir() / "tests/conformance/scenes";
    options.baselines = tools::sourceDir() / "tests/conformance/baselines.json";
    options.assets = tools::assetDir();
    options.out = tools::buildDir() / "conformance-tests";
    options.threads = false;
    options.bisect = name;
    options.build = "test";
    return options;
}

std::vector<SceneSpec> allScenes() {
    auto scenes = readScenes(tools::sourceDir() / "tests/conformance/scenes");
    EXPECT_TRUE(scenes.ok()) << (scenes.ok() ? "" : scenes.error().message);
    return scenes.ok() ? std::move(*scenes) : std::vector<SceneSpec>();
}

TEST(Shards, TogetherHaveEveryCaseOnce) {
    const std::vector<SceneSpec> all = allScenes();
    std::multiset<std::string> names;
    Options options;
    for (options.shard = { 0, 3 }; options.shard.index < 3; ++options.shard.index) {
        for (SceneSpec const& spec : casesOf(all, options)) names.insert(spec.name);
    }
    EXPECT_EQ(names.size(), all.size());
    for (SceneSpec const& spec : all) EXPECT_EQ(names.count(spec.name), 1u) << spec.name;
    EXPECT_FALSE(parseShard("3/3").ok());
    EXPECT_FALSE(parseShard("one").ok());
}

TEST(Mutations, AreEachClaimedByAScene) {
    std::set<std::string, std::less<>> claimed{ "none", "oneList" };
    for (SceneSpec const& spec : allScenes()) claimed.insert(spec.kills.begin(), spec.kills.end());
    for (const std::string_view name : mutationNames()) EXPECT_TRUE(claimed.contains(name)) << name;
}

TEST(Mutations, OfTheShadersOfOneApiNeedThatApi) {
    Options options = optionsFor("");
    options.backends = { Backend::Vulkan };
    options.mutate = "constantOutputs";
    const auto pair = openPair(options, false);
    if (!pair && pair.error().code != ErrorCode::InvalidArgument) GTEST_SKIP() << pair.error().message;
    ASSERT_FALSE(pair.ok());
    EXPECT_NE(pair.error().message.find("gles"), std::string::npos) << pair.error().message;
}

TEST(Bisect, NamesPassAndDrawOfABrokenDepthTest) {
    Options options = optionsFor("intersecting");
    options.mutate = "depthCompare";
    const Result<std::string> found = bisectCase(options, allScenes());
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_NE(found->find("pass 'color"), std::string::npos) << *found;
    EXPECT_NE(found->find("draw "), std::string::npos) << *found;
    EXPECT_NE(found->find("pipeline 'gltf_lit_opaque'"), std::string::npos) << *found;
}

TEST(Bisect, FindsNothingWhereNothingDiffers) {
    const Result<std::string> found = bisectCase(optionsFor("intersecting"), allScenes());
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(*found, "");
}

// Equal bits are due to the exact shaders: without them a case that requires bits must fail.
TEST(Exactness, ShadersLeftToTheDriversAreNoticed) {
    Options options = optionsFor("");
    options.only = { "roughness-chart/linear" };
    options.mutations = false;
    const auto run = [&](bool exact) {
        options.exact = exact;
        auto results = runCases(options, casesOf(allScenes(), options));
        EXPECT_TRUE(results.ok()) << (results.ok() ? "" : results.error().message);
        return results.ok() ? std::move(*results) : Results();
    };
    EXPECT_EQ(summaryOf(run(true)).failed, 0u);
    const Results plain = run(false);
    ASSERT_EQ(plain.cases.size(), 1u);
    ASSERT_EQ(plain.cases[0].comparisons.size(), 1u);
    EXPECT_GT(plain.cases[0].comparisons[0].differing, 0u);
    EXPECT_FALSE(plain.cases[0].comparisons[0].passed);
}

TEST(SceneFiles, SayQualityByItsNamesAndAMisspeltOneIsAnError) {
    const std::filesystem::path file = tools::buildDir() / "quality-scene.json";
    const auto read = [&](const char* quality) {
        std::ofstream(file) << R"({ "model": "a.glb", "quality": )" << quality << " }";
        return readSceneFile(file);
    };
    const auto scene = read(R"({ "specularVisibility": "fast", "shBands": 2 })");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(toString(scene->front().view.quality), "specularVisibility=fast shBands=2");
    const auto misspelt = read(R"({ "shBand": 2 })");
    ASSERT_FALSE(misspelt.ok());
    EXPECT_NE(misspelt.error().message.find("shBands"), std::string::npos) << misspelt.error().message;
    EXPECT_FALSE(read(R"({ "shBands": 7 })").ok());
}

// Each would become an assertion of the engine, or an endless model.
TEST(SceneFiles, SayWhichValuesTheEngineCannotTake) {
    const std::filesystem::path file = tools::buildDir() / "broken-scene.json";
    const auto refusal = [&](std::string const& fields) {
        std::ofstream(file) << R"({ "model": "a.glb", )" << fields << " }";
        const auto scene = readSceneFile(file);
        return scene.ok() ? "was read" : scene.error().message;
    };
    const auto expect = [&](std::string const& fields, const char* part) {
        EXPECT_NE(refusal(fields).find(part), std::string::npos) << fields << ": " << refusal(fields);
    };
    expect(R"("suns": [ { "direction": [ 0, 0, 0 ] } ])", "suns[0]: direction: expected one that is not zero");
    expect(R"("suns": [ { "direction": [ 0, 1e39, 0 ] } ])", "suns[0]: direction: expected 3 numbers from -3.4");
    expect(R"("spots": [ { "direction": [ 1e-60, 0, 0 ] } ])", "spots[0]: direction: expected one that is not zero");
    expect(R"("view": { "size": [ -1, 4 ] })", "view: size: expected 2 numbers from 0 to 4294967295");
    expect(R"("origin": [ 1e999, 0, 0 ])", "out_of_range");
    expect(R"("suns": [ { "direction": [ 1.8e19, 1.8e19, 0 ] } ])", "was read");
}

TEST(SceneFiles, GridsOfMoreThan4096ObjectsAreRefusedBeforeAnyIsMade) {
    const Json model = Json::parse(R"({ "objects": [ { "grid": { "count": [ 65536, 65536 ] } } ] })");
    const auto built = buildModel(model, "grid");
    ASSERT_FALSE(built.ok());
    EXPECT_NE(built.error().message.find("4096 objects at most"), std::string::npos) << built.error().message;
}

TEST(Program, AFullStandardOutputIsAnError) {
    const std::string command = (tools::buildDir() / "bin/filament-conformance").string() + " --list --scenes " +
                                (tools::sourceDir() / "tests/conformance/scenes").string() + " >/dev/full 2>/dev/null";
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status;
}

// One signal: the case that is being drawn ends, and the report has those until then.
TEST(Program, CtrlCEndsTheRunWithAReportOfWhatIsDone) {
    const std::filesystem::path out = tools::buildDir() / "conformance-interrupted", journal = out / "journal.txt";
    std::filesystem::remove_all(out);
    std::filesystem::create_directories(out);
    auto child =
            tools::ChildProcess::start({ { (tools::buildDir() / "bin/filament-conformance").string(), "--scenes",
                                           (tools::sourceDir() / "tests/conformance/scenes").string(), "--baselines",
                                           "none", "--mutations", "off", "--threads", "off", "--only", "unlit", "sun",
                                           "mask", "--out", out.string(), "--journal", journal.string() },
                                         {},
                                         out / "log.txt" });
    ASSERT_TRUE(child.ok()) << child.error().message;
    for (int i = 0; i < 6000 && readJournal(journal).cases.empty(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_FALSE(readJournal(journal).cases.empty());
    ::kill(child->id(), SIGINT);
    std::optional<tools::ChildEnd> end;
    for (int i = 0; i < 12000 && !end; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        end = child->poll();
    }
    ASSERT_TRUE(end.has_value());
    EXPECT_EQ(end->exitStatus, tools::kInterruptedStatus) << end->text();
    const Result<Results> results = readResults(out);
    ASSERT_TRUE(results.ok()) << results.error().message;
    EXPECT_EQ(results->cases.size(), readJournal(journal).cases.size());
    std::ifstream log(out / "log.txt");
    const std::string said{ std::istreambuf_iterator<char>(log), {} };
    EXPECT_NE(said.find("interrupted after "), std::string::npos) << said;
}

TEST(Shards, MergeToTheResultsOfOneRun) {
    Options options = optionsFor("");
    options.only = { "unlit", "sun-only" };
    options.assets = ""; // a skipped case merges as well
    const auto run = [&](Shard shard) {
        options.shard = shard;
        auto results = runCases(options, casesOf(allScenes(), options));
        EXPECT_TRUE(results.ok()) << (results.ok() ? "" : results.error().message);
        return results.ok() ? std::move(*results) : Results();
    };
    const Result<Results> merged = merge({ run({ 1, 2 }), run({ 0, 2 }) });
    ASSERT_TRUE(merged.ok()) << merged.error().message;
    const Results whole = run({ 0, 1 });
    EXPECT_EQ(toJson(*merged), toJson(whole));
    EXPECT_EQ(summaryOf(whole).failed, 0u);
    EXPECT_EQ(summaryOf(whole).caught, summaryOf(whole).mutants);
    EXPECT_GE(summaryOf(whole).mutants, 4u);
}

} // namespace
} // namespace filament::conformance
