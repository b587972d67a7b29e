// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/stream/CountAllocations.h"
#include "tests/backend/stream/StreamTestKit.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <thread>

namespace filament_core::backend {
namespace {

using namespace std::chrono_literals;

class BothThreadModes : public testing::TestWithParam<bool> {
protected:
    CommandStreamOptions options() const { return { .ownThread = GetParam() }; }
};
INSTANTIATE_TEST_SUITE_P(CommandStream, BothThreadModes, testing::Values(true, false),
                         [](auto const& mode) { return mode.param ? "OwnThread" : "Inline"; });

TEST_P(BothThreadModes, TheDriverLivesAndDiesOnOneThread) {
    Script script;
    {
        auto stream = startScripted(script, options());
        for (int i = 0; i < 5; ++i) stream->submit(stream->acquire());
        stream->waitIdle();
    }
    EXPECT_EQ(script.executed, 5);
    EXPECT_EQ(script.destroyed, 1);
    EXPECT_FALSE(script.strayThread);
    EXPECT_EQ(script.threadName == "driver", GetParam());
}

int coresOf(pthread_t thread) {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    EXPECT_EQ(pthread_getaffinity_np(thread, sizeof(cores), &cores), 0);
    return CPU_COUNT(&cores);
}

TEST(CommandStream, TheDriverThreadTakesItsCoreAgainAfterAWaitIfTheOptionsSaySo) {
    cpu_set_t all;
    CPU_ZERO(&all);
    ASSERT_EQ(pthread_getaffinity_np(pthread_self(), sizeof(all), &all), 0);
    if (CPU_COUNT(&all) < 2) GTEST_SKIP() << "needs two cores";
    int core = 0;
    while (!CPU_ISSET(static_cast<size_t>(core), &all)) ++core;
    for (const bool repins : { false, true }) {
        Script script;
        pthread_t driver{};
        int cores = 0;
        script.onExecute = [&](ResultSink&) {
            driver = pthread_self();
            cores = coresOf(driver);
        };
        auto stream = startScripted(script, { .driverCore = core, .repinAfterWaits = repins });
        submitFrame(*stream, 1);
        stream->waitIdle();
        EXPECT_EQ(cores, 1);
        ASSERT_EQ(pthread_setaffinity_np(driver, sizeof(all), &all), 0); // as a system does that moves processes
        for (uint64_t frame = 2; frame < 100 && (frame == 2 || (repins && cores != 1)); ++frame) {
            std::this_thread::sleep_for(10ms); // the thread waits again
            submitFrame(*stream, frame);
            stream->waitIdle();
        }
        EXPECT_EQ(cores, repins ? 1 : CPU_COUNT(&all));
    }
}

TEST_P(BothThreadModes, AFailingFactoryIsAnErrorWithItsOwnText) {
    auto stream = CommandStream::start(
            [](ResultSink&) -> Result<std::unique_ptr<Driver>> {
                return fail(ErrorCode::DeviceUnavailable, "no device: install mesa-vulkan-drivers");
            },
            options());
    ASSERT_FALSE(stream.ok());
    EXPECT_EQ(stream.error().code, ErrorCode::DeviceUnavailable);
    EXPECT_EQ(stream.error().message, "no device: install mesa-vulkan-drivers");
}

TEST_P(BothThreadModes, ReadbacksTimersAndErrorsComeOutOnce) {
    Script script;
    auto stream = startScripted(script, options());
    const Ticket picture = stream->nextTicket(), timer = stream->nextTicket();
    const std::array bytes{ std::byte{ 1 }, std::byte{ 2 } };
    script.onExecute = [&](ResultSink& sink) {
        sink.onReadback(picture, bytes);
        sink.onTimer(timer, 77);
        sink.onError(DriverErrorKind::ShaderCompile, "program 'x': line 3: no such function");
    };
    stream->submit(stream->acquire());
    stream->waitIdle();
    EXPECT_THAT(stream->takeReadback(picture).value(), testing::ElementsAre(std::byte{ 1 }, std::byte{ 2 }));
    EXPECT_FALSE(stream->takeReadback(picture).has_value());
    EXPECT_EQ(stream->takeTimer(timer), 77u);
    EXPECT_FALSE(stream->takeTimer(timer).has_value());
    const std::vector<DriverError> errors = stream->takeErrors();
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].kind, DriverErrorKind::ShaderCompile);
    EXPECT_TRUE(stream->takeErrors().empty());
}

