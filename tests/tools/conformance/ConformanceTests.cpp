// SPDX-License-Identifier: Apache-2.0
#include "toolkit/mutations/Mutations.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/program/ChildProcess.h"
#include "toolkit/program/Interrupt.h"
#include "toolkit/scenes/BuiltModel.h"
#include "toolkit/scenes/MaterialModel.h"
#include "tools/conformance/Journal.h"
#include "tools/conformance/Runner.h"

#include <filament_core/Photometry.h>

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

namespace filament_core::conformance {
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
    EXPECT_EQ(toString(scene->front().view.quality), "specularVisibility=fast shBands=2 shadows=off");
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
    expect(R"("points": [ { "candela": -1 } ])", "points[0]: candela: expected a number from 0 to");
    expect(R"("points": [ { "candela": 1, "lumens": 1 } ])", "a lamp has one intensity");
    expect(R"("points": [ { "lumensPerWatt": 100 } ])", "lumensPerWatt: belongs to 'watts'");
    expect(R"("points": [ { "watts": 1, "lumensPerWatt": 700 } ])", "lumensPerWatt: expected a number from 0 to 683");
    expect(R"("points": [ { "luxAtMeters": 2 } ])", "luxAtMeters: belongs to 'lux'");
    expect(R"("points": [ { "direction": [ 0, -1, 0 ] } ])", "direction: belongs to 'profile'");
    expect(R"("points": [ { "up": [ 0, 0, 1 ] } ])", "up: belongs to 'profile'");
    expect(R"("points": [ { "profile": "a.ies", "direction": [ 0, 0, 0 ] } ])",
           "direction: expected one that is not zero");
    expect(R"("points": [ { "kelvin": 900 } ])", "kelvin: expected a number from 1000 to 15000");
    expect(R"("points": [ { "daylightKelvin": 3000 } ])", "daylightKelvin: expected a number from 4000 to 25000");
    expect(R"("points": [ { "kelvin": 3000, "daylightKelvin": 6000 } ])", "a light has one temperature");
    expect(R"("points": [ { "color": [ 1, -1, 1 ] } ])", "color: expected 3 numbers from 0 to 1e9");
    expect(R"("points": [ { "channels": [ 8 ] } ])", "channels: expected a list of numbers from 0 to 7");
    expect(R"("points": [ { "channels": 1 } ])", "channels: expected a list of numbers from 0 to 7");
    expect(R"("spots": [ { "direction": [ 0, 0, 1 ], "focused": true } ])", "focused: belongs to 'lumens' or 'watts'");
    expect(R"("spots": [ { "direction": [ 0, 0, 1 ], "innerDegrees": 50, "lumens": 1, "focused": true } ])",
           "innerDegrees: expected less than the 35 of outerDegrees");
    for (const char* field : { R"("values": { "roughness": "0.5" })", R"("depthWrite": false)", R"("stencil": {})" })
        expect(fmt::format(R"("copies": [ {{ {} }} ])", field),
               "'values' and raster states belong to a model that is a material");
    expect(R"("copies": [ { "stencil": { "onPass": "add" } } ])", "incrementClamp");
    expect(R"("copies": [ { "stencil": { "test": "below" } } ])", "greaterEqual");
    expect(R"("copies": [ { "stencil": { "reference": 256 } } ])", "255");
    expect(R"("copies": [ { "values": { "roughness": 0.5 } } ])", "copies[0]: values: 'roughness': expected a text");
    expect(R"("view": { "size": [ -1, 4 ] })", "view: size: expected 2 numbers from 1 to 4096");
    expect(R"("origin": [ 1e999, 0, 0 ])", "out of range");
    expect(R"("suns": [ { "direction": [ 1.8e19, 1.8e19, 0 ] } ])", "was read");
}

