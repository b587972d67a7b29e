// SPDX-License-Identifier: Apache-2.0
// A driver that hangs: who is told, what the message names, and how often.
#include "tests/backend/stream/StreamTestKit.h"

#include <gmock/gmock.h>

namespace filament_core::backend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;

/// Hangs in the `hangInNumber`-th command of type `hangInId` until the gate opens; waits `pause` in each other command.
struct Hang {
    uint32_t hangInId = ~0u;
    uint32_t hangInNumber = 1;
    std::chrono::milliseconds pause{ 0 };
    bool hangsWhenIdle = false;
    Gate gate;
};

class HangingDriver final : public Driver {
public:
    explicit HangingDriver(Hang& hang) : mHang(hang) {}
    DeviceInfo const& info() const override { return mInfo; }
    void execute(CommandView commands) override { replay(commands, *this); }
    void waitIdle() override {
        if (mHang.hangsWhenIdle) mHang.gate.wait();
    }
    DriverStatistics statistics() const override { return {}; }

    template <class C>
    void execute(C const&) {
        if (mHang.pause.count() > 0) std::this_thread::sleep_for(mHang.pause);
        if (kCommandId<C> == mHang.hangInId && ++mCount == mHang.hangInNumber) mHang.gate.wait();
    }

private:
    Hang& mHang;
    DeviceInfo mInfo;
    uint32_t mCount = 0;
};

std::unique_ptr<CommandStream> startHanging(Hang& hang, CommandStreamOptions options = { .stallWarning = 20ms }) {
    auto stream = CommandStream::start(
            [&](ResultSink&) -> Result<std::unique_ptr<Driver>> { return { std::make_unique<HangingDriver>(hang) }; },
            options);
    EXPECT_TRUE(stream.ok());
    return std::move(*stream);
}

/// Frame 16 creates two pipelines; frame 17 draws with one of them in pass 'color' and with none in pass 'post'.
void submitTwoFrames(CommandStream& stream) {
    const PipelineHandle helmet = stream.allocatePipeline(), other = stream.allocatePipeline();
    CommandBuffer& first = stream.acquire();
    first.record(CmdBeginFrame{ 16 });
    first.record(CmdCreatePipeline{ helmet, { .debugName = "helmet" } });
    first.record(CmdCreatePipeline{ other, { .debugName = "other" } });
    first.record(CmdDestroyPipeline{ other });
    stream.submit(first);
    CommandBuffer& second = stream.acquire();
    second.record(CmdBeginFrame{ 17 });
    second.record(CmdBeginPass{ { .debugName = "color" } });
    second.record(CmdPushGroup{ "opaque" });
    second.record(CmdBindPipeline{ helmet });
    second.record(CmdDrawIndexed{ .indexCount = 3 });
    second.record(CmdPopGroup{});
    second.record(CmdDraw{ .vertexCount = 3 });
    second.record(CmdEndPass{});
    second.record(CmdBeginPass{ { .debugName = "post" } });
    second.record(CmdDraw{ .vertexCount = 3 });
    second.record(CmdEndPass{});
    second.record(CmdEndFrame{ 17 });
    stream.submit(second);
}

/// What waitIdle() logs while the driver hangs in the `number`-th command C of the two frames.
template <class C>
std::vector<std::string> linesWhenHangingIn(uint32_t number = 1) {
    CollectedLog log;
    Hang hang{ .hangInId = kCommandId<C>, .hangInNumber = number };
    auto stream = startHanging(hang);
    submitTwoFrames(*stream);
    std::thread app([&] { stream->waitIdle(); });
    hang.gate.waitForArrival();
    while (log.lines().empty()) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(60ms); // three times the limit: enough for a second warning
    hang.gate.open();
    app.join();
    return log.lines();
}

TEST(ReplayWatch, AStuckDrawIsNamedOnceWithFramePassGroupAndPipeline) {
    EXPECT_THAT(linesWhenHangingIn<CmdDrawIndexed>(),
                ElementsAre(MatchesRegex("driver thread: in command DrawIndexed \\(number 5 of frame 17, pass 'color', "
                                         "group 'opaque', after pipeline 'helmet'\\) for [0-9.]+ s; .*")));
}

