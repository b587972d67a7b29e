// SPDX-License-Identifier: Apache-2.0
// The public API: errors as values, leaks by name, lifetimes, and the same bits however the frame is made.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/scenes/Sphere.h"

#include "backend/create/CreateDriver.h"
#include "backend/layers/Traced.h"
#include "base/Log.h"
#include "shaders/package/EngineMaterials.h"

#include <filament_core/JobTimeline.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <string>
#include <thread>

namespace filament_core {
namespace {

/// A few spheres under a sun and a point light, without an environment: small, but with every kind of draw.
class Spheres {
public:
    explicit Spheres(Engine& engine) : scene(engine), mEngine(engine), mSphere(engine, scenes::makeSphere(16, 32)) {
        mOpaque = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_opaque") }));
        mBlended = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_blended") }));
        mRed = instance(mOpaque, { 0.8f, 0.1f, 0.1f, 1 });
        mGlass = instance(mBlended, { 0.1f, 0.4f, 0.9f, 0.5f });
        for (int i = 0; i < 3; ++i) place({ i - 1.0, 0, 0 }, mRed, i == 1 ? -0.4 : 0.4);
        place({ 0, 0, 1 }, mGlass, 0.3);
        scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f } });
        scene.add(PointLight{ .positionWorld = { 0, 1.5, 0.5 }, .intensity = Candela{ 60'000 }, .rangeMeters = 4 });
        view.camera = Camera::lookAt({ 0, 0.8, 3.2 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 });
        view.size = { 160, 120 };
    }

    Scene scene;
    View view;

private:
    Owned<MaterialInstance> instance(Material material, float4 color) {
        Owned<MaterialInstance> made = mEngine.own(mEngine.createInstance(material));
        EXPECT_TRUE(mEngine.set(made, "baseColorFactor", color));
        EXPECT_TRUE(mEngine.set(made, "roughnessFactor", 0.4f));
        mEngine.setCullingDisabled(made, false);
        return made;
    }

    void place(double3 at, MaterialInstance material, double scale) {
        double4x4 world(std::abs(scale));
        world[0][0] = scale; // negative: mirrored
        world[3] = double4(at, 1);
        scene.add(mSphere.renderable(material, world));
    }

    Engine& mEngine;
    scenes::Sphere mSphere;
    Owned<Material> mOpaque, mBlended;
    Owned<MaterialInstance> mRed, mGlass;
};

std::vector<std::byte> spheresOn(Backend backend, int workers, uint8_t samples = 1, bool dither = false) {
    auto engine = test::makeEngine(backend, workers);
    if (!engine) return {};
    Spheres spheres(*engine);
    spheres.view.samples = samples;
    spheres.view.display.dither = dither;
    Renderer renderer(*engine);
    auto image = renderer.renderToImage(spheres.scene, spheres.view);
    EXPECT_TRUE(image.ok());
    test::expectNoErrors(*engine);
    return image ? image->pixels : std::vector<std::byte>{};
}

TEST(EngineImages, AreTheSameForAnyNumberOfWorkersAndOnBothApis) {
    const std::vector<std::byte> reference = spheresOn(Backend::Vulkan, 0);
    ASSERT_FALSE(reference.empty());
    for (int workers : { 0, 1, 3 }) {
        for (Backend backend : test::kBothApis)
            EXPECT_EQ(spheresOn(backend, workers), reference) << toString(backend) << workers;
    }
}

TEST(EngineImages, AreTheSameOnBothApisWithFourSamplesAndWithDither) {
    const std::vector<std::byte> plain = spheresOn(Backend::Vulkan, 1);
    const std::vector<std::byte> samples = spheresOn(Backend::Vulkan, 1, 4);
    const std::vector<std::byte> dithered = spheresOn(Backend::Vulkan, 1, 1, true);
    EXPECT_EQ(samples, spheresOn(Backend::Gles, 1, 4));
    EXPECT_EQ(dithered, spheresOn(Backend::Gles, 1, 1, true));
    EXPECT_NE(samples, plain) << "edges are smoothed";
    EXPECT_NE(dithered, plain);
}

class EngineTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        mEngine = test::makeEngine(GetParam());
        ASSERT_TRUE(mEngine);
    }
    std::optional<Engine> mEngine;
};