TEST(SceneFiles, LightsTakeTheUnitsOfLampsAndChannels) {
    const std::filesystem::path file = tools::buildDir() / "lights-scene.json";
    std::ofstream(file) << R"({ "model": "a.glb", "copies": [ { "channels": [ 1, 7 ] }, {} ],
        "suns": [ { "direction": [ 0, -1, 0 ], "daylightKelvin": 5500, "channels": [ 0, 3 ] } ],
        "points": [ { "watts": 9, "lumensPerWatt": 90, "kelvin": 2700 }, { "lux": 100, "luxAtMeters": 3 } ],
        "spots": [ { "direction": [ 0, -1, 0 ], "lumens": 100, "channels": [] },
                   { "direction": [ 0, -1, 0 ], "lumens": 100, "focused": true, "innerDegrees": 5, "outerDegrees": 9 } ] })";
    const auto scenes = readSceneFile(file);
    ASSERT_TRUE(scenes.ok()) << scenes.error().message;
    SceneSpec const& spec = scenes->front();
    EXPECT_EQ(spec.copyChannels, (std::vector<LightChannels>{ 0b1000'0010, 1 }));
    ASSERT_EQ(spec.lights.size(), 5u);
    EXPECT_EQ(std::get<SunLight>(spec.lights[0]).lightChannels, 0b1001);
    EXPECT_EQ(std::get<SunLight>(spec.lights[0]).color, color::fromDaylight(5500));
    EXPECT_EQ(std::get<PointLight>(spec.lights[1]).intensity.value, pointIntensity(Lumen{ 810 }).value);
    EXPECT_EQ(std::get<PointLight>(spec.lights[1]).color, color::fromTemperature(2700));
    EXPECT_EQ(std::get<PointLight>(spec.lights[2]).intensity.value, 900);
    EXPECT_EQ(std::get<SpotLight>(spec.lights[3]).intensity.value, spotIntensity(Lumen{ 100 }).value);
    EXPECT_EQ(std::get<SpotLight>(spec.lights[3]).lightChannels, 0);
    SpotLight const& focused = std::get<SpotLight>(spec.lights[4]);
    EXPECT_FLOAT_EQ(spotPower(focused.intensity, focused.innerConeRadians, focused.outerConeRadians).value, 100);
}

TEST(SceneFiles, LightsNameTheFilesOfTheirProfiles) {
    const std::filesystem::path file = tools::buildDir() / "profiles-scene.json";
    std::ofstream(file) << R"({ "model": "a.glb", "suns": [ { "direction": [ 0, -1, 0 ] } ],
        "points": [ { "profile": "lamps/a.ies", "direction": [ 0, -2, 0 ], "up": [ 0, 0, 1 ] }, {} ],
        "spots": [ { "profile": "asset:b.ies", "direction": [ 0, -1, 0 ] } ] })";
    const auto scenes = readSceneFile(file);
    ASSERT_TRUE(scenes.ok()) << scenes.error().message;
    SceneSpec const& spec = scenes->front();
    EXPECT_EQ(spec.lightProfiles, (std::vector<std::string>{ "", "lamps/a.ies", "", "asset:b.ies" }));
    EXPECT_EQ(std::get<PointLight>(spec.lights[1]).directionWorld, float3(0, -2, 0));
    EXPECT_EQ(std::get<PointLight>(spec.lights[1]).upWorld, float3(0, 0, 1));
    const SceneFolders folders{ "work", "assets" };
    EXPECT_EQ(profileFile(spec, 1, folders), file.parent_path() / "lamps/a.ies");
    EXPECT_EQ(profileFile(spec, 2, folders), "");
    EXPECT_EQ(profileFile(spec, 3, folders), "assets/b.ies");
}

TEST(SceneFiles, GridsOfMoreThan4096ObjectsAreRefusedBeforeAnyIsMade) {
    const Json model = Json::parse(R"({ "objects": [ { "grid": { "count": [ 65536, 65536 ] } } ] })");
    const auto built = buildModel(model, "grid");
    ASSERT_FALSE(built.ok());
    EXPECT_NE(built.error().message.find("4096 objects at most"), std::string::npos) << built.error().message;
}

TEST(SceneFiles, MaterialsLackTheVariantsThatTheirModelFilters) {
    const auto withFilter = [](const char* name) {
        SceneSpec spec{ .name = "stand", .folder = tools::sourceDir() / "samples/materials" };
        spec.modelObject =
                std::make_shared<const Json>(Json{ { "material", "unlit.mat" }, { "variantFilter", { name } } });
        return readMaterialModel(spec);
    };
    const auto model = withFilter("skinning");
    ASSERT_TRUE(model.ok()) << model.error().message;
    for (shader::Variant const& variant : model->file->package.variants)
        EXPECT_EQ(variant.key & shader::kVariantSkinning, 0);
    const auto wrong = withFilter("skining");
    ASSERT_FALSE(wrong.ok());
    EXPECT_EQ(wrong.error().message, "stand: model: there is no variant 'skining'; did you mean 'skinning'?");
}

TEST(SceneFiles, ImageBasedLightsOfModelsSayWhatIsWrongWithThem) {
    const auto refusal = [](const char* light) {
        const Json model = Json::parse(fmt::format(R"({{ "objects": [ {{}} ], "imageBasedLight": {} }})", light));
        const auto built = buildModel(model, "room");
        return built ? "was built" : built.error().message;
    };
    EXPECT_EQ(refusal(R"({ "size": 8, "levels": 1, "intensity": 2, "degrees": [ 1, 2, 3 ] })"), "was built");
    EXPECT_EQ(refusal(R"({ "size": 12 })"), "room: model imageBasedLight: size: expected a power of two");
    EXPECT_EQ(refusal(R"({ "size": 64, "levels": 2 })"), "room: model imageBasedLight: levels: expected 1 or all");
    EXPECT_NE(refusal(R"({ "size": 512 })").find("size"), std::string::npos);
    EXPECT_NE(refusal(R"({ "sice": 8 })").find("size"), std::string::npos) << "the nearest known one";
}

TEST(SceneFiles, AnEnvironmentWithoutAFileIsThatOfTheModel) {
    const Json json = Json::parse(R"({ "model": "a.glb", "environment": { "lux": 5, "degrees": 90 } })");
    const std::filesystem::path file = tools::buildDir() / "own-environment.json";
    std::ofstream(file) << json.dump();
    const auto cases = readSceneFile(file);
    ASSERT_TRUE(cases.ok()) << cases.error().message;
    EXPECT_EQ((*cases)[0].environment, "");
    EXPECT_EQ((*cases)[0].environmentSettings.illuminance.value, 5);
    EXPECT_EQ(environmentFile((*cases)[0], { "work", "assets" }).value(), "");
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
    for (int i = 0; i < 60000 && readJournal(journal).cases.empty(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_FALSE(readJournal(journal).cases.empty());
    ::kill(child->id(), SIGINT);
    std::optional<tools::ChildEnd> end;
    for (int i = 0; i < 60000 && !end; ++i) {
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
    const auto run = [&](tools::Shard shard) {
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
} // namespace filament_core::conformance
