// SPDX-License-Identifier: Apache-2.0
// A stream ends with work in flight: everything submitted is replayed, the device finishes, and the driver is destroyed
// on its thread, whichever thread ends the stream and in whatever state.
#include "tests/backend/stream/StreamTestKit.h"

#include <gmock/gmock.h>

#include <cstdlib>

namespace filament_core::backend {
namespace {

class ShutdownInBothModes : public testing::TestWithParam<bool> {
protected:
    CommandStreamOptions options() const { return { .ownThread = GetParam() }; }
    Script script;
};
INSTANTIATE_TEST_SUITE_P(Shutdown, ShutdownInBothModes, testing::Values(true, false),
                         [](auto const& mode) { return mode.param ? "OwnThread" : "Inline"; });

TEST_P(ShutdownInBothModes, ReplaysWhatWasSubmittedAndWaitsForTheDevice) {
    script.onExecute = [](ResultSink&) { std::this_thread::sleep_for(10ms); };
    {
        auto stream = startScripted(script, options());
        stream->submit(stream->acquire());
        stream->submit(stream->acquire());
    }
    EXPECT_EQ(script.executed, 2);
    EXPECT_GE(script.idled, 1);
    EXPECT_EQ(script.destroyed, 1);
    EXPECT_FALSE(script.strayThread);
}

TEST_P(ShutdownInBothModes, ALostDeviceIsNeitherReplayedToNorWaitedFor) {
    script.onExecute = [](ResultSink& sink) { sink.onError(DriverErrorKind::DeviceLost, "the device was removed"); };
    {
        auto stream = startScripted(script, options());
        for (int i = 0; i < 3; ++i) stream->submit(stream->acquire());
    }
    EXPECT_EQ(script.executed, 1);
    EXPECT_EQ(script.idled, 0);
    EXPECT_EQ(script.destroyed, 1);
    EXPECT_FALSE(script.strayThread);
}

TEST_P(ShutdownInBothModes, ABufferThatWasAcquiredButNotSubmittedIsDropped) {
    {
        auto stream = startScripted(script, options());
        stream->submit(stream->acquire());
        stream->acquire().record(CmdDraw{ 3 });
    }
    EXPECT_EQ(script.executed, 1);
    EXPECT_EQ(script.destroyed, 1);
}

TEST(Shutdown, WithTwoFramesQueuedBehindOneThatHangsItWaitsForAll) {
    Script script;
    Gate gate;
    script.onExecute = [&](ResultSink&) { gate.wait(); };
    auto stream = startScripted(script, { .maxFramesAhead = 3 });
    for (int i = 0; i < 3; ++i) stream->submit(stream->acquire());
    gate.waitForArrival();
    std::atomic<bool> ended{ false };
    std::thread app([&] {
        stream.reset();
        ended = true;
    });
    std::this_thread::sleep_for(30ms);
    EXPECT_FALSE(ended);
    EXPECT_EQ(script.executed, 0);
    gate.open();
    app.join();
    EXPECT_EQ(script.executed, 3);
    EXPECT_EQ(script.destroyed, 1);
}

TEST(Shutdown, ADeviceLostWithFramesQueuedEndsAtOnce) {
    Script script;
    Gate gate;
    script.onExecute = [&](ResultSink& sink) {
        gate.wait();
        sink.onError(DriverErrorKind::DeviceLost, "the device was removed");
    };
    {
        auto stream = startScripted(script, { .maxFramesAhead = 3 });
        for (int i = 0; i < 3; ++i) stream->submit(stream->acquire());
        gate.waitForArrival();
        gate.open();
    }
    EXPECT_EQ(script.executed, 1) << "the frames behind it are dropped";
    EXPECT_EQ(script.idled, 0);
    EXPECT_EQ(script.destroyed, 1);
}

TEST(Shutdown, MayComeFromAnotherThreadThanTheOneThatSubmitted) {
    Script script;
    script.onExecute = [](ResultSink&) { std::this_thread::sleep_for(5ms); };
    std::unique_ptr<CommandStream> stream = startScripted(script);
    std::thread([&] {
        for (int i = 0; i < 4; ++i) stream->submit(stream->acquire());
    }).join();
    std::thread([&] { stream.reset(); }).join();
    EXPECT_EQ(script.executed, 4);
    EXPECT_EQ(script.destroyed, 1);
    EXPECT_FALSE(script.strayThread) << "the driver still died where it lived";
}

TEST(Shutdown, ManyStreamsAtATimeStartAndEndWithWorkInFlight) {
    std::vector<std::thread> apps;
    std::atomic<int> difference{ 0 };
    for (int app = 0; app < 8; ++app) {
        apps.emplace_back([&] {
            for (int round = 0; round < 20; ++round) {
                Script script;
                {
                    auto stream = startScripted(script);
                    for (int i = 0; i < round % 4; ++i) stream->submit(stream->acquire());
                }
                difference += std::abs(script.executed - round % 4);
            }
        });
    }
    for (std::thread& app : apps) app.join();
    EXPECT_EQ(difference, 0) << "some stream lost or repeated a submission";
}

TEST(Shutdown, ADriverThatHangsInItIsNamed) {
    CollectedLog log;
    Script script;
    Gate gate;
    script.onExecute = [&](ResultSink&) { gate.wait(); };
    auto stream = startScripted(script, { .stallWarning = 20ms });
    submitFrame(*stream, 9);
    gate.waitForArrival();
    std::thread app([&] { stream.reset(); });
    while (log.lines().empty()) std::this_thread::sleep_for(1ms);
    gate.open();
    app.join();
    EXPECT_THAT(log.lines(),
                testing::ElementsAre(testing::StartsWith("driver thread: in frame 9, outside of its commands for ")));
}

} // namespace
} // namespace filament_core::backend
