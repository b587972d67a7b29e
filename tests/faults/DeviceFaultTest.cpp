// SPDX-License-Identifier: Apache-2.0
// The device is lost at every command of a small frame, or runs out of memory at every creation; on the null backend.
// tests/faults/devices does part of this on both APIs.
#include "tests/faults/FaultStage.h"

namespace filament_core::test {
namespace {

using backend::FaultInjector;
using backend::Faults;

struct Broken {
    explicit Broken(StageOptions const& options = {}) : engine(makeEngine(options, injector)) {
        EXPECT_TRUE(engine.ok());
        stage.emplace(*engine);
        engine->waitIdle(); // objects created before the frame exist
    }

    std::shared_ptr<FaultInjector> injector = std::make_shared<FaultInjector>();
    Result<Engine> engine;
    std::optional<FaultStage> stage;
};

/// Commands and creations of the first frame and of its read-back.
std::pair<uint64_t, uint64_t> countsOfAFrame() {
    Broken whole;
    whole.injector->arm({});
    EXPECT_TRUE(whole.stage->draw().ok());
    whole.engine->waitIdle();
    EXPECT_FALSE(whole.injector->hasStruck());
    return { whole.injector->commandsSeen(), whole.injector->creationsSeen() };
}

TEST(LostDevice, IsToldOnceAtEveryCommandOfAFrameAndEverythingReturns) {
    const uint64_t commands = countsOfAFrame().first;
    ASSERT_GT(commands, 30u);
    for (uint64_t at = 1; at <= commands; ++at) {
        SCOPED_TRACE(at);
        Broken broken;
        broken.injector->arm({ .loseDeviceAt = at });
        const Result<Image> image = broken.stage->draw();
        ASSERT_FALSE(image.ok());
        EXPECT_EQ(image.error().code, ErrorCode::DeviceLost) << image.error().message;
        for (int i = 0; i < 5; ++i) EXPECT_FALSE(broken.stage->draw().ok()); // returns without waiting
        broken.engine->waitIdle();
        const std::vector<std::string> errors = broken.engine->takeErrors();
        ASSERT_EQ(errors.size(), 1u) << errors[0];
        EXPECT_TRUE(contains(errors[0], "lost")) << errors[0];
        EXPECT_TRUE(contains(errors[0], ("command " + std::to_string(at) + ",").c_str())) << errors[0];
    }
}

TEST(LostDevice, GivesPollersAnImageWithoutPixels) {
    Broken broken;
    const Owned<SwapChain> target = broken.engine->own(broken.engine->create(SwapChainDesc{ .size = { 32, 32 } }));
    broken.engine->waitIdle();
    broken.injector->arm({ .loseDeviceAt = 1 });
    broken.stage->renderer().render(broken.stage->scene(), broken.stage->view(), target);
    const PixelTicket ticket = broken.stage->renderer().readPixels(target);
    broken.engine->waitIdle();
    const std::optional<Image> image = broken.stage->renderer().takePixels(ticket);
    ASSERT_TRUE(image) << "whoever polls would poll for ever";
    EXPECT_TRUE(image->pixels.empty());
    EXPECT_EQ(image->width, 32u);
}

TEST(LostDevice, LeavesOtherEnginesAlone) {
    Broken broken, sound;
    broken.injector->arm({ .loseDeviceAt = 7 });
    EXPECT_FALSE(broken.stage->draw().ok());
    EXPECT_TRUE(sound.stage->draw().ok());
    EXPECT_TRUE(sound.engine->takeErrors().empty());
}

TEST(LostDevice, StillLetsEverythingBeMadeAndDestroyed) {
    Broken broken;
    broken.injector->arm({ .loseDeviceAt = 1 });
    EXPECT_FALSE(broken.stage->draw().ok());
    FaultStage another(*broken.engine); // textures, materials, a renderer
    EXPECT_FALSE(another.draw().ok());
    broken.stage.reset();
    broken.engine->waitIdle();
    EXPECT_EQ(broken.engine->takeErrors().size(), 1u);
}

TEST(DeviceMemory, RefusedAtEveryCreationOfAFrameIsNamedAndTheRestIsDrawn) {
    const uint64_t creations = countsOfAFrame().second;
    ASSERT_GT(creations, 10u);
    for (uint64_t at = 1; at <= creations; ++at) {
        SCOPED_TRACE(at);
        Broken broken;
        broken.injector->arm({ .refuseCreation = at });
        const Result<Image> image = broken.stage->draw();
        // Without the image itself there is nothing to read, which is a valid answer, too.
        if (!image) {
            EXPECT_EQ(image.error().code, ErrorCode::DeviceUnavailable) << image.error().message;
        }
        EXPECT_TRUE(broken.injector->hasStruck());
        broken.engine->waitIdle();
        const std::vector<std::string> errors = broken.engine->takeErrors();
        ASSERT_EQ(errors.size(), 1u) << errors[0] << errors[1];
        EXPECT_TRUE(contains(errors[0], "out of device memory")) << errors[0];
        EXPECT_TRUE(broken.stage->draw().ok() || !image.ok()) << "the engine goes on";
    }
}

} // namespace
} // namespace filament_core::test