TEST(ReplayWatch, GroupsEndAndPassesUnbindPipelines) {
    EXPECT_THAT(
            linesWhenHangingIn<CmdDraw>(1),
            ElementsAre(HasSubstr("in command Draw (number 7 of frame 17, pass 'color', after pipeline 'helmet')")));
    EXPECT_THAT(linesWhenHangingIn<CmdDraw>(2),
                ElementsAre(HasSubstr("in command Draw (number 10 of frame 17, pass 'post') for")));
}

TEST(ReplayWatch, ACommandThatNamesSomethingSaysWhat) {
    EXPECT_THAT(linesWhenHangingIn<CmdCreatePipeline>(2),
                ElementsAre(HasSubstr("in command CreatePipeline 'other' (number 3 of frame 16) for")));
    EXPECT_THAT(linesWhenHangingIn<CmdBeginPass>(2),
                ElementsAre(HasSubstr("in command BeginPass 'post' (number 9 of frame 17) for")));
    EXPECT_THAT(linesWhenHangingIn<CmdBindPipeline>(),
                ElementsAre(HasSubstr("in command BindPipeline 'helmet' (number 4 of frame 17, pass 'color'")));
}

TEST(ReplayWatch, EveryStallIsReported) {
    CollectedLog log;
    for (int stall = 1; stall <= 3; ++stall) {
        Hang hang{ .hangInId = kCommandId<CmdEndFrame> };
        auto stream = startHanging(hang);
        submitFrame(*stream, static_cast<uint64_t>(stall));
        std::thread app([&] { stream->waitIdle(); });
        while (log.lines().size() < static_cast<size_t>(stall)) std::this_thread::sleep_for(1ms);
        hang.gate.open();
        app.join();
        EXPECT_THAT(log.lines().back(), HasSubstr("frame " + std::to_string(stall)));
    }
    EXPECT_EQ(log.lines().size(), 3u);
}

TEST(ReplayWatch, BackPressureLooksToo) {
    CollectedLog log;
    Hang hang{ .hangInId = kCommandId<CmdBeginFrame> };
    auto stream = startHanging(hang, { .maxFramesAhead = 1, .stallWarning = 20ms });
    submitFrame(*stream, 1);
    std::thread app([&] { submitFrame(*stream, 2); });
    while (log.lines().empty()) std::this_thread::sleep_for(1ms);
    hang.gate.open();
    app.join();
    EXPECT_THAT(log.lines(), ElementsAre(HasSubstr("in command BeginFrame (number 1 of frame 1)")));
}

TEST(ReplayWatch, AnAppThatOnlyPollsLooksToo) {
    CollectedLog log;
    Hang hang{ .hangInId = kCommandId<CmdDraw> };
    auto stream = startHanging(hang);
    CommandBuffer& commands = stream->acquire();
    commands.record(CmdDraw{ 3 });
    stream->submit(commands);
    const Ticket ticket = stream->nextTicket();
    while (log.lines().empty()) {
        EXPECT_FALSE(stream->takeReadback(ticket).has_value());
        std::this_thread::sleep_for(1ms);
    }
    EXPECT_THAT(log.lines(), ElementsAre(HasSubstr("in command Draw (number 1 of submission 1)")));
    hang.gate.open();
}

TEST(ReplayWatch, ATimeoutSaysWhereTheDriverThreadIs) {
    CollectedLog log;
    Hang hang{ .hangInId = kCommandId<CmdDrawIndexed> };
    auto stream = startHanging(hang, { .stallWarning = 60s });
    submitTwoFrames(*stream);
    hang.gate.waitForArrival();
    const Result<std::vector<std::byte>> bytes = stream->waitReadback(stream->nextTicket(), 300ms);
    ASSERT_FALSE(bytes.ok());
    EXPECT_EQ(bytes.error().code, ErrorCode::Timeout);
    EXPECT_THAT(bytes.error().message,
                MatchesRegex("read-back [0-9]+: no answer within 300 ms; driver thread: in command DrawIndexed "
                             "\\(number 5 of frame 17, .*\\) for 0\\.[2-9] s"));
    EXPECT_THAT(log.lines(), IsEmpty()) << "the limit is a minute";
    hang.gate.open();
}

