// SPDX-License-Identifier: Apache-2.0
// A frame does not depend on how many threads made it or where they ran: packet, command stream, image.
#include "filament_core/prepare/DrawList.h"
#include "filament_core/prepare/SortItems.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/scenes/Sphere.h"

#include "shaders/package/EngineMaterials.h"

#include <cmath>

namespace filament_core {
namespace {

struct Threads {
    int workers = 0;
    ThreadAffinity affinity = ThreadAffinity::None;
    int driverCore = -1;
};

std::string nameOf(Threads const& threads) {
    return std::to_string(threads.workers) + " workers, affinity " +
           std::to_string(static_cast<int>(threads.affinity)) + ", driver core " + std::to_string(threads.driverCore);
}

std::vector<Threads> everyKindOfThreads() {
    std::vector<Threads> all;
    for (int workers : { 0, 1, 2, 3, 16 }) {
        for (ThreadAffinity affinity : { ThreadAffinity::None, ThreadAffinity::Pin, ThreadAffinity::BigCores })
            all.push_back({ workers, affinity, -1 });
        all.push_back({ workers, ThreadAffinity::None, 0 }); // workers avoid the driver's core
    }
    return all;
}

/// Each number of workers and each policy once, not every combination: images take longer than streams.
std::vector<Threads> someKindsOfThreads() {
    return { { 0 }, { 1 }, { 2, ThreadAffinity::None, 0 }, { 2, ThreadAffinity::Pin }, { 3, ThreadAffinity::BigCores },
             { 16 } };
}

/// A square field of spheres of several materials, opaque and blended, all in view except every eighth sphere, which is
/// behind the camera.
class Field {
public:
    Field(Engine& engine, int side) : scene(engine), mEngine(engine), mSphere(engine, scenes::makeSphere(4, 8)) {
        mOpaque = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_opaque") }));
        mBlended = engine.own(*engine.create(MaterialDesc{ .package = shader::engineMaterial("gltf_lit_blended") }));
        for (int i = 0; i < 5; ++i) mInstances.push_back(engine.own(engine.createInstance(i < 4 ? mOpaque : mBlended)));
        for (int i = 0; i < side * side; ++i) {
            const double x = kWidth * (i % side) / side - kWidth / 2, z = 2 - kWidth * (i / side) / side;
            place(x, i % 8 == 7 ? 20 : z, i);
        }
        scene.add(SunLight{ .directionWorld = { -0.4f, -1, -0.6f } });
        scene.add(PointLight{ .positionWorld = { 0, 2, -4 }, .intensity = Candela{ 60'000 }, .rangeMeters = 9 });
        view.camera = Camera::lookAt({ 0, 6, 8 }, { 0, 0, -10 }, { .verticalFovDegrees = 60 });
        view.size = { 96, 64 };
    }

    Scene scene;
    View view;

private:
    static constexpr double kWidth = 9;

    void place(double x, double z, int i) {
        double4x4 world(0.3);
        world[3] = double4(x, 0.25 * std::sin(i), z, 1);
        scene.add(mSphere.renderable(mInstances[static_cast<size_t>(i * 7 % 5)], world));
    }

    Engine& mEngine;
    scenes::Sphere mSphere;
    Owned<Material> mOpaque, mBlended;
    std::vector<Owned<MaterialInstance>> mInstances;
};

struct Outcome {
    std::vector<std::pair<uint64_t, uint64_t>> hashes; ///< packet and stream, frame by frame
    std::vector<std::byte> pixels;
    uint32_t renderables = 0, visible = 0;
    friend bool operator==(Outcome const&, Outcome const&) = default;
};

Outcome render(Backend backend, Threads const& threads, int side, bool jitter = false) {
    auto engine = Engine::create({ .backend = backend,
                                   .workers = threads.workers,
                                   .affinity = threads.affinity,
                                   .driverCore = threads.driverCore,
                                   .hashFrames = true });
    if (!engine) {
        ADD_FAILURE() << engine.error().message;
        return {};
    }
    Field field(*engine, side);
    if (jitter) field.view.camera = Camera::lookAt({ 0, 6.0001, 8 }, { 0, 0, -10 }, { .verticalFovDegrees = 60 });
    Renderer renderer(*engine);
    const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = field.view.size }));
    for (int frame = 0; frame < 3; ++frame) renderer.render(field.scene, field.view, target);
    auto image = renderer.waitPixels(renderer.readPixels(target));
    EXPECT_TRUE(image.ok());
    engine->waitIdle();
    Outcome outcome{ .pixels = image ? image->pixels : std::vector<std::byte>{},
                     .renderables = renderer.statistics().renderables,
                     .visible = renderer.statistics().visible };
    for (FrameTimings const& timings : renderer.takeTimings())
        outcome.hashes.push_back({ timings.packetHash, timings.streamHash });
    test::expectNoErrors(*engine);
    return outcome;
}

TEST(SameBits, PacketAndStreamDoNotDependOnWorkersOrAffinity) {
    constexpr int kSide = 200;
    const Outcome reference = render(Backend::Null, {}, kSide);
    ASSERT_EQ(reference.hashes.size(), 3u);
    ASSERT_GE(reference.renderables, 2 * prepare::kCullRange) << "too few to be culled in several ranges";
    ASSERT_LT(reference.visible, reference.renderables);
    ASSERT_GE(reference.visible, 2 * prepare::kSortRange) << "too few to be sorted in several ranges";
    ASSERT_GE(reference.visible, 2 * prepare::kMergeRange) << "too few to be merged in several ranges";
    EXPECT_NE(reference.hashes[0].first, 0u);
    EXPECT_EQ(reference.hashes[1].first, reference.hashes[2].first) << "the same view again";
    for (Threads const& threads : everyKindOfThreads())
        EXPECT_EQ(render(Backend::Null, threads, kSide).hashes, reference.hashes) << nameOf(threads);
}

TEST(SameBits, AMovedCameraChangesPacketAndStream) {
    const Outcome reference = render(Backend::Null, {}, 8), moved = render(Backend::Null, {}, 8, true);
    EXPECT_NE(reference.hashes[0].first, moved.hashes[0].first);
    EXPECT_NE(reference.hashes[0].second, moved.hashes[0].second);
}

TEST(SameBits, TheImageDoesNotDependOnWorkersOrAffinityOnEitherApi) {
    constexpr int kSide = 48;
    const Outcome reference = render(Backend::Vulkan, {}, kSide);
    ASSERT_FALSE(reference.pixels.empty());
    ASSERT_GT(reference.renderables, prepare::kCullRange) << "too few to be culled in several ranges";
    for (Backend backend : test::kBothApis) {
        for (Threads const& threads : someKindsOfThreads())
            EXPECT_EQ(render(backend, threads, kSide).pixels, reference.pixels) << toString(backend) << nameOf(threads);
    }
}

} // namespace
} // namespace filament_core
