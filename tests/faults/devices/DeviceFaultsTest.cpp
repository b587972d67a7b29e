// SPDX-License-Identifier: Apache-2.0
// Some of the faults of tests/faults on Vulkan and OpenGL ES: the image after a fault equals the undisturbed one to
// the bit, or there is none and the app is told. FILAMENT_STRESS tries every place.
#include "tests/faults/AllocationSweep.h"
#include "tests/faults/FaultStage.h"

namespace filament_core::test {
namespace {

using backend::FaultInjector;

class DeviceFaults : public testing::TestWithParam<Backend> {
protected:
    StageOptions options() const { return { .backend = GetParam(), .validation = false }; }
    /// About this many places out of `count`.
    static uint64_t strideFor(uint64_t count, uint64_t places) {
        return isStress() ? 1 : std::max<uint64_t>(1, count / places);
    }
};
INSTANTIATE_TEST_SUITE_P(BothApis, DeviceFaults, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& test) { return std::string(toString(test.param)); });

std::vector<std::byte> undisturbedPixels(StageOptions const& options) {
    auto engine = makeEngine(options);
    FaultStage stage(*engine);
    Result<Image> image = stage.draw();
    EXPECT_TRUE(image.ok());
    return image.ok() ? std::move(image->pixels) : std::vector<std::byte>{};
}

struct Broken {
    explicit Broken(StageOptions const& options) : engine(makeEngine(options, injector)) {
        EXPECT_TRUE(engine.ok());
        stage.emplace(*engine);
        engine->waitIdle();
    }
    std::shared_ptr<FaultInjector> injector = std::make_shared<FaultInjector>();
    Result<Engine> engine;
    std::optional<FaultStage> stage;
};

TEST_P(DeviceFaults, ALostDeviceIsToldOnceAndEverythingReturns) {
    uint64_t commands = 0;
    {
        Broken whole(options());
        whole.injector->arm({});
        EXPECT_TRUE(whole.stage->draw().ok());
        commands = whole.injector->commandsSeen();
    }
    for (uint64_t at = 1; at <= commands; at += strideFor(commands, 16)) {
        SCOPED_TRACE(at);
        Broken broken(options());
        broken.injector->arm({ .loseDeviceAt = at }); // also inside a pass: the driver ends with it open
        const Result<Image> image = broken.stage->draw();
        ASSERT_FALSE(image.ok());
        EXPECT_EQ(image.error().code, ErrorCode::DeviceLost) << image.error().message;
        EXPECT_FALSE(broken.stage->draw().ok());
        broken.engine->waitIdle();
        const std::vector<std::string> errors = broken.engine->takeErrors();
        ASSERT_EQ(errors.size(), 1u) << errors[0];
        EXPECT_TRUE(contains(errors[0], "lost")) << errors[0];
    }
}

TEST_P(DeviceFaults, ARefusedObjectIsNamedAndTheRestIsDrawn) {
    uint64_t creations = 0;
    {
        Broken whole(options());
        whole.injector->arm({});
        EXPECT_TRUE(whole.stage->draw().ok());
        creations = whole.injector->creationsSeen();
    }
    for (uint64_t at = 1; at <= creations; at += strideFor(creations, 12)) {
        SCOPED_TRACE(at);
        Broken broken(options());
        broken.injector->arm({ .refuseCreation = at });
        const Result<Image> first = broken.stage->draw(), second = broken.stage->draw();
        broken.engine->waitIdle();
        const std::vector<std::string> errors = broken.engine->takeErrors();
        ASSERT_FALSE(errors.empty());
        EXPECT_TRUE(contains(errors[0], "out of device memory")) << errors[0];
        // Without its image there is no image; without any other object there is one, perhaps with less in it.
        EXPECT_EQ(first.ok(), second.ok());
        if (second.ok()) {
            EXPECT_EQ(second->pixels.size(), size_t{ 32 } * 32 * 4);
        }
    }
}

/// A first frame that runs out of memory, then one that does not.
class DrawsAgain final : public Scenario {
public:
    DrawsAgain(StageOptions const& options, std::vector<std::byte> const& expected)
            : mExpected(expected), mEngine(makeEngine(options)), mStage(*mEngine) {
        mEngine->waitIdle();
    }
    Result<void> act() override {
        const Result<Image> image = mStage.draw();
        if (!image) return image.error();
        EXPECT_EQ(image->pixels, mExpected);
        return {};
    }
    void expectSound(Result<void> const&) override {
        const Result<Image> image = mStage.draw();
        if (image) {
            EXPECT_EQ(image->pixels, mExpected) << "another picture than without the fault";
        } else {
            EXPECT_EQ(image.error().code, ErrorCode::DeviceLost) << image.error().message;
        }
        mEngine->waitIdle();
        for (std::string const& error : mEngine->takeErrors()) EXPECT_TRUE(contains(error, "memory")) << error;
    }

private:
    std::vector<std::byte> const& mExpected;
    Result<Engine> mEngine;
    FaultStage mStage;
};

TEST_P(DeviceFaults, AFirstFrameWithoutMemoryIsLeftOutAndTheNextOneIsRight) {
    const std::vector<std::byte> expected = undisturbedPixels(options());
    for (const Whose whose : { Whose::App, Whose::Driver }) {
        const uint64_t failed = sweepAllocations(
                { std::string("first-frame-") + toString(GetParam()), whose, Lasting::Once, Callers::ThisProgram, 11 },
                [&] { return std::make_unique<DrawsAgain>(options(), expected); });
        EXPECT_GE(failed, 3u) << toString(whose);
    }
}

} // namespace
} // namespace filament_core::test
