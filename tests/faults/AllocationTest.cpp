// SPDX-License-Identifier: Apache-2.0
// Host memory runs out at every allocation: making an engine, the first and a later frame, loading a model, and
// destroying it all; on the null backend. <build>/faults/*.txt lists what failed where.
#include "tests/faults/AllocationSweep.h"
#include "tests/faults/FaultStage.h"

#include "base/math/Half.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "filament_core/engine/EngineImpl.h"

#include <array>
#include <filesystem>
#include <fstream>

namespace filament_core::test {
namespace {

void expectEachNamesMemory(std::vector<std::string> const& errors) {
    for (std::string const& error : errors) EXPECT_TRUE(contains(error, "memory")) << error;
}

/// An error must be OutOfMemory or DeviceLost, or a read-back without pixels whose reason takeErrors() gives.
void expectNamed(Result<void> const& outcome, std::vector<std::string> const& errors) {
    if (outcome.ok()) return;
    const ErrorCode code = outcome.error().code;
    EXPECT_TRUE(code == ErrorCode::OutOfMemory || code == ErrorCode::DeviceLost || code == ErrorCode::DeviceUnavailable)
            << outcome.error().message;
    EXPECT_TRUE(code == ErrorCode::OutOfMemory || !errors.empty()) << outcome.error().message;
}

/// Draws a frame once memory is available again: the image, or the report of a lost device, must be the same twice.
void expectSoundFrames(Engine& engine, FaultStage& stage, uint64_t expectedPacket, Result<void> const& outcome) {
    for (int i = 0; i < 2; ++i) {
        const Result<Image> image = stage.draw();
        if (!image) {
            EXPECT_EQ(image.error().code, ErrorCode::DeviceLost) << image.error().message;
            EXPECT_FALSE(stage.draw().ok()) << "a lost device came back";
            break;
        }
        EXPECT_EQ(image->pixels.size(), size_t{ 32 } * 32 * 4);
        EXPECT_EQ(stage.packetHash(), expectedPacket) << "frame " << i << " is not the undisturbed one";
        EXPECT_EQ(stage.renderer().statistics().passesRun, 2u);
    }
    engine.waitIdle();
    const std::vector<std::string> errors = engine.takeErrors();
    expectEachNamesMemory(errors); // no rule of the command stream may be broken
    expectNamed(outcome, errors);
}

uint64_t undisturbedPacket(StageOptions const& options) {
    auto engine = makeEngine(options);
    FaultStage stage(*engine, options);
    stage.move();
    EXPECT_TRUE(stage.draw().ok());
    return stage.packetHash();
}

/// Making an engine.
class MakesEngine final : public Scenario {
public:
    explicit MakesEngine(StageOptions const& options, uint64_t packet)
            : mOptions(options), mEngineOptions(engineOptions(options)), mPacket(packet) {}

    Result<void> act() override {
        auto engine = Engine::create(mEngineOptions);
        if (!engine) return engine.error();
        mEngine.emplace(std::move(*engine));
        return {};
    }

    void expectSound(Result<void> const& outcome) override {
        if (!outcome.ok()) {
            EXPECT_TRUE(contains(outcome.error().message, "memory")) << outcome.error().message;
            return;
        }
        FaultStage stage(*mEngine, mOptions);
        stage.move();
        expectSoundFrames(*mEngine, stage, mPacket, outcome);
    }

private:
    const StageOptions mOptions;
    const EngineOptions mEngineOptions;
    const uint64_t mPacket;
    std::optional<Engine> mEngine;
};

/// The first or a later frame, with its pixels.
class Draws final : public Scenario {
public:
    Draws(StageOptions const& options, uint64_t packet, int framesBefore)
            : mPacket(packet), mEngine(makeEngine(options)), mStage(*mEngine, options) {
        for (int i = 0; i < framesBefore; ++i) EXPECT_TRUE(mStage.draw().ok());
        mStage.move();
    }

