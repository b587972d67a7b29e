// SPDX-License-Identifier: Apache-2.0
// Objects that are created and destroyed repeatedly leave nothing behind: engines and swap chains, a thousand on the
// null backend, some on the devices; FILAMENT_STRESS=1 makes it a thousand there, too.
#include "shaders/package/EngineMaterials.h"
#include "tests/scenes/Sphere.h"

#include <filament_core/filament_core.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <malloc.h>
#include <optional>
#include <unistd.h>

namespace filament_core::hard {
namespace {

int repetitions(Backend backend, int onDevices) {
    const bool isStress = std::getenv("FILAMENT_STRESS") != nullptr;
    return backend == Backend::Null || isStress ? 1000 : onDevices;
}

/// Resident pages of the process, after the heap has returned its spare memory.
double residentMebibytes() {
    malloc_trim(0);
    std::ifstream file("/proc/self/statm");
    double total = 0, resident = 0;
    file >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024 * 1024);
}

std::optional<Engine> makeEngine(Backend backend) {
    auto engine = Engine::create({ .backend = backend, .workers = 1 });
    if (engine) return std::move(*engine);
    ADD_FAILURE() << engine.error().message;
    return std::nullopt;
}

/// One lit sphere.
class Ball {
public:
    explicit Ball(Engine& engine) : scene(engine), mSphere(engine, scenes::makeSphere(4, 8)) {
        mMaterial = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_opaque") }));
        mInstance = engine.own(engine.createInstance(mMaterial));
        scene.add(mSphere.renderable(mInstance));
        scene.add(SunLight{});
        view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 });
        view.size = { 32, 32 };
    }

    Scene scene;
    View view;

private:
    scenes::Sphere mSphere;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
};

void liveOnce(Backend backend) {
    auto engine = makeEngine(backend);
    ASSERT_TRUE(engine);
    Ball ball(*engine);
    Renderer renderer(*engine);
    ASSERT_TRUE(renderer.renderToImage(ball.scene, ball.view).ok());
    ASSERT_TRUE(engine->takeErrors().empty());
}

class Endless : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Backends, Endless, testing::Values(Backend::Null, Backend::Vulkan, Backend::Gles),
                         [](auto const& test) { return std::string(toString(test.param)); });

/// Growth per round that counts as flat: a leaked object of any kind is larger, a table that doubles is smaller.
constexpr double kFlatKibibytes = 4;

double growthPerRound(double before, double after, int rounds) {
    const double perRound = (after - before) * 1024 / rounds;
    std::printf("%.1f MiB, %d rounds later %.1f MiB: %.2f KiB a round\n", before, rounds, after, perRound);
    return perRound;
}

/// Repeats rounds until so many of them in a row left nothing behind. Drivers and the heaps of threads grow by up to 2
/// MiB a few times, when pages are touched for the first time; leaks grow in every round.
template <class Rounds>
void expectFlat(int count, Rounds&& run) {
    constexpr int kTries = 5;
    double growth = kFlatKibibytes + 1;
    for (int attempt = 0; attempt < kTries && growth > kFlatKibibytes; ++attempt) {
        const double before = residentMebibytes();
        run(count);
        growth = growthPerRound(before, residentMebibytes(), count);
    }
    EXPECT_LE(growth, kFlatKibibytes);
}

TEST_P(Endless, EnginesComeAndGoInTheSameMemory) {
    const auto live = [&](int count) {
        for (int i = 0; i < count && !HasFatalFailure(); ++i) liveOnce(GetParam());
    };
    live(10); // memory that drivers and the C library keep
    expectFlat(repetitions(GetParam(), 100), live);
}

TEST_P(Endless, SwapChainsOfEverySizeComeAndGoInTheSameMemory) {
    auto engine = makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Ball ball(*engine);
    Renderer renderer(*engine);
    const auto render = [&](int count) {
        for (uint32_t i = 0; i < static_cast<uint32_t>(count); ++i) {
            const uint32_t step = i % 32;
            ball.view.size = { 16 + 7 * (step % 8), 16 + 11 * (step / 8) };
            const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = ball.view.size }));
            renderer.render(ball.scene, ball.view, target);
        }
        engine->waitIdle();
    };
    render(64); // two periods of sizes, so that pools and tables have grown
    const uint64_t bytesBefore = engine->statistics().deviceBytes;
    expectFlat(repetitions(GetParam(), 200), render);
    EXPECT_LE(engine->statistics().deviceBytes, bytesBefore + (1u << 20)) << "one size more or less, not all of them";
    EXPECT_TRUE(engine->takeErrors().empty());
}

} // namespace
} // namespace filament_core::hard