TEST_P(EngineTest, LightsBrightenWhatTheyShineOn) {
    Spheres spheres(*mEngine);
    const Image lit = test::renderLinear(*mEngine, spheres.scene, spheres.view);
    Scene dark(*mEngine);
    const Image black = test::renderLinear(*mEngine, dark, spheres.view);
    EXPECT_GT(test::halfPixel(lit, 80, 70).x, 0.05f);
    EXPECT_EQ(test::halfPixel(black, 80, 70), float4(0, 0, 0, 1));
}

/// A shadow map before a tone mapper that reads the colours of its own pass, in the first commands of a device. A
/// driver with vulkan::Quirks::clearsIndependentBlend leaves such an image blank.
TEST_P(EngineTest, DrawsItsFirstFrameLikeTheNext) {
    Spheres spheres(*mEngine);
    spheres.view.quality.shadows = ShadowFilter::Pcf3;
    Renderer renderer(*mEngine);
    const auto first = renderer.renderToImage(spheres.scene, spheres.view);
    ASSERT_TRUE(first.ok());
    EXPECT_NE(renderer.graphviz().find("shadow"), std::string::npos) << renderer.graphviz();
    EXPECT_GT(test::bytePixel(*first, 40, 52).x, 0.05f);
    const auto second = renderer.renderToImage(spheres.scene, spheres.view);
    ASSERT_TRUE(second.ok());
    EXPECT_EQ(first->pixels, second->pixels);
}

TEST_P(EngineTest, AMirroredSphereLooksLikeTheOthers) {
    // The middle sphere has a negative x scale: its faces must not turn inside out.
    Spheres spheres(*mEngine);
    const Image image = test::renderLinear(*mEngine, spheres.scene, spheres.view);
    const float left = test::halfPixel(image, 40, 52).x, middle = test::halfPixel(image, 80, 42).x;
    EXPECT_GT(left, 0.05f);
    EXPECT_GT(middle, 0.05f);
}

TEST_P(EngineTest, RendersTheSmallestAndOddestTargets) {
    Spheres spheres(*mEngine);
    for (uint2 size : { uint2(1, 1), uint2(3, 1), uint2(1, 7), uint2(8192, 1) }) {
        spheres.view.size = size;
        Renderer renderer(*mEngine);
        auto image = renderer.renderToImage(spheres.scene, spheres.view);
        ASSERT_TRUE(image.ok());
        EXPECT_EQ(image->pixels.size(), size_t{ 4 } * size.x * size.y);
    }
    test::expectNoErrors(*mEngine);
}

TEST_P(EngineTest, CreatesNothingOnceEverySetOfFrameDataWasUsed) {
    Spheres spheres(*mEngine);
    const Owned<SwapChain> target = mEngine->own(mEngine->create(SwapChainDesc{ .size = spheres.view.size }));
    Renderer renderer(*mEngine);
    for (int i = 0; i < 3; ++i) renderer.render(spheres.scene, spheres.view, target);
    mEngine->waitIdle();
    const EngineStatistics first = mEngine->statistics();
    for (int i = 0; i < 20; ++i) renderer.render(spheres.scene, spheres.view, target);
    mEngine->waitIdle();
    const EngineStatistics last = mEngine->statistics();
    EXPECT_GT(first.pipelinesCreated, 0u);
    EXPECT_EQ(last.pipelinesCreated, first.pipelinesCreated);
    EXPECT_EQ(last.pipelinesCreatedInPasses, 0u);
    EXPECT_EQ(last.deviceBytes, first.deviceBytes);
    EXPECT_GT(last.draws, first.draws);
}

TEST_P(EngineTest, ReportsWhatEachFrameCost) {
    Spheres spheres(*mEngine);
    const Owned<SwapChain> target = mEngine->own(mEngine->create(SwapChainDesc{ .size = spheres.view.size }));
    Renderer renderer(*mEngine, { .passTimers = true });
    for (int i = 0; i < 5; ++i) renderer.render(spheres.scene, spheres.view, target);
    mEngine->waitIdle();
    const std::vector<FrameTimings> timings = renderer.takeTimings();
    ASSERT_EQ(timings.size(), 5u);
    for (size_t i = 0; i < timings.size(); ++i) {
        EXPECT_EQ(timings[i].frame, i + 1);
        EXPECT_LE(timings[i].beginSeconds, timings[i].submitSeconds);
        EXPECT_LE(timings[i].replayBeginSeconds, timings[i].replayEndSeconds);
        ASSERT_FALSE(timings[i].passes.empty());
        EXPECT_GT(timings[i].gpuMilliseconds, 0.0);
    }
}