    Result<void> act() override {
        const Result<Image> image = mStage.draw();
        return image.ok() ? Result<void>{} : image.error();
    }

    void expectSound(Result<void> const& outcome) override { expectSoundFrames(*mEngine, mStage, mPacket, outcome); }

private:
    const uint64_t mPacket;
    Result<Engine> mEngine;
    FaultStage mStage;
};

/// Destroying a renderer, what it drew, and the engine.
class Ends final : public Scenario {
public:
    explicit Ends(StageOptions const& options) : mEngine(std::move(*makeEngine(options))) {
        mStage.emplace(*mEngine, options);
        EXPECT_TRUE(mStage->draw().ok());
    }
    Result<void> act() override {
        mStage.reset();
        mEngine.reset();
        return {};
    }
    void expectSound(Result<void> const&) override {}

private:
    std::optional<Engine> mEngine;
    std::optional<FaultStage> mStage;
};

// ---------------------------------------------------------------------------------------------- a model

/// Two triangles with a texture, a light, two materials and a sky.
std::filesystem::path modelFile() {
    const std::filesystem::path path = faultFolder() / "model.glb";
    std::filesystem::create_directories(path.parent_path());
    assets::GlbScene scene;
    const std::vector<std::byte> pixels(4 * 4 * 4, std::byte{ 0x80 });
    scene.images.push_back(*assets::glbImageFromPixels("grey", 4, 4, pixels));
    scene.materials.resize(2);
    scene.materials[0].baseColor.image = 0;
    scene.materials[1].metallicFactor = 0;
    for (uint32_t material = 0; material < 2; ++material) {
        assets::GlbPrimitive triangle;
        triangle.positions = { float3(0, 0, 0), float3(1, 0, 0), float3(0, 1, 0) };
        triangle.uvs = { float2(0, 0), float2(1, 0), float2(0, 1) };
        triangle.material = material;
        scene.meshes.push_back({ "triangle", { triangle } });
        scene.nodes.push_back({ .name = "node", .mesh = material });
    }
    scene.lights.push_back({});
    scene.nodes.push_back({ .name = "lamp", .light = 0 });
    assets::CubeLight sky;
    sky.levels = { assets::IblCubeLevel(2), assets::IblCubeLevel(1) };
    sky.worldFromCube[2].z = -1;
    scene.imageBasedLight = *assets::glbImageBasedLight(sky, scene.images);
    const auto bytes = assets::writeGlb(scene);
    EXPECT_TRUE(bytes.ok());
    std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
    return path;
}

class LoadsModel final : public Scenario {
public:
    LoadsModel(StageOptions const& options, std::filesystem::path file)
            : mFile(std::move(file)), mEngine(makeEngine(options)) {}

    Result<void> act() override {
        auto model = loadGltf(*mEngine, mFile);
        if (!model) return model.error();
        mModel.emplace(std::move(*model));
        return {};
    }

    void expectSound(Result<void> const& outcome) override {
        if (!outcome.ok()) {
            EXPECT_TRUE(contains(outcome.error().message, "memory")) << outcome.error().message;
            auto again = loadGltf(*mEngine, mFile);
            ASSERT_TRUE(again.ok()) << again.error().message;
            mModel.emplace(std::move(*again));
        }
        EXPECT_EQ(mModel->renderableCount(), 2u);
        EXPECT_TRUE(mModel->warnings().empty());
        EXPECT_TRUE(mModel->environment());
        drawIt();
    }

private:
    void drawIt() {
        Scene scene(*mEngine);
        scene.add(*mModel);
        scene.setEnvironment(*mModel->environment());
        Renderer renderer(*mEngine);
        View view{ .camera = Camera::lookAt({ 0.4, 0.4, 3 }, { 0.4, 0.4, 0 }), .size = { 32, 32 } };
        const Result<Image> image = renderer.renderToImage(scene, view);
        if (!image) {
            EXPECT_EQ(image.error().code, ErrorCode::DeviceLost) << image.error().message;
        } else {
            EXPECT_EQ(renderer.statistics().visible, 2u);
        }
        expectEachNamesMemory(mEngine->takeErrors());
    }

