// SPDX-License-Identifier: Apache-2.0
// Engines with workers on several threads; each suffers a fault at a different place while the others continue. Mainly
// for the thread sanitizer; FILAMENT_STRESS makes it twenty times as long.
#include "tests/faults/FaultStage.h"

#include <latch>
#include <random>
#include <thread>

namespace filament_core::test {
namespace {

constexpr int kThreads = 4;

int rounds() { return isStress() ? 200 : 10; }

backend::Faults someFault(std::mt19937& random) {
    const auto below = [&](uint32_t bound) { return 1 + random() % bound; };
    switch (random() % 4) {
    case 0:
        return { .loseDeviceAt = below(400) };
    case 1:
        return { .refuseCreation = below(60) };
    case 2:
        return { .streamDelay = std::chrono::microseconds(below(800)) };
    default:
        return {};
    }
}

/// The life of one engine: frames and read-backs with a fault among them, armed while the driver thread is working.
void liveWithAFault(uint32_t seed) {
    std::mt19937 random(seed);
    const auto injector = std::make_shared<backend::FaultInjector>();
    auto engine = makeEngine({ .workers = static_cast<int>(random() % 3) }, injector);
    ASSERT_TRUE(engine.ok()) << engine.error().message;
    FaultStage stage(*engine, { .spheres = 60, .materials = 60 });
    const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = stage.view().size }));
    const uint32_t faultyFrame = random() % 8;
    for (uint32_t frame = 0; frame < 8; ++frame) {
        if (frame == faultyFrame) injector->arm(someFault(random));
        stage.renderer().render(stage.scene(), stage.view(), target);
        if (random() % 2) {
            const Result<Image> image = stage.renderer().waitPixels(stage.renderer().readPixels(target));
            EXPECT_TRUE(image.ok() || frame >= faultyFrame) << image.error().message;
        }
    }
    if (random() % 2) return; // with frames in flight
    engine->waitIdle();
    const std::vector<std::string> errors = engine->takeErrors();
    EXPECT_LE(errors.size(), 1u) << errors[0] << errors[1];
    EXPECT_EQ(errors.empty(), !injector->hasStruck());
}

TEST(FaultStorm, EveryEngineSuffersItsOwnFaultOnly) {
    std::latch start(kThreads);
    std::vector<std::jthread> threads;
    for (uint32_t thread = 0; thread < kThreads; ++thread) {
        threads.emplace_back([&, thread] {
            start.arrive_and_wait();
            for (int round = 0; round < rounds(); ++round) liveWithAFault(thread * 1000 + static_cast<uint32_t>(round));
        });
    }
}

} // namespace
} // namespace filament_core::test
