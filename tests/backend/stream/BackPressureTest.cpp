// SPDX-License-Identifier: Apache-2.0
// How far an app may run ahead of the driver thread, and what it learns about the frames in between.
#include "backend/stream/LatencyLog.h"
#include "tests/backend/stream/CountAllocations.h"
#include "tests/backend/stream/StreamTestKit.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace filament_core::backend {
namespace {

class FramesAhead : public testing::TestWithParam<uint32_t> {};
INSTANTIATE_TEST_SUITE_P(BackPressure, FramesAhead, testing::Values(1u, 2u, 3u),
                         [](auto const& ahead) { return std::to_string(ahead.param); });

TEST_P(FramesAhead, AcquireWaitsExactlyWhenSoManySubmittedFramesAreUnreplayed) {
    Script script;
    Gate gate;
    script.onExecute = [&](ResultSink&) { gate.wait(); };
    auto stream = startScripted(script, { .maxFramesAhead = GetParam() });
    for (uint32_t i = 0; i < GetParam(); ++i) submitFrame(*stream, i);
    EXPECT_EQ(stream->backPressureNanoseconds(), 0u) << "so many may be ahead";

    std::atomic<bool> acquired{ false };
    std::thread app([&] {
        CommandBuffer& next = stream->acquire();
        acquired = true;
        stream->submit(next);
    });
    std::this_thread::sleep_for(50ms);
    EXPECT_FALSE(acquired) << GetParam() << " frames are ahead already";
    gate.open();
    app.join();
    stream->waitIdle();
    EXPECT_EQ(script.executed, static_cast<int>(GetParam()) + 1);
    EXPECT_GT(stream->backPressureNanoseconds(), 10'000'000u);
}

/// Records the draws that arrive.
class CollectingDriver final : public Driver {
public:
    explicit CollectingDriver(std::vector<uint32_t>& seen) : mSeen(seen) {}
    DeviceInfo const& info() const override { return mInfo; }
    void execute(CommandView commands) override { replay(commands, *this); }
    void waitIdle() override {}
    DriverStatistics statistics() const override { return {}; }
    void execute(CmdDraw const& command) { mSeen.push_back(command.vertexCount); }
    void execute(auto const&) {}

private:
    DeviceInfo mInfo;
    std::vector<uint32_t>& mSeen;
};

// acquire() returns the buffer that was replayed longest ago: a buffer is never recorded while it is replayed.
TEST_P(FramesAhead, ManyFramesArriveWholeAndInOrder) {
    std::vector<uint32_t> seen;
    constexpr uint32_t kFrames = 300, kDraws = 50;
    {
        auto stream = CommandStream::start(
                [&](ResultSink&) -> Result<std::unique_ptr<Driver>> {
                    return { std::make_unique<CollectingDriver>(seen) };
                },
                { .maxFramesAhead = GetParam() });
        for (uint32_t frame = 0; frame < kFrames; ++frame) {
            CommandBuffer& commands = (*stream)->acquire();
            for (uint32_t i = 0; i < kDraws; ++i) commands.record(CmdDraw{ .vertexCount = frame * kDraws + i });
            (*stream)->submit(commands);
        }
    }
    std::vector<uint32_t> expected(kFrames * kDraws);
    std::iota(expected.begin(), expected.end(), 0u);
    EXPECT_EQ(seen, expected);
}

// ---------------------------------------------------------------------------------------------- latency

FrameTiming timingOf(int64_t waiting, int64_t replay, int64_t backPressure) {
    return { .submitted = 1000,
             .replayBegin = 1000 + waiting,
             .replayEnd = 1000 + waiting + replay,
             .backPressure = backPressure };
}

TEST(LatencyLog, HasZerosWithoutFrames) {
    const LatencyStatistics none = LatencyLog().summary();
    EXPECT_EQ(none.frames, 0u);
    EXPECT_EQ(none.submitToEnd.max, 0);
}

TEST(LatencyLog, QuantilesAreValuesThatOccurredByNearestRank) {
    LatencyLog log;
    std::vector<int64_t> order(200);
    std::iota(order.begin(), order.end(), int64_t{ 1 });
    std::shuffle(order.begin(), order.end(), std::mt19937(7));
    for (const int64_t i : order) log.add(timingOf(i, 1000 * i, i % 2));
    const LatencyStatistics figures = log.summary();
    EXPECT_EQ(figures.frames, 200u);
    EXPECT_EQ(figures.submitToReplay.min, 1);
    EXPECT_EQ(figures.submitToReplay.median, 100);
    EXPECT_EQ(figures.submitToReplay.p99, 198);
    EXPECT_EQ(figures.submitToReplay.max, 200);
    EXPECT_EQ(figures.replay.p99, 198'000);
    EXPECT_EQ(figures.submitToEnd.median, 100'100);
    EXPECT_EQ(figures.backPressure.median, 0);
    EXPECT_EQ(figures.backPressure.p99, 1);
}

TEST(LatencyLog, OneFrameIsEveryQuantile) {
    LatencyLog log;
    log.add(timingOf(5, 6, 7));
    const LatencyStatistics figures = log.summary();
    for (const int64_t value : { figures.replay.min, figures.replay.median, figures.replay.p99, figures.replay.max })
        EXPECT_EQ(value, 6);
}

TEST(LatencyLog, ForgetsAllButTheLast256Frames) {
    LatencyLog log;
    for (int64_t i = 0; i < 1000; ++i) log.add(timingOf(i, 0, 0));
    const LatencyStatistics figures = log.summary();
    EXPECT_EQ(figures.frames, 256u);
    EXPECT_EQ(figures.submitToReplay.min, 1000 - 256);
    EXPECT_EQ(figures.submitToReplay.max, 999);
}

TEST(Latency, ASlowDriverShowsInReplayAndInBackPressure) {
    Script script;
    script.onExecute = [](ResultSink&) { std::this_thread::sleep_for(5ms); };
    auto stream = startScripted(script, { .maxFramesAhead = 1 });
    for (uint64_t frame = 0; frame < 8; ++frame) submitFrame(*stream, frame);
    stream->waitIdle();
    const LatencyStatistics figures = stream->latency();
    EXPECT_EQ(figures.frames, 8u);
    EXPECT_GE(figures.replay.min, 5'000'000);
    EXPECT_GE(figures.submitToEnd.min, figures.replay.min);
    EXPECT_EQ(figures.backPressure.min, 0) << "nothing was ahead of the first frame";
    EXPECT_GE(figures.backPressure.max, 4'000'000) << "the app recorded nothing: it waited for each replay";
    EXPECT_LE(figures.submitToReplay.median, figures.submitToReplay.max);
}

TEST(Latency, CountsFramesThatReachTheDeviceAndNothingElse) {
    Script script;
    bool loseDevice = false;
    script.onExecute = [&](ResultSink& sink) {
        if (loseDevice) sink.onError(DriverErrorKind::DeviceLost, "the device was removed");
    };
    auto stream = startScripted(script, { .ownThread = false });
    stream->submit(stream->acquire()); // objects are made between frames
    EXPECT_EQ(stream->latency().frames, 0u);
    submitFrame(*stream, 1);
    EXPECT_EQ(stream->latency().frames, 1u);
    loseDevice = true;
    submitFrame(*stream, 2); // reaches it, and loses it
    submitFrame(*stream, 3);
    EXPECT_EQ(stream->latency().frames, 2u);
}

TEST(Latency, ReadingTheFiguresAllocatesNothing) {
    auto stream = startNull();
    for (uint64_t frame = 0; frame < 300; ++frame) submitFrame(*stream, frame);
    stream->waitIdle();
    const uint64_t before = allocationCount();
    EXPECT_EQ(stream->latency().frames, 256u);
    EXPECT_EQ(allocationCount() - before, 0u);
}

// ---------------------------------------------------------------------------------------------- hashes

TEST(StreamHashes, AreThereWhenAskedForAndFollowTheContents) {
    const auto hashesOf = [](bool wanted) {
        auto stream = startNull({ .hashStreams = wanted });
        for (const uint32_t vertices : { 1u, 2u, 1u }) {
            CommandBuffer& commands = stream->acquire();
            commands.record(CmdBeginFrame{ 5 });
            commands.record(CmdDraw{ .vertexCount = vertices });
            stream->submit(commands);
        }
        stream->waitIdle();
        std::vector<uint64_t> hashes;
        for (FrameTiming const& timing : stream->takeTimings()) hashes.push_back(timing.hash);
        return hashes;
    };
    EXPECT_EQ(hashesOf(false), (std::vector<uint64_t>{ 0, 0, 0 }));
    const std::vector<uint64_t> hashes = hashesOf(true);
    ASSERT_EQ(hashes.size(), 3u);
    EXPECT_NE(hashes[0], 0u);
    EXPECT_NE(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
    EXPECT_EQ(hashesOf(true), hashes) << "another stream, other threads, other addresses";
}

} // namespace
} // namespace filament_core::backend