    const std::filesystem::path mFile;
    Result<Engine> mEngine;
    std::optional<Model> mModel; // ends before its engine
};

// ---------------------------------------------------------------------------------------------- an environment

std::filesystem::path environmentFile() {
    const std::filesystem::path path = faultFolder() / "sky.exr";
    std::filesystem::create_directories(path.parent_path());
    Image image{ .width = 8, .height = 4, .format = Format::RGBA16F, .pixels = {} };
    const uint16_t half = halfFromFloat(0.5f);
    for (uint32_t i = 0; i < 8 * 4 * 4; ++i) {
        const std::span<const std::byte> bytes = std::as_bytes(std::span(&half, 1));
        image.pixels.insert(image.pixels.end(), bytes.begin(), bytes.end());
    }
    EXPECT_TRUE(saveExr(path, image).ok());
    return path;
}

class LoadsEnvironment final : public Scenario {
public:
    LoadsEnvironment(StageOptions const& options, std::filesystem::path file)
            : mFile(std::move(file)), mEngine(makeEngine(options)) {
        std::filesystem::remove_all(faultFolder() / "cache");
    }

    Result<void> act() override {
        auto sky = loadEnvironment(*mEngine, mFile, { .faceSize = 16, .samples = 8 });
        if (!sky) return sky.error();
        mSky.emplace(std::move(*sky));
        return {};
    }

    void expectSound(Result<void> const& outcome) override {
        if (!outcome.ok()) {
            EXPECT_TRUE(contains(outcome.error().message, "memory")) << outcome.error().message;
            const Result<void> again = act();
            ASSERT_TRUE(again.ok()) << again.error().message;
        }
        FaultStage stage(*mEngine);
        stage.scene().setEnvironment(*mSky, { .illuminance = Lux{ 1000 } });
        EXPECT_TRUE(stage.draw().ok());
        expectEachNamesMemory(mEngine->takeErrors());
    }

private:
    const std::filesystem::path mFile;
    Result<Engine> mEngine;
    std::optional<Environment> mSky; // ends before its engine
};

// ---------------------------------------------------------------------------------------------- the sweeps

struct Sweeper {
    const char* name;
    StageOptions options;
    Whose whose;
    Lasting lasting = Lasting::Once;
    uint64_t stride = 1;
    uint64_t modelStride = stride; ///< of loading a model, whose two thousand allocations take long