TEST_P(EngineTest, ExplainsWhatItLeftOut) {
    Spheres spheres(*mEngine);
    spheres.view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 6 }); // looks away
    Renderer renderer(*mEngine);
    ASSERT_TRUE(renderer.renderToImage(spheres.scene, spheres.view).ok());
    const std::string text = renderer.explain();
    EXPECT_NE(text.find("0 of 4 renderables"), std::string::npos) << text;
    EXPECT_NE(text.find("4 not drawn: their boxes are out of view"), std::string::npos) << text;
    for (EffectDecision const& one : renderer.decisions()) {
        const bool isEffect =
                one.state == EffectDecision::State::Needed || one.state == EffectDecision::State::NotNeeded;
        if (isEffect)
            EXPECT_EQ(one.state, EffectDecision::State::NotNeeded) << one.name << ": " << one.reason;
        else
            EXPECT_GT(one.attachmentBytes, 0u) << one.name;
        EXPECT_NE(text.find(one.name), std::string::npos) << text;
        EXPECT_NE(text.find(one.reason), std::string::npos) << text;
    }
    EXPECT_EQ(renderer.statistics().culled, 4u);
    EXPECT_NE(renderer.graphviz().find("digraph"), std::string::npos);
}

TEST_P(EngineTest, NamesTheNearestParameterWhenOneIsMisspelt) {
    const Owned<Material> material =
            mEngine->own(*mEngine->create(MaterialDesc{ shader::engineMaterial("gltf_lit_opaque") }));
    const Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(material));
    const Result<void> misspelt = mEngine->set(instance, "roughnesFactor", 0.5f);
    ASSERT_FALSE(misspelt);
    EXPECT_EQ(misspelt.error().code, ErrorCode::NotFound);
    EXPECT_NE(misspelt.error().message.find("did you mean 'roughnessFactor'"), std::string::npos);
    EXPECT_EQ(mEngine->set(instance, "roughnessFactor", float3(1)).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(mEngine->set(instance, "roughnessFactor", Texture{}).error().code, ErrorCode::InvalidArgument);
    const auto constant =
            mEngine->create(MaterialDesc{ shader::engineMaterial("gltf_lit_opaque"), { { "hasNormalMapp", true } } });
    ASSERT_FALSE(constant);
    EXPECT_NE(constant.error().message.find("hasNormalMap"), std::string::npos);
}

TEST_P(EngineTest, RefusesAPackageThatIsNone) {
    const std::array<std::byte, 100> garbage{};
    const auto material = mEngine->create(MaterialDesc{ .package = garbage, .name = "garbage" });
    ASSERT_FALSE(material);
    EXPECT_NE(material.error().message.find("garbage"), std::string::npos);
}

TEST_P(EngineTest, NamesWhatWasForgotten) {
    std::vector<std::string> lines;
    const LogSink before = setLogSink([&](Severity, std::string_view line) { lines.emplace_back(line); });
    static_cast<void>(mEngine->create(TextureDesc{ .name = "forgotten" }));
    mEngine.reset();
    setLogSink(before);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0], "texture 'forgotten' was not destroyed before its engine");
}

TEST_P(EngineTest, MayBeMovedWhileObjectsRemember) {
    Owned<Texture> texture = mEngine->own(mEngine->create(TextureDesc{ .name = "moved" }));
    Engine moved = std::move(*mEngine);
    mEngine.reset();
    texture.reset(); // destroys through the engine's new address
    EXPECT_TRUE(moved.takeErrors().empty());
}

TEST_P(EngineTest, RendersWhileAnotherEngineRendersOnItsOwnThread) {
    const std::vector<std::byte> reference = spheresOn(GetParam(), 1);
    std::vector<std::byte> a, b;
    {
        std::jthread first([&] { a = spheresOn(GetParam(), 1); });
        std::jthread second([&] { b = spheresOn(GetParam(), 2); });
    }
    EXPECT_EQ(a, reference);
    EXPECT_EQ(b, reference);
}

