// SPDX-License-Identifier: Apache-2.0
// Many engines in one process: created and destroyed in parallel, rendering side by side, destroyed with frames in
// flight. On the null backend, so that a thread sanitizer sees everything. FILAMENT_STRESS=N makes it N times as long.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/jobsystem/Storm.h"
#include "tests/scenes/Sphere.h"

#include "shaders/package/EngineMaterials.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace filament_core {
namespace {

using test::onThreads;
using test::scaled;

std::optional<Engine> makeNullEngine(int workers) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = workers, .hashFrames = true });
    if (engine) return std::move(*engine);
    ADD_FAILURE() << engine.error().message;
    return std::nullopt;
}

/// Enough spheres for several jobs per frame, and a target to draw them to.
class Crowd {
public:
    static constexpr int kSide = 24;

    explicit Crowd(Engine& engine)
            : mScene(engine), mRenderer(engine), mEngine(engine), mSphere(engine, scenes::makeSphere(6, 12)) {
        mMaterial = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_opaque") }));
        mInstance = engine.own(engine.createInstance(mMaterial));
        for (int i = 0; i < kSide * kSide; ++i) place({ 2.5 * (i % kSide - kSide / 2), 0, -2.5 * (i / kSide) });
        mScene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f } });
        mView.camera = Camera::lookAt({ 0, 6, 8 }, { 0, 0, -10 }, { .verticalFovDegrees = 60 });
        mView.size = { 64, 48 };
        mTarget = engine.own(engine.create(SwapChainDesc{ .size = mView.size }));
    }

    void render(int frames) {
        for (int i = 0; i < frames; ++i) {
            mRenderer.render(mScene, mView, mTarget);
            takeHashes();
        }
    }

    /// The results of all frames: packets and streams.
    std::vector<std::pair<uint64_t, uint64_t>> const& hashes() {
        mEngine.waitIdle();
        takeHashes();
        return mHashes;
    }

private:
    void takeHashes() {
        for (FrameTimings const& timings : mRenderer.takeTimings())
            mHashes.emplace_back(timings.packetHash, timings.streamHash);
    }

    void place(double3 at) {
        double4x4 world(1);
        world[3] = double4(at, 1);
        mScene.add(mSphere.renderable(mInstance, world));
    }

    Scene mScene;
    View mView;
    Renderer mRenderer;
    Engine& mEngine;
    scenes::Sphere mSphere;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
    Owned<SwapChain> mTarget;
    std::vector<std::pair<uint64_t, uint64_t>> mHashes;
};

std::vector<std::pair<uint64_t, uint64_t>> renderAlone(int workers, int frames) {
    auto engine = makeNullEngine(workers);
    if (!engine) return {};
    Crowd crowd(*engine);
    crowd.render(frames);
    return crowd.hashes();
}

class EngineStorm : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Workers, EngineStorm, testing::Values(1, 2, 16),
                         [](auto const& parameter) { return std::to_string(parameter.param); });

TEST_P(EngineStorm, EnginesAreMadeAndEndedInParallel) {
    const int rounds = scaled(8);
    onThreads(4, [&](int thread) {
        for (int round = 0; round < rounds; ++round) {
            auto engine = makeNullEngine(GetParam());
            ASSERT_TRUE(engine);
            if ((thread + round) % 4 == 0) continue; // never used
            Crowd crowd(*engine);
            crowd.render(2);
            EXPECT_EQ(crowd.hashes().size(), 2u);
            test::expectNoErrors(*engine);
        }
    });
}

TEST_P(EngineStorm, TwoEnginesOnTwoThreadsMakeTheFramesThatEachMakesAlone) {
    const int frames = scaled(40);
    const auto reference = renderAlone(0, frames);
    ASSERT_EQ(reference.size(), static_cast<size_t>(frames));
    ASSERT_NE(reference[0].first, 0u);
    std::vector<std::pair<uint64_t, uint64_t>> made[2];
    onThreads(2, [&](int thread) { made[thread] = renderAlone(GetParam(), frames); });
    EXPECT_EQ(made[0], reference);
    EXPECT_EQ(made[1], reference);
}

TEST_P(EngineStorm, AnEngineMayEndWithFramesInFlight) {
    for (int round = 0; round < scaled(20); ++round) {
        auto engine = makeNullEngine(GetParam());
        ASSERT_TRUE(engine);
        Crowd crowd(*engine);
        crowd.render(round % 4);
    }
}

TEST_P(EngineStorm, AnEngineRendersOnWhicheverThreadHasItsTurn) {
    const int turns = scaled(40);
    auto engine = makeNullEngine(GetParam());
    ASSERT_TRUE(engine);
    Crowd crowd(*engine);
    for (int turn = 0; turn < turns; ++turn) {
        std::jthread([&] {
            engine->useOnThisThread();
            crowd.render(1);
        }).join();
    }
    engine->useOnThisThread();
    EXPECT_EQ(crowd.hashes(), renderAlone(0, turns));
}

} // namespace
} // namespace filament_core
