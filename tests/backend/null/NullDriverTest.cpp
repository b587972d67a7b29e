// SPDX-License-Identifier: Apache-2.0
#include "backend/null/NullDriver.h"

#include "backend/stream/CommandBuffer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace filament_core::backend {
namespace {

struct Answers final : ResultSink {
    std::map<uint64_t, std::vector<std::byte>> readbacks;
    std::map<uint64_t, uint64_t> timers;
    void onReadback(Ticket ticket, std::span<const std::byte> bytes) override {
        readbacks[ticket.value] = { bytes.begin(), bytes.end() };
    }
    void onTimer(Ticket ticket, uint64_t nanoseconds) override { timers[ticket.value] = nanoseconds; }
    void onError(DriverErrorKind, std::string_view message) override { ADD_FAILURE() << message; }
};

class NullDriver : public testing::Test {
protected:
    Answers mAnswers;
    std::unique_ptr<Driver> mDriver = createNullDriver(mAnswers);
    CommandBuffer mCommands;

    void execute() {
        mDriver->execute(mCommands.view());
        mCommands.reset();
    }
};

TEST_F(NullDriver, CountsDeviceBytesOverAllLevelsLayersAndSamples) {
    const auto first = TextureHandle::make(1, 1), second = TextureHandle::make(2, 1);
    mCommands.record(
            CmdCreateTexture{ first, { .format = Format::RGBA8, .levels = 3, .layers = 2, .width = 4, .height = 2 } });
    mCommands.record(CmdCreateTexture{ second, { .format = Format::RGBA16F, .samples = 4, .width = 3, .height = 1 } });
    mCommands.record(CmdCreateBuffer{ BufferHandle::make(1, 1), { .size = 1000 } });
    execute();
    const uint64_t chain = (4 * 2 + 2 * 1 + 1 * 1) * 4 * 2;
    EXPECT_EQ(mDriver->statistics().deviceBytes, chain + 3 * 8 * 4 + 1000);
    mCommands.record(CmdDestroyTexture{ first });
    mCommands.record(CmdDestroyTexture{ second });
    mCommands.record(CmdDestroyTexture{ second }); // a broken stream: ignored
    mCommands.record(CmdDestroyBuffer{ BufferHandle::make(1, 1) });
    execute();
    EXPECT_EQ(mDriver->statistics().deviceBytes, 0u);
}

TEST_F(NullDriver, CountsCommandsDrawsPassesAndCreations) {
    mCommands.record(CmdCreateProgram{});
    mCommands.record(CmdCreatePipeline{});
    mCommands.record(CmdBeginPass{});
    mCommands.record(CmdDraw{});
    mCommands.record(CmdDrawIndexed{});
    mCommands.record(CmdEndPass{});
    execute();
    const DriverStatistics statistics = mDriver->statistics();
    EXPECT_EQ(statistics.commands, 6u);
    EXPECT_EQ(statistics.draws, 2u);
    EXPECT_EQ(statistics.passes, 1u);
    EXPECT_EQ(statistics.programsCreated, 1u);
    EXPECT_EQ(statistics.pipelinesCreated, 1u);
}

TEST_F(NullDriver, AnswersReadbacksWithZerosOfTheSizeOfTheRectangleAtTheEndOfAFrame) {
    const auto color = TextureHandle::make(1, 1), depth = TextureHandle::make(2, 1), block = TextureHandle::make(3, 1);
    mCommands.record(CmdCreateTexture{ color, { .format = Format::RGBA16F, .width = 8, .height = 8 } });
    mCommands.record(CmdCreateTexture{ depth, { .format = Format::D32FS8, .width = 8, .height = 8 } });
    mCommands.record(CmdCreateTexture{ block, { .format = Format::BC1, .width = 8, .height = 8 } });
    mCommands.record(CmdReadTexture{ .texture = color, .rect = { 1, 1, 3, 5 }, .ticket = { 1 } });
    mCommands.record(CmdReadTexture{ .texture = depth, .rect = { 0, 0, 2, 2 }, .ticket = { 2 } });
    mCommands.record(CmdReadTexture{ .texture = block, .rect = { 0, 0, 8, 8 }, .ticket = { 3 } });
    mCommands.record(CmdReadTexture{ .texture = TextureHandle::make(9, 9), .rect = { 0, 0, 8, 8 }, .ticket = { 4 } });
    execute();
    EXPECT_TRUE(mAnswers.readbacks.empty()) << "not before the frame ends";
    mCommands.record(CmdEndFrame{ 1 });
    execute();
    ASSERT_EQ(mAnswers.readbacks.size(), 4u);
    EXPECT_TRUE(mAnswers.readbacks[4].empty()) << "there is no such texture";
    EXPECT_EQ(mAnswers.readbacks[1].size(), 3u * 5u * 8u);
    EXPECT_EQ(mAnswers.readbacks[2].size(), 2u * 2u * 4u) << "depth reads back as D32F";
    EXPECT_EQ(mAnswers.readbacks[3].size(), 2u * 2u * 8u) << "4 blocks";
    EXPECT_THAT(mAnswers.readbacks[1], testing::Each(std::byte{ 0 }));
}

TEST_F(NullDriver, AnswersTimersWithZeroOnceAndIdlingAnswersToo) {
    mCommands.record(CmdBeginTimer{ { 7 } });
    mCommands.record(CmdEndTimer{ { 7 } });
    execute();
    EXPECT_TRUE(mAnswers.timers.empty());
    mDriver->waitIdle();
    EXPECT_THAT(mAnswers.timers, testing::ElementsAre(testing::Pair(7u, 0u)));
    mAnswers.timers.clear();
    mDriver->waitIdle();
    EXPECT_TRUE(mAnswers.timers.empty());
}

TEST_F(NullDriver, OffersEverythingThatLayersAboveMayWantToTest) {
    EXPECT_EQ(mDriver->info().backend, Backend::Null);
    EXPECT_TRUE(mDriver->info().features.mergedPasses);
    EXPECT_TRUE(mDriver->info().features.blockCompression);
    EXPECT_GE(mDriver->info().limits.maxTextureSize, 8192u);
}

} // namespace
} // namespace filament_core::backend