TEST_P(EngineTest, ATracedStreamReplaysToTheSameBits) {
    const std::filesystem::path path =
            std::filesystem::temp_directory_path() / (std::string("trace-") + toString(GetParam()));
    std::vector<std::byte> recorded;
    {
        auto traced = Engine::create({ .backend = GetParam(), .workers = 0, .traceFile = path });
        ASSERT_TRUE(traced.ok());
        Spheres spheres(*traced);
        Renderer renderer(*traced);
        recorded = std::move(renderer.renderToImage(spheres.scene, spheres.view)->pixels);
    }
    const auto type = GetParam() == Backend::Vulkan ? Backend::Vulkan : Backend::Gles;
    auto stream = backend::CommandStream::start(
            [type](backend::ResultSink& sink) { return backend::createDriver(type, {}, sink); });
    ASSERT_TRUE(stream.ok());
    auto tickets = backend::replayTrace(path, **stream);
    ASSERT_TRUE(tickets.ok()) << tickets.error().message;
    bool found = false;
    for (backend::Ticket ticket : *tickets) {
        auto bytes = (*stream)->waitReadback(ticket);
        found = found || (bytes.ok() && *bytes == recorded);
    }
    EXPECT_TRUE(found) << "the read-back of the replay equals that of the recording";
    std::filesystem::remove(path);
    std::filesystem::remove(path.string() + ".bin");
}

INSTANTIATE_TEST_SUITE_P(BothApis, EngineTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST(EngineCreate, SaysWhichDevicesThereAreWhenTheRequiredOneIsMissing) {
    for (Backend backend : test::kBothApis) {
        const auto engine = Engine::create({ .backend = backend, .requireDevice = "no such device" });
        ASSERT_FALSE(engine);
        EXPECT_EQ(engine.error().code, ErrorCode::DeviceUnavailable);
        EXPECT_NE(engine.error().message.find("llvmpipe"), std::string::npos) << engine.error().message;
    }
}

/// tests/backend/create/SelfTestTest.cpp has what the test finds.
TEST(EngineCreate, TestsADriverOnceAndNotesThatItPassed) {
    for (Backend backend : test::kBothApis) {
        const std::filesystem::path folder = test::folderOfThisTest() / toString(backend);
        std::filesystem::remove_all(folder);
        const std::filesystem::path notes = folder / "tested-drivers";
        for (const bool isTested : { false, true }) {
            auto engine = Engine::create({ .backend = backend,
                                           .workers = 0,
                                           .validation = true,
                                           .cacheDirectory = folder,
                                           .driverSelfTest = isTested });
            ASSERT_TRUE(engine) << engine.error().message;
            EXPECT_EQ(std::filesystem::exists(notes), isTested) << toString(backend);
            EXPECT_EQ(engine->statistics().draws, 0u);
            test::expectNoErrors(*engine);
        }
    }
}

TEST(EngineTrace, TellsWhatEveryThreadDidInValidJson) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "engine-jobs.json";
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 1, .traceJobs = true });
    ASSERT_TRUE(engine);
    Spheres spheres(*engine);
    Renderer renderer(*engine);
    for (int frame = 0; frame < 3; ++frame) ASSERT_TRUE(renderer.renderToImage(spheres.scene, spheres.view));
    (void)renderer.takeTimings();
    ASSERT_TRUE(engine->writeJobTrace(file));
    std::ifstream stream(file);
    const auto json = nlohmann::json::parse(stream);
    std::map<std::string, int> spans;
    for (auto const& event : json.at("traceEvents")) {
        if (event.at("ph") == "X") ++spans[event.at("name")];
    }
    for (const char* name : { "prepare frame", "wait for driver", "record frame", "replay frame" })
        EXPECT_EQ(spans[name], 3) << name;
    EXPECT_GT(spans["cull"], 0);
}

TEST(EngineTrace, IsRefusedWhereItWasNotAskedFor) {
    auto engine = Engine::create({ .backend = Backend::Null });
    ASSERT_TRUE(engine);
    const Result<void> written = engine->writeJobTrace("unused.json");
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message.find("traceJobs"), std::string::npos) << written.error().message;
}

