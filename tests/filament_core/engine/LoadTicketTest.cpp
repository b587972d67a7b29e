// SPDX-License-Identifier: Apache-2.0
// Models and environments that load beside frames: the same bits as at once, cancelled at every stage, without a trace.
#include "filament_core/assets/image/ImageWriter.h"
#include "filament_core/engine/EngineImpl.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <gmock/gmock.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <span>
#include <stdexcept>
#include <thread>

namespace filament_core {
namespace {

using testing::HasSubstr;

using FileBytes = std::vector<std::byte>;

FileBytes bytesOfText(std::string_view text) {
    auto const* first = reinterpret_cast<const std::byte*>(text.data());
    return { first, first + text.size() };
}

FileBytes bytesAt(std::filesystem::path const& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    return bytesOfText(text);
}

/// Three textured triangles side by side, in files that their .gltf names: three images, three meshes, six steps and
/// one.
constexpr const char* kTriangles = R"({ "asset": { "version": "2.0" }, "scenes": [ { "nodes": [ 0, 1, 2 ] } ],
    "extensionsUsed": [ "KHR_materials_unlit" ],
    "nodes": [ { "mesh": 0 }, { "mesh": 1, "translation": [ 1, 0, 0 ] }, { "mesh": 2, "translation": [ 2, 0, 0 ] } ],
    "images": [ { "uri": "picture%200.png" }, { "uri": "picture%201.png" }, { "uri": "picture%202.png" } ],
    "textures": [ { "source": 0 }, { "source": 1 }, { "source": 2 } ],
    "materials": [
        { "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } }, "extensions": { "KHR_materials_unlit": {} } },
        { "pbrMetallicRoughness": { "baseColorTexture": { "index": 1 } }, "extensions": { "KHR_materials_unlit": {} } },
        { "pbrMetallicRoughness": { "baseColorTexture": { "index": 2 } }, "extensions": { "KHR_materials_unlit": {} } } ],
    "meshes": [
        { "primitives": [ { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 } ] },
        { "primitives": [ { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 1 } ] },
        { "primitives": [ { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 2 } ] } ],
    "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
        { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" } ],
    "bufferViews": [ { "buffer": 0, "byteLength": 36 }, { "buffer": 0, "byteOffset": 36, "byteLength": 24 } ],
    "buffers": [ { "uri": "triangle.bin", "byteLength": 60 } ] })";
constexpr size_t kTriangleSteps = 7;

/// The files of kTriangles and a small sky, in a folder of the test.
class LoadTicketFiles {
public:
    LoadTicketFiles() : folder(test::folderOfThisTest()) {
        const std::array<float, 15> triangle{ 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 1, 0, 0 };
        write("triangle.bin", std::as_bytes(std::span(triangle)));
        write("triangles.gltf", bytesOfText(kTriangles));
        for (uint32_t i = 0; i < 3; ++i) {
            Image picture{ .width = 16, .height = 16, .pixels = FileBytes(16 * 16 * 4, std::byte{ 255 }) };
            for (size_t p = 0; p < picture.pixels.size(); ++p)
                picture.pixels[p] = p % 4 == 3 ? std::byte{ 255 } : static_cast<std::byte>(p * (37 + i) % 251);
            EXPECT_TRUE(savePng(folder / ("picture " + std::to_string(i) + ".png"), picture));
        }
        assets::HdrImage sky{ .width = 32, .height = 16, .pixels = std::vector<float3>(32 * 16), .repairs = {} };
        for (size_t i = 0; i < sky.pixels.size(); ++i) sky.pixels[i] = float3(static_cast<float>(i % 7)) + 0.25f;
        EXPECT_TRUE(assets::writeHdr(folder / "sky.hdr", sky));
    }

    std::filesystem::path model() const { return folder / "triangles.gltf"; }
    std::filesystem::path sky() const { return folder / "sky.hdr"; }

    Result<FileBytes> resolve(std::string_view uri) const {
        const std::filesystem::path file = folder / uri;
        if (!std::filesystem::exists(file)) return Error{ ErrorCode::NotFound, "nobody knows " + std::string(uri) };
        return bytesAt(file);
    }

