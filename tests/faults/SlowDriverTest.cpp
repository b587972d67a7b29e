// SPDX-License-Identifier: Apache-2.0
// A slow driver thread, frames that are larger than any buffer, and what the app notices.
#include "tests/faults/FailingAllocator.h"
#include "tests/faults/FaultStage.h"

#include "backend/create/CreateDriver.h"
#include "backend/stream/CommandStream.h"
#include "base/Log.h"

#include <chrono>
#include <mutex>

namespace filament_core::test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

struct Slow {
    explicit Slow(backend::Faults const& faults) : engine(makeEngine({}, injector)) {
        stage.emplace(*engine);
        target = engine->own(engine->create(SwapChainDesc{ .size = stage->view().size }));
        stage->renderer().render(stage->scene(), stage->view(), target);
        engine->waitIdle();
        injector->arm(faults);
    }
    void render(int frames) {
        for (int i = 0; i < frames; ++i) stage->renderer().render(stage->scene(), stage->view(), target);
    }

    std::shared_ptr<backend::FaultInjector> injector = std::make_shared<backend::FaultInjector>();
    Result<Engine> engine;
    std::optional<FaultStage> stage;
    Owned<SwapChain> target;
};

TEST(SlowDriver, HoldsTheAppBackAtTwoFramesAhead) {
    Slow slow({ .streamDelay = 20ms });
    const Clock::time_point begin = Clock::now();
    slow.render(12);
    const auto elapsed = Clock::now() - begin;
    // All frames have been waited for, except the two that may be ahead and the one being replayed.
    EXPECT_GE(elapsed, 9 * 20ms);
    EXPECT_GE(slow.engine->statistics().backPressureNanoseconds, 150'000'000u);
    slow.injector->arm({});
    slow.engine->waitIdle();
    EXPECT_TRUE(slow.engine->takeErrors().empty());
}

TEST(SlowDriver, TakesNoMoreMemoryTheLongerItIs) {
    Slow slow({ .streamDelay = 2ms });
    slow.render(8);
    const int64_t before = liveBlocks();
    slow.render(40);
    EXPECT_LE(liveBlocks() - before, 8) << "frames pile up";
}

TEST(SlowDriver, LosesNoFrameAndNoPixel) {
    Slow slow({ .streamDelay = 3ms });
    std::vector<PixelTicket> tickets;
    for (int i = 0; i < 10; ++i) {
        slow.render(1);
        tickets.push_back(slow.stage->renderer().readPixels(slow.target));
    }
    for (const PixelTicket ticket : tickets) {
        const Result<Image> image = slow.stage->renderer().waitPixels(ticket);
        ASSERT_TRUE(image.ok()) << image.error().message;
        EXPECT_EQ(image->pixels.size(), size_t{ 32 } * 32 * 4);
    }
}

/// Collects the log during its lifetime.
class LogLines {
public:
    LogLines()
            : mBefore(setLogSink([this](Severity, std::string_view line) {
                  const std::lock_guard lock(mMutex);
                  mText += line;
              })) {}
    ~LogLines() { setLogSink(mBefore); }
    std::string text() {
        const std::lock_guard lock(mMutex);
        return mText;
    }

private:
    std::mutex mMutex;
    std::string mText;
    LogSink mBefore;
};

TEST(SlowDriver, ThatIsStuckInACommandIsNamedWithItByWhoeverWaits) {
    LogLines lines;
    Slow slow({ .commandDelay = 400ms });
    // The engine warns after ten seconds; its stream can be set to warn earlier.
    const auto stream = backend::CommandStream::start(
            [&](backend::ResultSink& sink) -> Result<std::unique_ptr<backend::Driver>> {
                auto device = backend::createDriver(Backend::Null, {}, sink);
                return device ? backend::faulty(std::move(*device), slow.injector, sink) : std::move(device);
            },
            { .stallWarning = 50ms });
    ASSERT_TRUE(stream.ok());
    backend::CommandBuffer& commands = (*stream)->acquire();
    commands.record(backend::CmdPushGroup{ "slow group" });
    (*stream)->submit(commands);
    (*stream)->waitIdle();
    EXPECT_TRUE(contains(lines.text(), "PushGroup")) << lines.text();
    slow.injector->arm({});
}