Result<Engine> tracedEngine(bool traces) {
    return Engine::create({ .backend = Backend::Null, .workers = 1, .traceJobs = traces });
}

void drawFrames(Engine& engine, int frames) {
    Scene scene(engine);
    Renderer renderer(engine);
    for (int i = 0; i < frames; ++i) ASSERT_TRUE(renderer.renderToImage(scene, View{ .size = { 8, 8 } }));
    (void)renderer.takeTimings(); // of the last replay
}

TEST(JobTimeline, HasThePhasesOfEveryFrameInItsOrder) {
    auto engine = tracedEngine(true);
    ASSERT_TRUE(engine);
    drawFrames(*engine, 3);
    std::map<std::string, std::vector<JobSpan>> spans;
    for (JobTrack const& track : jobTimeline(*engine, 1e9)) {
        EXPECT_FALSE(track.spans.empty()) << track.name;
        for (JobSpan const& span : track.spans) {
            EXPECT_LE(span.beginSeconds, span.endSeconds);
            if (span.frame >= 0) spans[track.name + ": " + span.name].push_back(span);
        }
    }
    for (const char* name : { "app thread: prepare frame", "app thread: wait for driver", "app thread: record frame",
                              "driver thread: replay frame" })
        EXPECT_EQ(spans[name].size(), 3u) << name;
    for (size_t i = 0; i < 3; ++i) {
        JobSpan const& record = spans["app thread: record frame"].at(i);
        JobSpan const& replay = spans["driver thread: replay frame"].at(i);
        EXPECT_EQ(record.frame, replay.frame);
        EXPECT_LE(record.beginSeconds, replay.beginSeconds) << "the same clock for both threads";
        EXPECT_EQ(record.kind, JobSpan::Kind::Phase);
    }
}

TEST(JobTimeline, KeepsWhatEndedLately) {
    auto engine = tracedEngine(true);
    ASSERT_TRUE(engine);
    drawFrames(*engine, 3);
    double newest = 0;
    for (JobTrack const& track : jobTimeline(*engine, 1e9))
        for (JobSpan const& span : track.spans) newest = std::max(newest, span.endSeconds);
    size_t kept = 0;
    for (JobTrack const& track : jobTimeline(*engine, 0))
        for (JobSpan const& span : track.spans) {
            EXPECT_NEAR(span.endSeconds, newest, 1e-9);
            ++kept;
        }
    EXPECT_EQ(kept, 1u);
}

TEST(JobTimeline, KnowsNothingOfAnEngineWithoutATrace) {
    auto engine = tracedEngine(false);
    ASSERT_TRUE(engine);
    drawFrames(*engine, 1);
    EXPECT_TRUE(jobTimeline(*engine, 1e9).empty());
}

TEST(JobTimeline, IsReadByOtherThreadsWhileFramesAreDrawn) {
    auto engine = tracedEngine(true);
    ASSERT_TRUE(engine);
    size_t tracks = 0;
    std::thread reader([&] {
        for (int i = 0; i < 50; ++i) tracks = std::max(tracks, jobTimeline(*engine, 1).size());
    });
    drawFrames(*engine, 20);
    reader.join();
    EXPECT_GE(jobTimeline(*engine, 1e9).size(), 2u);
}

TEST(EngineCreate, SaysWhatShadersThatAreNotExactNeed) {
    const auto engine = Engine::create({ .backend = Backend::Null, .exactShaders = false });
    ASSERT_FALSE(engine);
    EXPECT_EQ(engine.error().code, ErrorCode::Unsupported);
    EXPECT_NE(engine.error().message.find("EngineDebug::plainMaterials"), std::string::npos) << engine.error().message;
}

TEST(EngineCreate, ListsBothApis) {
    bool vulkan = false, gles = false;
    for (DeviceDescription const& device : listDevices()) {
        vulkan = vulkan || device.backend == Backend::Vulkan;
        gles = gles || device.backend == Backend::Gles;
    }
    EXPECT_TRUE(vulkan);
    EXPECT_TRUE(gles);
}

} // namespace
} // namespace filament_core