TEST_P(BothThreadModes, WaitingForAReadbackNeedsNoFurtherFrame) {
    auto stream = startNull(options());
    const TextureHandle texture = stream->allocateTexture();
    const Ticket ticket = stream->nextTicket();
    CommandBuffer& commands = stream->acquire();
    commands.record(CmdCreateTexture{ texture, { .width = 4, .height = 2 } });
    commands.record(CmdReadTexture{ .texture = texture, .rect = { 0, 0, 4, 2 }, .ticket = ticket });
    stream->submit(commands); // no CmdEndFrame: the null driver answers when it idles
    Result<std::vector<std::byte>> bytes = stream->waitReadback(ticket, 10s);
    ASSERT_TRUE(bytes.ok()) << bytes.error().message;
    EXPECT_EQ(bytes->size(), 4u * 2u * 4u);
}

TEST_P(BothThreadModes, WaitingForWhatWasNeverAskedEndsAtOnce) {
    auto stream = startNull(options());
    stream->submit(stream->acquire());
    const auto begin = std::chrono::steady_clock::now();
    Result<std::vector<std::byte>> bytes = stream->waitReadback(stream->nextTicket(), 60s);
    ASSERT_FALSE(bytes.ok());
    EXPECT_EQ(bytes.error().code, ErrorCode::NotFound);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 30s);
}

TEST_P(BothThreadModes, ALostDeviceEndsWaitsAndStopsReplaying) {
    Script script;
    script.onExecute = [](ResultSink& sink) { sink.onError(DriverErrorKind::DeviceLost, "the device was removed"); };
    auto stream = startScripted(script, options());
    for (int i = 0; i < 8; ++i) stream->submit(stream->acquire());
    Result<std::vector<std::byte>> bytes = stream->waitReadback(stream->nextTicket(), 60s);
    ASSERT_FALSE(bytes.ok());
    EXPECT_EQ(bytes.error().code, ErrorCode::DeviceLost);
    stream->waitIdle();
    EXPECT_EQ(script.executed, 1) << "nothing is replayed on a lost device";
    EXPECT_EQ(script.idled, 0);
}

TEST_P(BothThreadModes, TimingsCarryTheAppsFrameNumbersInOrder) {
    auto stream = startNull(options());
    for (uint64_t frame = 40; frame < 43; ++frame) {
        CommandBuffer& commands = stream->acquire();
        commands.record(CmdPushGroup{ "frame" });
        commands.record(CmdBeginFrame{ frame });
        stream->submit(commands);
    }
    stream->submit(stream->acquire());
    stream->waitIdle();
    const std::vector<FrameTiming> timings = stream->takeTimings();
    ASSERT_EQ(timings.size(), 4u);
    EXPECT_EQ(timings[0].frame, 40u);
    EXPECT_EQ(timings[2].frame, 42u);
    EXPECT_EQ(timings[3].frame, 4u) << "without CmdBeginFrame: the running number";
    for (FrameTiming const& timing : timings) {
        EXPECT_LE(timing.submitted, timing.replayBegin);
        EXPECT_LE(timing.replayBegin, timing.replayEnd);
    }
    EXPECT_TRUE(stream->takeTimings().empty());
}

TEST_P(BothThreadModes, ErrorsBeyondTheLimitAreCountedNotKept) {
    Script script;
    script.onExecute = [](ResultSink& sink) {
        for (int i = 0; i < 1000; ++i) sink.onError(DriverErrorKind::Other, "again");
    };
    auto stream = startScripted(script, options());
    stream->submit(stream->acquire());
    stream->waitIdle();
    const std::vector<DriverError> errors = stream->takeErrors();
    ASSERT_EQ(errors.size(), 257u);
    EXPECT_THAT(errors.back().message, testing::HasSubstr("744 more errors"));
}