    Sweep of(const char* scenario) const {
        return { fmt::format("{} {}", scenario, name), whose, lasting, Callers::All, stride };
    }
};

void PrintTo(Sweeper const& sweeper, std::ostream* stream) { *stream << sweeper.name; }

const StageOptions kAlone{}, kPlain{ .validation = false },
        kCrowd{ .workers = 2, .spheres = 2200, .materials = 2200 }; // more draws than one job records

class OutOfMemory : public testing::TestWithParam<Sweeper> {};
INSTANTIATE_TEST_SUITE_P(Sweeps, OutOfMemory,
                         testing::Values(Sweeper{ "app", kAlone, Whose::App, Lasting::Once, 1, 5 },
                                         Sweeper{ "driver", kAlone, Whose::Driver },
                                         Sweeper{ "plain_driver", kPlain, Whose::Driver },
                                         Sweeper{ "app_onwards", kAlone, Whose::App, Lasting::Onwards, 1, 5 },
                                         Sweeper{ "driver_onwards", kAlone, Whose::Driver, Lasting::Onwards },
                                         Sweeper{ "app_with_workers", kCrowd, Whose::App, Lasting::Once, 211 },
                                         Sweeper{ "jobs", kCrowd, Whose::Jobs }),
                         [](auto const& test) { return std::string(test.param.name); });

TEST_P(OutOfMemory, AnEngineIsMadeOrRefused) {
    const uint64_t packet = undisturbedPacket(GetParam().options);
    sweepAllocations(GetParam().of("engine"),
                     [&] { return std::make_unique<MakesEngine>(GetParam().options, packet); });
}

TEST_P(OutOfMemory, TheFirstFrameIsDrawnOrLeftOut) {
    const uint64_t packet = undisturbedPacket(GetParam().options);
    sweepAllocations(GetParam().of("first-frame"),
                     [&] { return std::make_unique<Draws>(GetParam().options, packet, 0); });
}

TEST_P(OutOfMemory, ALaterFrameIsDrawnOrLeftOut) {
    const uint64_t packet = undisturbedPacket(GetParam().options);
    sweepAllocations(GetParam().of("later-frame"),
                     [&] { return std::make_unique<Draws>(GetParam().options, packet, 4); });
}

TEST_P(OutOfMemory, EverythingEnds) {
    sweepAllocations(GetParam().of("end"), [&] { return std::make_unique<Ends>(GetParam().options); });
}

TEST_P(OutOfMemory, AModelIsLoadedOrRefused) {
    const std::filesystem::path file = modelFile();
    Sweep sweep = GetParam().of("model");
    sweep.stride = GetParam().modelStride;
    sweepAllocations(sweep, [&] { return std::make_unique<LoadsModel>(GetParam().options, file); });
}

TEST(EnvironmentWithoutMemory, IsLoadedOrRefused) {
    const std::filesystem::path file = environmentFile();
    const StageOptions options{ .workers = 1 };
    for (const Whose whose : { Whose::App, Whose::Jobs }) {
        sweepAllocations({ .name = "environment", .whose = whose, .stride = 3 },
                         [&] { return std::make_unique<LoadsEnvironment>(options, file); });
    }
}

// Tests the instrument itself: without a boundary, the exception would arrive here.
// Files decide how many buffers and textures there are.
TEST(OutOfHandles, AModelIsRefusedAndLoadedOnceThereAreSome) {
    Engine engine = *makeEngine({});
    const std::filesystem::path file = modelFile();
    backend::CommandStream& stream = *engine.impl().stream;
    std::vector<backend::BufferHandle> taken;
    try {
        for (;;) taken.push_back(stream.allocateBuffer());
    } catch (OutOfHandles const&) {
    }
    const auto refused = loadGltf(engine, file);
    ASSERT_FALSE(refused.ok());
    EXPECT_TRUE(contains(refused.error().message, "2^20 objects of one type")) << refused.error().message;
    const std::array<uint16_t, 3> corners{ 0, 1, 2 };
    EXPECT_FALSE(engine.create(IndexBufferDesc{ .indexCount = 3, .data = std::as_bytes(std::span(corners)) }));
    const std::vector<std::string> errors = engine.takeErrors();
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_TRUE(contains(errors[0], "2^20 objects of one type")) << errors[0];
    for (const backend::BufferHandle handle : taken) stream.free(handle);
    const auto model = loadGltf(engine, file);
    ASSERT_TRUE(model.ok()) << model.error().message;
    EXPECT_EQ(model->renderableCount(), 2u);
}

TEST(FailingAllocator, FailsTheAllocationThatItWasAskedFor) {
    AllocationFailure failure(Whose::App, 2);
    void* first = ::operator new(8); // called by name: pairs of new and delete may be optimised away
    EXPECT_THROW(::operator delete(::operator new(8)), std::bad_alloc);
    void* third = ::operator new(8);
    EXPECT_TRUE(failure.stop());
    ::operator delete(first);
    ::operator delete(third);
}

TEST(FailingAllocator, CountsBlocksThatWereNotFreed) {
    const int64_t before = liveBlocks();
    void* forgotten = ::operator new(8);
    EXPECT_EQ(liveBlocks(), before + 1);
    ::operator delete(forgotten);
    EXPECT_EQ(liveBlocks(), before);
}

} // namespace
} // namespace filament_core::test
