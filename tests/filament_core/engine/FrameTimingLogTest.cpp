// SPDX-License-Identifier: Apache-2.0
// Every pass of every frame has a time, however many there are.
#include "filament_core/engine/FrameTimingLog.h"

#include <filament_core/Engine.h>

#include <gtest/gtest.h>

#include <string>

namespace filament_core::engine {
namespace {

class FrameTimingLogTest : public testing::Test {
protected:
    /// A frame of `passes` timers, and its entry in the log.
    void frame(FrameTimingLog& log, uint64_t number, size_t passes) {
        backend::CommandStream& stream = *mEngine->impl().stream;
        std::vector<std::string> names(passes);
        std::vector<framegraph::PassTimer> timers(passes);
        backend::CommandBuffer& commands = stream.acquire();
        commands.record(backend::CmdBeginFrame{ log.numberInStream(number) });
        for (size_t i = 0; i < passes; ++i) {
            names[i] = "pass " + std::to_string(i);
            timers[i] = { names[i], stream.nextTicket() };
            commands.record(backend::CmdBeginTimer{ timers[i].ticket });
            commands.record(backend::CmdEndTimer{ timers[i].ticket });
        }
        commands.record(backend::CmdEndFrame{ log.numberInStream(number) });
        stream.submit(commands);
        log.add(number, {}, timers);
    }

    void expectPasses(FrameTimings const& timings, size_t passes) {
        ASSERT_EQ(timings.passes.size(), passes) << "frame " << timings.frame;
        for (size_t i = 0; i < passes; ++i) {
            EXPECT_EQ(timings.passes[i].name, "pass " + std::to_string(i));
            EXPECT_GE(timings.passes[i].gpuMilliseconds, 0);
        }
    }

    Result<Engine> mEngine = Engine::create({ .backend = Backend::Null });
};

TEST_F(FrameTimingLogTest, FortyPassesHaveFortyTimesInTheirOrder) {
    FrameTimingLog log(mEngine->impl());
    frame(log, 1, 40);
    mEngine->impl().stream->waitIdle();
    const std::vector<FrameTimings> timings = log.take();
    ASSERT_EQ(timings.size(), 1u);
    expectPasses(timings[0], 40);
    EXPECT_TRUE(log.take().empty()) << "a frame is told once";
}

TEST_F(FrameTimingLogTest, FramesWithMoreAndWithFewerPassesFollowEachOther) {
    FrameTimingLog log(mEngine->impl());
    const std::vector<size_t> counts{ 3, 0, 17, 200, 1 };
    for (size_t i = 0; i < counts.size(); ++i) frame(log, i + 1, counts[i]);
    mEngine->impl().stream->waitIdle();
    const std::vector<FrameTimings> timings = log.take();
    ASSERT_EQ(timings.size(), counts.size());
    for (size_t i = 0; i < counts.size(); ++i) expectPasses(timings[i], counts[i]);
}

// Whichever is asked first gets the replays of both from the stream.
TEST_F(FrameTimingLogTest, LogsOfOneEngineHaveEachTheirOwnFrames) {
    FrameTimingLog first(mEngine->impl());
    {
        FrameTimingLog gone(mEngine->impl());
        frame(gone, 1, 5);
    }
    FrameTimingLog second(mEngine->impl());
    for (uint64_t number = 1; number <= 3; ++number) {
        frame(first, number, 1);
        frame(second, number, 2);
        if (number == 2) mEngine->impl().stream->waitIdle();
    }
    mEngine->impl().stream->waitIdle();
    const std::vector<FrameTimings> ofFirst = first.take(), ofSecond = second.take();
    ASSERT_EQ(ofFirst.size(), 3u);
    ASSERT_EQ(ofSecond.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(ofFirst[i].frame, i + 1);
        EXPECT_EQ(ofSecond[i].frame, i + 1);
        expectPasses(ofFirst[i], 1);
        expectPasses(ofSecond[i], 2);
        EXPECT_LE(ofFirst[i].replayEndSeconds, ofSecond[i].replayBeginSeconds) << "of its own replay";
    }
}

TEST_F(FrameTimingLogTest, RenderersDrawnInTurnsTellAllOfTheirFrames) {
    Scene scene(*mEngine);
    Renderer left(*mEngine), right(*mEngine);
    const Owned<SwapChain> target = mEngine->own(mEngine->create(SwapChainDesc{ .size = { 8, 8 } }));
    for (int frame = 0; frame < 4; ++frame) {
        left.render(scene, View{ .size = { 8, 8 } }, target);
        right.render(scene, View{ .size = { 8, 8 } }, target);
    }
    mEngine->waitIdle();
    EXPECT_EQ(left.takeTimings().size(), 4u);
    EXPECT_EQ(right.takeTimings().size(), 4u);
}

// 64 frames of 40 passes have more answers than the stream keeps.
TEST_F(FrameTimingLogTest, UnrequestedFramesKeepTheTimesOfTheirPasses) {
    FrameTimingLog log(mEngine->impl());
    for (uint64_t number = 1; number <= 100; ++number) frame(log, number, 40);
    mEngine->impl().stream->waitIdle();
    const std::vector<FrameTimings> timings = log.take();
    ASSERT_EQ(timings.size(), 64u);
    for (size_t i = 0; i < timings.size(); ++i) {
        EXPECT_EQ(timings[i].frame, 37 + i);
        expectPasses(timings[i], 40);
    }
}

} // namespace
} // namespace filament_core::engine