TEST(LargePayload, OfMoreThanAnyBlockArrivesWhole) {
    auto engine = makeEngine({});
    FaultStage stage(*engine);
    ASSERT_TRUE(stage.draw().ok());
    const uint64_t before = engine->statistics().deviceBytes;
    constexpr uint32_t kSide = 2048; // 16 MiB in one command
    const std::vector<std::byte> pixels(size_t{ kSide } * kSide * 4, std::byte{ 7 });
    const Owned<Texture> large = engine->own(
            engine->create(TextureDesc{ .width = kSide, .height = kSide, .pixels = pixels, .name = "large" }));
    EXPECT_TRUE(stage.draw().ok());
    engine->waitIdle();
    EXPECT_GE(engine->statistics().deviceBytes - before, pixels.size());
    EXPECT_TRUE(engine->takeErrors().empty());
}

// A frame's buffer keeps the memory of a usual frame, not that of a single large one.
TEST(LargePayload, IsGivenBackWhenFramesAreSmallAgain) {
    auto engine = makeEngine({ .validation = false });
    FaultStage stage(*engine);
    (void)engine->own(engine->create(TextureDesc{ .name = "small" })); // what looking for its uses needs is kept
    for (int i = 0; i < 8; ++i) ASSERT_TRUE(stage.draw().ok());
    const int64_t before = liveBlocks();
    for (int i = 0; i < 3; ++i) {
        const std::vector<std::byte> pixels(size_t{ 1024 } * 1024 * 4);
        const Owned<Texture> large = engine->own(
                engine->create(TextureDesc{ .width = 1024, .height = 1024, .pixels = pixels, .name = "large" }));
        ASSERT_TRUE(stage.draw().ok());
    }
    for (int i = 0; i < 8; ++i) ASSERT_TRUE(stage.draw().ok());
    EXPECT_LE(liveBlocks() - before, 4);
}

TEST(LargePayload, MoreDrawsThanABufferHoldsAreAllDrawn) {
    auto engine = makeEngine({ .workers = 2 });
    FaultStage stage(*engine, { .spheres = 6000 });
    ASSERT_TRUE(stage.draw().ok());
    engine->waitIdle();
    EXPECT_EQ(stage.renderer().statistics().renderables, 6000u);
    EXPECT_TRUE(engine->takeErrors().empty());
}

TEST(OversizedPicture, IsRefusedBeforeAnythingIsRecordedWithIt) {
    for (const bool validation : { false, true }) {
        auto engine = makeEngine({ .validation = validation });
        FaultStage stage(*engine);
        ASSERT_TRUE(stage.draw().ok());
        const uint64_t commands = engine->statistics().commands;
        stage.view().size = { engine->device().maxTextureSize + 1, 2 };
        const Result<Image> image = stage.draw();
        ASSERT_FALSE(image.ok());
        EXPECT_EQ(image.error().code, ErrorCode::DeviceUnavailable) << image.error().message;
        engine->waitIdle();
        EXPECT_LE(engine->statistics().commands, commands + 2) << "the picture before it is destroyed, that is all";
        const std::vector<std::string> errors = engine->takeErrors();
        ASSERT_EQ(errors.size(), 1u);
        EXPECT_TRUE(contains(errors[0], "renderToImage")) << errors[0];
        EXPECT_TRUE(contains(errors[0], std::to_string(engine->device().maxTextureSize).c_str())) << errors[0];
        stage.view().size = { 32, 32 };
        EXPECT_TRUE(stage.draw().ok()) << "pictures of an allowed size are drawn afterwards";
    }
}

TEST(OversizedPicture, AsATextureOfAMaterialIsReplacedByWhite) {
    auto engine = makeEngine({});
    FaultStage stage(*engine);
    const Owned<Texture> large = engine->own(engine->create(
            TextureDesc{ .width = engine->device().maxTextureSize + 1, .height = 1, .name = "panorama" }));
    ASSERT_TRUE(large.get());
    const std::vector<MaterialConstant> constants{ { "hasBaseColorMap", true } };
    const Owned<Material> material = engine->own(
            *engine->create(MaterialDesc{ shader::engineMaterial("gltf_lit_opaque"), constants, "mapped" }));
    const Owned<MaterialInstance> instance = engine->own(engine->createInstance(material));
    EXPECT_TRUE(engine->set(instance, "baseColorMap", large).ok());
    EXPECT_TRUE(stage.draw().ok());
    const std::vector<std::string> errors = engine->takeErrors();
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_TRUE(contains(errors[0], "panorama")) << errors[0];
}

} // namespace
} // namespace filament_core::test