TEST(ReplayWatch, ADeviceThatNeverFinishesIsNotBlamedOnACommand) {
    CollectedLog log;
    Hang hang{ .hangsWhenIdle = true };
    auto stream = startHanging(hang);
    submitFrame(*stream, 4);
    std::thread app([&] { stream->waitIdle(); });
    while (log.lines().empty()) std::this_thread::sleep_for(1ms);
    hang.gate.open();
    app.join();
    EXPECT_THAT(log.lines(), ElementsAre(HasSubstr("driver thread: waiting for the device to finish frame 4 for")));
}

// The whole stream takes three times the limit, but each command only a twentieth of it.
TEST(ReplayWatch, ADriverThatIsSlowButMovesIsLeftAlone) {
    CollectedLog log;
    Hang hang{ .pause = 25ms };
    auto stream = startHanging(hang, { .stallWarning = 500ms });
    CommandBuffer& commands = stream->acquire();
    for (uint32_t i = 0; i < 60; ++i) commands.record(CmdDraw{ i });
    stream->submit(commands);
    stream->waitIdle();
    EXPECT_THAT(log.lines(), IsEmpty());
}

TEST(ReplayWatch, ALimitOfZeroNeverWarns) {
    CollectedLog log;
    Hang hang{ .hangInId = kCommandId<CmdDraw> };
    auto stream = startHanging(hang, { .stallWarning = 0ms });
    CommandBuffer& commands = stream->acquire();
    commands.record(CmdDraw{ 3 });
    stream->submit(commands);
    const Result<std::vector<std::byte>> bytes = stream->waitReadback(stream->nextTicket(), 50ms);
    EXPECT_THAT(bytes.error().message, HasSubstr("in command Draw (number 1 of submission 1)"));
    EXPECT_THAT(log.lines(), IsEmpty());
    hang.gate.open();
}

TEST(ReplayWatch, AFactoryThatHangsIsNamed) {
    CollectedLog log;
    Gate gate;
    std::thread app([&] {
        static_cast<void>(CommandStream::start(
                [&](ResultSink& sink) -> Result<std::unique_ptr<Driver>> {
                    gate.wait();
                    return createNullDriver(sink);
                },
                { .stallWarning = 20ms }));
    });
    while (log.lines().empty()) std::this_thread::sleep_for(1ms);
    gate.open();
    app.join();
    EXPECT_THAT(log.lines(), ElementsAre(HasSubstr("driver thread: making the driver for")));
}

// Descriptions read the stream, which the driver thread may end at any moment; for the thread sanitizer.
TEST(ReplayWatch, DescribesAtAnyTimeWhileFramesComeAndGo) {
    CollectedLog log;
    auto stream = startNull({ .stallWarning = 1ms });
    std::atomic<bool> ends{ false };
    std::vector<std::thread> waiters;
    for (int i = 0; i < 2; ++i) {
        waiters.emplace_back([&] {
            while (!ends) static_cast<void>(stream->waitReadback(stream->nextTicket(), 0ms));
        });
    }
    for (uint64_t frame = 1; frame <= 200; ++frame) {
        CommandBuffer& commands = stream->acquire();
        commands.record(CmdBeginFrame{ frame });
        const PipelineHandle pipeline = stream->allocatePipeline();
        commands.record(CmdCreatePipeline{ pipeline, { .debugName = "of one frame" } });
        for (uint32_t i = 0; i < 500; ++i) commands.record(CmdDraw{ i });
        commands.record(CmdDestroyPipeline{ pipeline });
        stream->free(pipeline);
        stream->submit(commands);
    }
    ends = true;
    for (std::thread& waiter : waiters) waiter.join();
    stream->waitIdle();
    EXPECT_EQ(stream->takeErrors().size(), 0u);
    EXPECT_EQ(stream->latency().frames, 200u);
}

} // namespace
} // namespace filament_core::backend