TEST(CommandStream, ATimeoutNamesTheTicketAndTheStreamGoesOn) {
    Script script;
    Gate gate;
    script.onExecute = [&](ResultSink&) { gate.wait(); };
    auto stream = startScripted(script);
    stream->submit(stream->acquire());
    const Ticket ticket = stream->nextTicket();
    Result<std::vector<std::byte>> bytes = stream->waitReadback(ticket, 20ms);
    ASSERT_FALSE(bytes.ok());
    EXPECT_EQ(bytes.error().code, ErrorCode::Timeout);
    EXPECT_THAT(bytes.error().message, testing::StartsWith(fmt::format("read-back {}: no answer", ticket.value)));
    gate.open();
    stream->waitIdle();
    EXPECT_EQ(script.executed, 1);
}

TEST(CommandStream, TicketsAreNeverReusedEvenAcrossStreams) {
    auto first = startNull();
    auto second = startNull();
    std::vector<uint64_t> values;
    for (int i = 0; i < 4; ++i) {
        values.push_back(first->nextTicket().value);
        values.push_back(second->nextTicket().value);
    }
    EXPECT_THAT(values, testing::Each(testing::Ne(0u)));
    EXPECT_EQ(std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()), values.end());
}

TEST(CommandStream, LiveHandlesCountsAllTypes) {
    auto stream = startNull();
    const BufferHandle buffer = stream->allocateBuffer();
    const PipelineHandle pipeline = stream->allocatePipeline();
    EXPECT_EQ(stream->liveHandles(), 2u);
    stream->free(buffer);
    stream->free(pipeline);
    EXPECT_EQ(stream->liveHandles(), 0u);
    EXPECT_NE(stream->allocateBuffer(), buffer) << "the same index comes back under another generation";
}

TEST(CommandStream, PollsFromManyThreadsWhileFramesRun) {
    Script script;
    auto stream = startScripted(script);
    std::vector<Ticket> tickets;
    for (int i = 0; i < 200; ++i) tickets.push_back(stream->nextTicket());
    std::atomic<size_t> answered{ 0 };
    script.onExecute = [&, next = size_t{ 0 }](ResultSink& sink) mutable {
        sink.onReadback(tickets[next++], std::array{ std::byte{ 5 } });
    };
    std::atomic<size_t> taken{ 0 };
    std::vector<std::thread> pollers;
    for (int i = 0; i < 3; ++i) {
        pollers.emplace_back([&] {
            while (taken < tickets.size()) {
                for (const Ticket ticket : tickets) taken += stream->takeReadback(ticket).has_value();
                std::this_thread::yield();
            }
        });
    }
    for (size_t i = 0; i < tickets.size(); ++i) stream->submit(stream->acquire());
    for (std::thread& poller : pollers) poller.join();
    EXPECT_EQ(taken, tickets.size());
}

TEST(CommandStream, ASteadyFrameAllocatesNothing) {
    auto stream = startNull();
    const BufferHandle buffer = stream->allocateBuffer();
    std::vector<std::byte> bytes(10'000);
    CommandBuffer& first = stream->acquire();
    first.record(
            CmdCreateBuffer{ buffer, { .size = bytes.size(), .usage = BufferUsage::Uniform, .debugName = "frame" } });
    stream->submit(first);
    std::vector<Ticket> timers(1, stream->nextTicket());
    const auto frame = [&](uint64_t number) {
        CommandBuffer& commands = stream->acquire();
        commands.record(CmdBeginFrame{ number });
        commands.record(CmdUpdateBuffer{ buffer, 0, bytes });
        commands.record(CmdBeginTimer{ timers[0] });
        for (uint32_t i = 0; i < 3000; ++i) commands.record(CmdDraw{ .vertexCount = 3 });
        commands.record(CmdEndTimer{ timers[0] });
        commands.record(CmdEndFrame{ number });
        stream->submit(commands);
        static_cast<void>(stream->takeTimer(timers[0]));
    };
    for (uint64_t number = 0; number < 16; ++number) frame(number);
    stream->waitIdle();
    const uint64_t before = allocationCount();
    for (uint64_t number = 0; number < 64; ++number) frame(number);
    stream->waitIdle();
    EXPECT_EQ(allocationCount() - before, 0u);
}

} // namespace
} // namespace filament_core::backend