    std::filesystem::path folder;

private:
    void write(const char* name, std::span<const std::byte> bytes) const {
        std::ofstream(folder / name, std::ios::binary)
                .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
};

/// Holds background threads until it is opened.
class Gate {
public:
    void pass() {
        std::unique_lock lock(mMutex);
        ++mArrived;
        mChanged.notify_all();
        mChanged.wait(lock, [&] { return mIsOpen; });
    }
    void waitForArrival() {
        std::unique_lock lock(mMutex);
        mChanged.wait(lock, [&] { return mArrived > 0; });
    }
    void open() {
        const std::scoped_lock lock(mMutex);
        mIsOpen = true;
        mChanged.notify_all();
    }

private:
    std::mutex mMutex;
    std::condition_variable mChanged;
    int mArrived = 0;
    bool mIsOpen = false;
};

/// Everything that the tables of an engine hold.
size_t objectsOf(Engine& engine) {
    size_t count = 0;
    const auto add = [&](auto const& table) { table.forEach([&](auto const&) { ++count; }); };
    Engine::Impl& impl = engine.impl();
    add(impl.textures), add(impl.vertexBuffers), add(impl.indexBuffers), add(impl.materials), add(impl.instances);
    add(impl.morphTargets), add(impl.indirectLights), add(impl.skyboxes), add(impl.lightProfiles);
    add(impl.lightImages);
    return count;
}

template <class T>
void pollToTheEnd(LoadTicket<T>& ticket) {
    while (!ticket.poll().isFinished()) std::this_thread::yield();
}

template <class T>
void waitForStage(LoadTicket<T>& ticket, LoadStage stage) {
    while (ticket.status().stage < stage) std::this_thread::yield();
}

Image pictureOf(Engine& engine, Model const& model, Environment const* light = nullptr) {
    Scene scene(engine);
    scene.add(model);
    if (light) scene.setEnvironment(*light);
    const Box bounds = model.bounds();
    const double3 center = (bounds.min + bounds.max) * 0.5;
    const double size = glm::length(bounds.max - bounds.min);
    const View view{ .camera = Camera::lookAt(center + double3(0.2, 0.1, 1) * size, center), .size = { 96, 64 } };
    return test::renderLinear(engine, scene, view);
}

std::optional<Engine> nullEngine(int workers = 2) { return test::makeEngine(Backend::Null, workers); }

/// One that has made already what it makes for the first model, and keeps.
std::optional<Engine> warmEngine(LoadTicketFiles const& files, int workers) {
    std::optional<Engine> engine = nullEngine(workers);
    EXPECT_TRUE(loadGltf(*engine, files.model()));
    return engine;
}

// ---------------------------------------------------------------------------------------------- the same result

class LoadTicketBits : public testing::TestWithParam<Backend> {};

TEST_P(LoadTicketBits, AModelThatLoadsBesideFramesHasTheBitsOfOneLoadedAtOnce) {
    LoadTicketFiles files;
    std::optional<Engine> engine = test::makeEngine(GetParam(), 2);
    ASSERT_TRUE(engine);
    const Result<Model> atOnce = loadGltf(*engine, files.model());
    ASSERT_TRUE(atOnce) << atOnce.error().message;
    LoadTicket<Model> ticket = loadGltfAsync(*engine, files.model());
    pollToTheEnd(ticket);
    const Result<Model> later = ticket.take();
    ASSERT_TRUE(later) << later.error().message;
    const FileBytes bytes = bytesAt(files.model());
    const GltfMemory memory{ .file = bytes, .name = "triangles.gltf", .resolve = [&](std::string_view uri) {
                                return files.resolve(uri);
                            } };
    const Result<Model> fromMemory = loadGltf(*engine, memory), fromMemoryLater = loadGltfAsync(*engine, memory).wait();
    ASSERT_TRUE(fromMemory && fromMemoryLater);
    const Image expected = pictureOf(*engine, *atOnce);
    EXPECT_GT(test::extremesOf(expected).most, 0.1f);
    for (const Model* model : { &*later, &*fromMemory, &*fromMemoryLater }) {
        EXPECT_EQ(model->name(), "triangles.gltf");
        EXPECT_EQ(test::differingPixels(pictureOf(*engine, *model), expected), 0u);
    }
    test::expectNoErrors(*engine);
}

TEST_P(LoadTicketBits, AnEnvironmentThatLoadsBesideFramesHasTheBitsOfOneLoadedAtOnce) {
    LoadTicketFiles files;
    std::optional<Engine> engine = test::makeEngine(GetParam(), 2);
    ASSERT_TRUE(engine);
    const EnvironmentLoadOptions options{ .faceSize = 16, .samples = 16 };
    const FileBytes bytes = bytesAt(files.sky());
    Result<Environment> skies[] = { loadEnvironment(*engine, files.sky(), options),
                                    loadEnvironmentAsync(*engine, files.sky(), options).wait(),
                                    loadEnvironment(*engine, bytes, "sky", options),
                                    loadEnvironmentAsync(*engine, bytes, "sky", options).wait() };
    const Result<Model> model = loadGltf(*engine, files.model());
    ASSERT_TRUE(model);
    std::vector<Image> pictures;
    for (Result<Environment> const& sky : skies) {
        ASSERT_TRUE(sky) << sky.error().message;
        pictures.push_back(pictureOf(*engine, *model, &*sky));
        EXPECT_EQ(test::differingPixels(pictures.front(), pictures.back()), 0u);
    }
    EXPECT_GT(test::extremesOf(pictures[0]).least, 0) << "the sky is seen";
    test::expectNoErrors(*engine);
}

INSTANTIATE_TEST_SUITE_P(BothApis, LoadTicketBits, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

using LoadTicketAssets = test::AssetTest;

TEST_F(LoadTicketAssets, ForeignModelsFromMemoryBesideFramesHaveTheBitsOfTheirFiles) {
    std::optional<Engine> engine = test::makeEngine(Backend::Vulkan, 2);
    ASSERT_TRUE(engine);
    for (const char* name : { "Fox/Fox.glb", "BoxMeshopt/BoxMeshopt.glb", "AnimatedMorphCube/AnimatedMorphCube.glb",
                              "LightsPunctualLamp/LightsPunctualLamp.gltf", "Box-Draco/Box.gltf" }) {
        SCOPED_TRACE(name);
        const std::filesystem::path path = tools::assetDir() / "models" / name;
        const FileBytes bytes = bytesAt(path);
        const auto resolve = [&](std::string_view uri) -> Result<FileBytes> {
            return bytesAt(path.parent_path() / uri);
        };
        const Result<Model> atOnce = loadGltf(*engine, path);
        LoadTicket<Model> ticket = loadGltfAsync(
                *engine, GltfMemory{ .file = bytes, .name = path.filename().string(), .resolve = resolve });
        const Result<Model> later = ticket.wait();
        ASSERT_TRUE(atOnce && later) << later.error().message;
        EXPECT_EQ(later->renderableCount(), atOnce->renderableCount());
        EXPECT_EQ(later->animationCount(), atOnce->animationCount());
        EXPECT_EQ(later->warnings(), atOnce->warnings());
        EXPECT_EQ(later->bounds().max, atOnce->bounds().max);
        EXPECT_EQ(test::differingPixels(pictureOf(*engine, *later), pictureOf(*engine, *atOnce)), 0u);
    }
    test::expectNoErrors(*engine);
}

// ---------------------------------------------------------------------------------------------- progress and slices

TEST(LoadTicket, EachPollCreatesASliceOfAtLeastOneObject) {
    LoadTicketFiles files;
    std::optional<Engine> engine = nullEngine();
    LoadTicket<Model> ticket = loadGltfAsync(*engine, files.model());
    waitForStage(ticket, LoadStage::Creating);
    for (size_t i = 1; i < kTriangleSteps; ++i) {
        const LoadStatus status = ticket.poll(1);
        EXPECT_EQ(status.stage, LoadStage::Creating);
        EXPECT_EQ(status.done, i);
        EXPECT_EQ(status.total, kTriangleSteps);
        EXPECT_FALSE(ticket.take()) << "it is not finished";
    }
    EXPECT_EQ(ticket.poll(1).stage, LoadStage::Ready);
    EXPECT_EQ(ticket.poll(1).stage, LoadStage::Ready);
    EXPECT_TRUE(ticket.take());
    const Result<Model> again = ticket.take();
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(again.error().message, "the result of this load was taken already");
    LoadTicket<Model> inOneSlice = loadGltfAsync(*engine, files.model());
    waitForStage(inOneSlice, LoadStage::Creating);
    EXPECT_EQ(inOneSlice.poll().stage, LoadStage::Ready);
}

TEST(LoadTicket, ProgressOnlyGrows) {
    LoadTicketFiles files;
    std::optional<Engine> engine = nullEngine();
    std::vector<std::pair<std::string, size_t>> told;
    GltfLoadOptions options;
    options.progress = [&](std::string_view stage, size_t done, size_t) { told.emplace_back(stage, done); };
    LoadTicket<Model> ticket = loadGltfAsync(*engine, files.model(), options);
    LoadStage stage = LoadStage::Waiting;
    for (LoadStatus status = ticket.status(); !status.isFinished(); status = ticket.poll(1)) {
        EXPECT_GE(status.stage, stage);
        stage = status.stage;
    }
    ASSERT_TRUE(ticket.take());
    ASSERT_EQ(told.size(), 2u + kTriangleSteps) << "reading: 0 and 1 of 1; decoding: 0 to 6 of 6";
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(told[i], std::pair(std::string("reading"), i));
    for (size_t i = 0; i < kTriangleSteps; ++i) EXPECT_EQ(told[2 + i], std::pair(std::string("decoding"), i));
}

TEST(LoadTicket, StagesHaveNames) {
    std::vector<std::string> names;
    for (int i = 0; i <= static_cast<int>(LoadStage::Cancelled); ++i)
        names.emplace_back(toString(static_cast<LoadStage>(i)));
    EXPECT_THAT(names, testing::ElementsAre("waiting", "decoding", "creating", "ready", "failed", "cancelled"));
}

TEST(LoadTicket, WithoutWorkersTheCallDecodes) {
    LoadTicketFiles files;
    std::optional<Engine> engine = nullEngine(0);
    LoadTicket<Model> ticket = loadGltfAsync(*engine, files.model());
    EXPECT_EQ(ticket.status().stage, LoadStage::Creating);
    EXPECT_TRUE(ticket.wait());
}

// ---------------------------------------------------------------------------------------------- the end at any stage

/// A load that was brought to a stage and stays there.
struct HeldLoad {
    std::shared_ptr<Gate> gate = std::make_shared<Gate>(); // background threads may be in it a little longer
    std::optional<LoadTicket<Model>> blocker, ticket;

    HeldLoad(Engine& engine, LoadTicketFiles const& files, LoadStage stage, size_t steps = 0) {
        const FileBytes bytes = bytesAt(files.model());
        const auto held = [&files, stage, passed = gate](std::string_view uri) {
            if (stage <= LoadStage::Decoding) passed->pass();
            return files.resolve(uri);
        };
        const GltfMemory memory{ .file = bytes, .resolve = held };
        if (stage == LoadStage::Waiting) { // one background thread, which the blocker has
            blocker.emplace(loadGltfAsync(engine, memory));
            gate->waitForArrival();
        }
        ticket.emplace(loadGltfAsync(engine, memory));
        if (stage == LoadStage::Decoding) gate->waitForArrival();
        if (stage >= LoadStage::Creating) waitForStage(*ticket, LoadStage::Creating);
        for (size_t i = 0; i < steps; ++i) ticket->poll(1);
        EXPECT_EQ(ticket->status().stage, stage);
    }
    HeldLoad(HeldLoad const&) = delete;
    HeldLoad& operator=(HeldLoad const&) = delete;
    ~HeldLoad() { gate->open(); }
};

/// The stages of a load, and the objects that it has created there.
struct Moment {
    LoadStage stage;
    size_t steps = 0;
};
std::vector<Moment> everyMoment() {
    std::vector<Moment> moments{ { LoadStage::Waiting }, { LoadStage::Decoding } };
    for (size_t i = 0; i < kTriangleSteps; ++i) moments.push_back({ LoadStage::Creating, i });
    return moments;
}

TEST(LoadTicket, CancelledAtAnyMomentItLeavesNothing) {
    LoadTicketFiles files;
    for (const Moment moment : everyMoment()) {
        SCOPED_TRACE(std::string(toString(moment.stage)) + ' ' + std::to_string(moment.steps));
        std::optional<Engine> engine = warmEngine(files, 1);
        const size_t before = objectsOf(*engine);
        HeldLoad load(*engine, files, moment.stage, moment.steps);
        EXPECT_EQ(objectsOf(*engine) > before, moment.steps > 0);
        load.ticket->cancel();
        EXPECT_EQ(objectsOf(*engine), before);
        EXPECT_EQ(load.ticket->poll().stage, LoadStage::Cancelled);
        const Result<Model> none = load.ticket->take();
        ASSERT_FALSE(none);
        EXPECT_EQ(none.error().code, ErrorCode::Cancelled);
        EXPECT_EQ(none.error().message, "loading 'model' was cancelled, or its engine ended");
        load.ticket->cancel();
        load.gate->open();
        EXPECT_FALSE(load.ticket->wait()) << "waits for nothing";
    }
}

TEST(LoadTicket, CancelDoesNothingToWhatIsFinished) {
    LoadTicketFiles files;
    std::optional<Engine> engine = nullEngine();
    LoadTicket<Model> ticket = loadGltfAsync(*engine, files.model());
    pollToTheEnd(ticket);
    ticket.cancel();
    EXPECT_EQ(ticket.status().stage, LoadStage::Ready);
    EXPECT_TRUE(ticket.take());
}

TEST(LoadTicket, ATicketThatEndsAtAnyMomentLeavesNothing) {
    LoadTicketFiles files;
    for (const Moment moment : everyMoment()) {
        std::optional<Engine> engine = warmEngine(files, 1);
        const size_t before = objectsOf(*engine);
        HeldLoad load(*engine, files, moment.stage, moment.steps);
        load.ticket.reset();
        EXPECT_EQ(objectsOf(*engine), before);
    }
    std::optional<Engine> engine = warmEngine(files, 1);
    const size_t before = objectsOf(*engine);
    {
        LoadTicket<Model> ready = loadGltfAsync(*engine, files.model());
        pollToTheEnd(ready);
        EXPECT_GT(objectsOf(*engine), before);
    }
    EXPECT_EQ(objectsOf(*engine), before) << "a result that nobody took";
}

TEST(LoadTicket, AnEngineThatEndsAtAnyMomentEndsItsLoads) {
    LoadTicketFiles files;
    std::vector<Moment> moments = everyMoment();
    moments.push_back({ LoadStage::Ready, kTriangleSteps });
    for (const Moment moment : moments) {
        SCOPED_TRACE(std::string(toString(moment.stage)) + ' ' + std::to_string(moment.steps));
        std::optional<Engine> engine = nullEngine(1);
        HeldLoad load(*engine, files, moment.stage, moment.steps);
        std::thread opener; // the engine waits for the callback that is held
        if (moment.stage <= LoadStage::Decoding) {
            opener = std::thread([&] {
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                load.gate->open();
            });
        }
        engine.reset();
        if (opener.joinable()) opener.join();
        EXPECT_EQ(load.ticket->poll().stage, LoadStage::Cancelled);
        load.ticket->cancel();
        EXPECT_EQ(load.ticket->take().error().code, ErrorCode::Cancelled);
        EXPECT_EQ(load.ticket->wait().error().code, ErrorCode::Cancelled);
    }
}

TEST(LoadTicket, MovingItCancelsWhatItHeldBefore) {
    LoadTicketFiles files;
    std::optional<Engine> engine = warmEngine(files, 1);
    const size_t before = objectsOf(*engine);
    LoadTicket<Model> first = loadGltfAsync(*engine, files.model());
    waitForStage(first, LoadStage::Creating);
    first.poll(1);
    first = loadGltfAsync(*engine, files.model());
    EXPECT_EQ(objectsOf(*engine), before);
    LoadTicket<Model> second(std::move(first));
    EXPECT_TRUE(second.wait());
}

TEST(LoadTicketDeathTest, BelongsToItsThread) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    LoadTicketFiles files;
    EXPECT_DEATH(
            {
                std::optional<Engine> engine = nullEngine(0);
                LoadTicket<Model> ticket = loadGltfAsync(*engine, files.model());
                std::thread([&] { ticket.poll(); }).join();
            },
            "LoadTicket::poll\\(size_t\\): called on another thread than the engine's");
}

// ---------------------------------------------------------------------------------------------- many, and broken ones

TEST(LoadTicket, ManyAtOnceArriveWhateverBecomesOfTheOthers) {
    LoadTicketFiles files;
    std::optional<Engine> engine = warmEngine(files, 3);
    const size_t before = objectsOf(*engine);
    std::vector<LoadTicket<Model>> models;
    std::vector<LoadTicket<Environment>> skies;
    for (int i = 0; i < 24; ++i) {
        models.push_back(loadGltfAsync(*engine, i % 5 == 3 ? files.folder / "none.gltf" : files.model()));
        if (i % 4 == 0) skies.push_back(loadEnvironmentAsync(*engine, files.sky(), { .faceSize = 16, .samples = 4 }));
    }
    for (size_t i = 2; i < models.size(); i += 5) models[i].cancel();
    for (bool isBusy = true; isBusy;) {
        isBusy = false;
        for (LoadTicket<Model>& ticket : models) isBusy |= !ticket.poll(1).isFinished();
        for (LoadTicket<Environment>& ticket : skies) isBusy |= !ticket.poll(1).isFinished();
        std::this_thread::yield();
    }
    for (size_t i = 0; i < models.size(); ++i) {
        const LoadStage stage = models[i].status().stage;
        EXPECT_EQ(stage, i % 5 == 2 ? LoadStage::Cancelled : i % 5 == 3 ? LoadStage::Failed : LoadStage::Ready) << i;
        const Result<Model> model = models[i].take();
        EXPECT_EQ(model ? model->renderableCount() : 3u, 3u);
    }
    for (LoadTicket<Environment>& ticket : skies) EXPECT_TRUE(ticket.take());
    models.clear();
    skies.clear();
    EXPECT_EQ(objectsOf(*engine), before);
}

TEST(LoadTicket, BrokenFilesSayTheSameAsAtOnce) {
    LoadTicketFiles files;
    std::optional<Engine> engine = nullEngine();
    const std::string text(kTriangles);
    for (size_t length = 0; length < text.size(); length += 97) {
        const FileBytes cut = bytesOfText(std::string_view(text).substr(0, length));
        const GltfMemory memory{ .file = cut, .name = "cut" };
        const Result<Model> atOnce = loadGltf(*engine, memory), later = loadGltfAsync(*engine, memory).wait();
        ASSERT_FALSE(atOnce);
        ASSERT_FALSE(later);
        EXPECT_EQ(atOnce.error().message, later.error().message);
        EXPECT_EQ(atOnce.error().code, later.error().code);
    }
    FileBytes sky = bytesAt(files.sky());
    sky.resize(sky.size() / 2);
    const Result<Environment> atOnce = loadEnvironment(*engine, sky, "half"),
                              later = loadEnvironmentAsync(*engine, sky, "half").wait();
    ASSERT_FALSE(atOnce);
    ASSERT_FALSE(later);
    EXPECT_THAT(atOnce.error().message, HasSubstr("half"));
    EXPECT_EQ(atOnce.error().message, later.error().message);
    EXPECT_EQ(loadEnvironmentAsync(*engine, files.folder / "none.hdr").wait().error().code, ErrorCode::NotFound);
    EXPECT_EQ(loadEnvironmentAsync(*engine, files.sky(), { .faceSize = 17 }).wait().error().code,
              ErrorCode::InvalidArgument);
    EXPECT_EQ(loadGltfAsync(*engine, std::filesystem::path()).wait().error().code, ErrorCode::NotFound);
}

TEST(GltfMemory, WhatAFileNamesComesFromTheCaller) {
    LoadTicketFiles files;
    std::optional<Engine> engine = nullEngine();
    const FileBytes bytes = bytesAt(files.model());
    EXPECT_EQ(loadGltf(*engine, GltfMemory{ .file = bytes, .name = "alone" }).error().message,
              "alone: buffers[0]: 'triangle.bin' is not in the file; give its bytes by GltfMemory::resolve");
    std::mutex mutex;
    std::map<std::string, int> asked;
    const auto resolve = [&](std::string_view uri) {
        const std::scoped_lock lock(mutex);
        ++asked[std::string(uri)];
        return files.resolve(uri);
    };
    ASSERT_TRUE(loadGltf(*engine, GltfMemory{ .file = bytes, .resolve = resolve }));
    EXPECT_EQ(asked,
              (std::map<std::string, int>{
                      { "triangle.bin", 1 }, { "picture 0.png", 1 }, { "picture 1.png", 1 }, { "picture 2.png", 1 } }));
    std::filesystem::remove(files.folder / "picture 1.png");
    EXPECT_EQ(loadGltf(*engine, GltfMemory{ .file = bytes, .resolve = resolve }).error().message,
              "model: images[1]: nobody knows picture 1.png");
}

TEST(GltfMemory, AResolverThatThrowsIsAnError) {
    LoadTicketFiles files;
    std::optional<Engine> engine = nullEngine();
    const FileBytes bytes = bytesAt(files.model());
    const auto resolve = [&](std::string_view uri) -> Result<FileBytes> {
        if (uri == "picture 2.png") throw std::runtime_error("the cupboard is bare");
        return files.resolve(uri);
    };
    const GltfMemory memory{ .file = bytes, .resolve = resolve };
    EXPECT_THAT(loadGltf(*engine, memory).error().message, HasSubstr("the cupboard is bare"));
    EXPECT_THAT(loadGltfAsync(*engine, memory).wait().error().message, HasSubstr("the cupboard is bare"));
}

} // namespace
} // namespace filament_core
