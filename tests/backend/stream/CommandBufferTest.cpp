// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/CommandBuffer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace filament_core::backend {
namespace {

/// Executes nothing; records the order of the commands.
struct Listener {
    std::vector<uint32_t> ids;
    std::vector<CmdDraw> draws;
    std::vector<std::string> names;
    std::vector<std::vector<std::byte>> payloads;

    template <class C>
    void execute(C const& command) {
        ids.push_back(kCommandId<C>);
        if constexpr (std::same_as<C, CmdDraw>) draws.push_back(command);
        if constexpr (std::same_as<C, CmdPushGroup>) names.emplace_back(command.name);
        if constexpr (std::same_as<C, CmdUpdateBuffer>)
            payloads.emplace_back(command.bytes.begin(), command.bytes.end());
    }
};

Listener listen(CommandBuffer const& commands) {
    Listener listener;
    replay(commands.view(), listener);
    return listener;
}

std::vector<std::byte> numbered(size_t count, uint32_t seed) {
    std::vector<std::byte> bytes(count);
    for (size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>((i * 31 + seed) & 0xFF);
    return bytes;
}

TEST(CommandBuffer, ReplaysCommandsInTheOrderOfRecordingAcrossChunks) {
    CommandBuffer commands;
    constexpr uint32_t kCount = 20'000; // about 1 MB: many chunks
    for (uint32_t i = 0; i < kCount; ++i) commands.record(CmdDraw{ .vertexCount = i });
    const Listener heard = listen(commands);
    ASSERT_EQ(heard.draws.size(), kCount);
    for (uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(heard.draws[i].vertexCount, i);
    EXPECT_GT(commands.view().size(), 1u);
    EXPECT_EQ(commands.commandCount(), kCount);
}

TEST(CommandBuffer, CopiesNamesAndPayloadsSoThatTheCallersMemoryMayGo) {
    CommandBuffer commands;
    {
        std::string name = "a group whose name dies before the replay";
        std::vector<std::byte> bytes = numbered(1000, 7);
        commands.record(CmdPushGroup{ name });
        commands.record(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = bytes });
        std::fill(name.begin(), name.end(), '#');
        std::fill(bytes.begin(), bytes.end(), std::byte{ 0 });
    }
    const Listener heard = listen(commands);
    EXPECT_THAT(heard.names, testing::ElementsAre("a group whose name dies before the replay"));
    EXPECT_THAT(heard.payloads, testing::ElementsAre(numbered(1000, 7)));
}

// After adoption every span and name of every command, at any depth, must point elsewhere.
struct PayloadsOutside {
    uintptr_t begin, end;
    int outside = 0, inside = 0;

    void place(const void* data) {
        const auto at = reinterpret_cast<uintptr_t>(data);
        (at >= begin && at < end ? inside : outside) += 1;
    }
    template <class T>
    void visit(T const& value) {
        if constexpr (std::same_as<T, std::string_view> || kIsSpan<T>)
            place(value.data());
        else if constexpr (HasFields<T>)
            visitFields(value, [&](const char*, auto const& field) { visit(field); });
    }
};

struct PointIntoScratch {
    std::vector<std::byte>& scratch;
    template <class T>
    void visit(T& value) {
        if constexpr (std::same_as<T, std::string_view>) {
            value = { reinterpret_cast<const char*>(scratch.data()), 5 };
        } else if constexpr (kIsSpan<T>) {
            value = { reinterpret_cast<typename T::pointer>(scratch.data()), 3 };
        } else if constexpr (HasFields<T>) {
            visitFields(value, [&](const char*, auto& field) { visit(field); });
        }
    }
};

struct ScratchChecker {
    uintptr_t begin, end;
    int adopted = 0;
    template <class C>
    void execute(C const& command) {
        PayloadsOutside places{ begin, end };
        places.visit(command);
        EXPECT_EQ(places.inside, 0) << kFields<C>.name;
        adopted += places.outside;
    }
};

template <class... C>
int recordAllWithScratch(CommandBuffer& commands, std::vector<std::byte>& scratch, TypeList<C...>) {
    int payloadCommands = 0;
    const auto one = [&]<class Command>(Command command) {
        PointIntoScratch{ scratch }.visit(command);
        payloadCommands += kHasPayload<Command>;
        commands.record(command);
    };
    (one(C{}), ...);
    return payloadCommands;
}

TEST(CommandBuffer, AdoptsEveryPayloadFieldOfEveryCommand) {
    std::vector<std::byte> scratch(256);
    CommandBuffer commands;
    EXPECT_EQ(recordAllWithScratch(commands, scratch, Commands{}), 10); // 6 names, program, 2 byte spans, group
    const auto begin = reinterpret_cast<uintptr_t>(scratch.data());
    ScratchChecker checker{ begin, begin + scratch.size() };
    replay(commands.view(), checker);
    EXPECT_EQ(checker.adopted, 15); // 8 names, 4 spans of the program, 1 of the bind group, 2 of bytes
}

TEST(CommandBuffer, CarriesPayloadsLargerThanAChunkAndTinyOnesAtAnyAlignment) {
    CommandBuffer commands;
    std::vector<std::vector<std::byte>> expected;
    for (const size_t size :
         { size_t{ 1 }, size_t{ 65'535 }, size_t{ 65'536 }, size_t{ 65'537 }, size_t{ 3'000'000 }, size_t{ 2 } }) {
        expected.push_back(numbered(size, static_cast<uint32_t>(size)));
        commands.record(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = expected.back() });
    }
    EXPECT_EQ(listen(commands).payloads, expected);
    for (const size_t alignment : { 1u, 2u, 4u, 16u, 64u }) {
        const auto span = commands.allocate(3, alignment);
        EXPECT_EQ(reinterpret_cast<uintptr_t>(span.data()) % alignment, 0u);
    }
}

TEST(CommandBuffer, RecordAdoptedKeepsTheSpanThatAllocateGave) {
    CommandBuffer commands;
    const std::span<std::byte> bytes = commands.allocate(64);
    std::fill(bytes.begin(), bytes.end(), std::byte{ 42 });
    commands.recordAdopted(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = bytes });
    auto const& chunk = commands.view().front();
    auto const* command = reinterpret_cast<CmdUpdateBuffer const*>(chunk.data + kCommandAlignment);
    EXPECT_EQ(command->bytes.data(), bytes.data());
}

TEST(CommandBuffer, KeepsGivenPayloadsWithoutACopyUntilReset) {
    const auto payload = std::make_shared<const std::vector<std::byte>>(numbered(100'000, 3));
    CommandBuffer frame;
    {
        CommandBuffer pending;
        pending.keep(payload);
        pending.recordAdopted(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = *payload });
        frame.append(std::move(pending));
    } // with the frame now
    CommandBuffer moved(std::move(frame));
    EXPECT_EQ(payload.use_count(), 2);
    EXPECT_LT(moved.bytesReserved(), payload->size() + 64 * 1024);
    EXPECT_THAT(listen(moved).payloads, testing::ElementsAre(*payload));
    moved.reset();
    EXPECT_EQ(payload.use_count(), 1);
}

TEST(CommandBuffer, AppendJoinsBuffersInOrderAndEmptiesTheTail) {
    CommandBuffer head, tail, empty;
    head.record(CmdPushGroup{ "head" });
    tail.record(CmdPushGroup{ "tail" });
    tail.record(CmdDraw{ .vertexCount = 3 });
    head.append(std::move(empty));
    head.append(std::move(tail));
    head.record(CmdPushGroup{ "after" });
    EXPECT_THAT(listen(head).names, testing::ElementsAre("head", "tail", "after"));
    EXPECT_EQ(head.commandCount(), 4u);
    EXPECT_EQ(tail.commandCount(), 0u);
    EXPECT_TRUE(tail.view().empty());
    tail.record(CmdDraw{ .vertexCount = 9 });
    EXPECT_EQ(listen(tail).draws.size(), 1u) << "a tail can be recorded into again";
}

TEST(CommandBuffer, SteadyFramesReserveNothingNew) {
    CommandBuffer head;
    std::vector<CommandBuffer> tails(3);
    const std::vector<std::byte> large = numbered(200'000, 1);
    const auto frame = [&] {
        head.reset();
        for (CommandBuffer& tail : tails) {
            for (uint32_t i = 0; i < 5000; ++i) tail.record(CmdDraw{ .vertexCount = i });
            tail.record(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = large });
        }
        for (CommandBuffer& tail : tails) head.append(std::move(tail));
        size_t reserved = head.bytesReserved();
        for (CommandBuffer const& tail : tails) reserved += tail.bytesReserved();
        return reserved;
    };
    for (int warm = 0; warm < 4; ++warm) frame();
    const size_t reserved = frame();
    for (int i = 0; i < 20; ++i) ASSERT_EQ(frame(), reserved) << "frame " << i;
}

TEST(CommandBuffer, ContainsTellsWhatWasRecordedUntilReset) {
    CommandBuffer head, tail;
    head.record(CmdDraw{});
    tail.record(CmdEndFrame{});
    EXPECT_TRUE(head.contains<CmdDraw>());
    EXPECT_FALSE(head.contains<CmdEndFrame>());
    head.append(std::move(tail));
    EXPECT_TRUE(head.contains<CmdEndFrame>());
    EXPECT_FALSE(tail.contains<CmdEndFrame>());
    CommandBuffer moved(std::move(head));
    EXPECT_TRUE(moved.contains<CmdDraw>());
    moved.reset();
    EXPECT_FALSE(moved.contains<CmdDraw>());
}

TEST(CommandBuffer, ATailGetsABlockBackForEachOneItGaveAndNoLargerOne) {
    constexpr size_t kBlock = 64 * 1024;
    CommandBuffer head, tail;
    head.record(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = numbered(5'000'000, 0) });
    head.record(CmdDraw{});
    head.reset(); // one block for commands and a large one, both to spare
    tail.record(CmdDraw{});
    head.append(std::move(tail));
    EXPECT_EQ(tail.bytesReserved(), kBlock);
    tail.record(CmdDraw{});
    head.append(std::move(tail));
    EXPECT_EQ(tail.bytesReserved(), 0u) << "only the large block is to spare, and it stays";
    EXPECT_GE(head.bytesReserved(), 5'000'000u);
}

// Lists of visible lights, say: a little longer in some frames than in others.
TEST(CommandBuffer, PayloadsOfChangingSizeReserveNothingNew) {
    CommandBuffer commands;
    const std::vector<std::byte> most = numbered(120'000, 0);
    const auto frame = [&](size_t i) {
        const auto bytes = std::span(most).first(i % 7 == 0 ? 1000 : 90'000 + 1777 * i % 30'000);
        commands.record(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = bytes });
        commands.reset();
        return commands.bytesReserved();
    };
    for (size_t warm = 0; warm < 32; ++warm) frame(warm);
    const size_t reserved = frame(32);
    for (size_t i = 0; i < 500; ++i) ASSERT_EQ(frame(i), reserved) << "frame " << i;
}

TEST(CommandBuffer, GivesALargerChunkBackAfterManyFramesWithoutIt) {
    CommandBuffer commands;
    commands.record(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = numbered(200'000, 0) });
    commands.reset();
    const size_t reserved = commands.bytesReserved();
    for (uint32_t i = 1; i <= CommandBuffer::kIdleFrames; ++i) {
        EXPECT_EQ(commands.bytesReserved(), reserved) << i;
        commands.reset();
    }
    EXPECT_LT(commands.bytesReserved(), 200'000u);
}

TEST(CommandBuffer, GivesAnOversizedChunkBackAfterOneFrameWithoutIt) {
    CommandBuffer commands;
    commands.record(CmdUpdateBuffer{ .buffer = {}, .offset = 0, .bytes = numbered(10'000'000, 0) });
    commands.reset();
    EXPECT_GE(commands.bytesReserved(), 10'000'000u) << "kept for the next frame";
    commands.record(CmdDraw{});
    commands.reset();
    EXPECT_LT(commands.bytesReserved(), 10'000'000u);
}

TEST(CommandBuffer, MovingLeavesAnEmptyBufferThatWorks) {
    CommandBuffer from;
    from.record(CmdDraw{ .vertexCount = 1 });
    CommandBuffer to(std::move(from));
    from.record(CmdDraw{ .vertexCount = 2 });
    EXPECT_EQ(listen(to).draws.at(0).vertexCount, 1u);
    EXPECT_EQ(listen(from).draws.at(0).vertexCount, 2u);
}

TEST(CommandBuffer, RollingBackForgetsExactlyTheCommandsSinceTheMark) {
    for (const uint32_t before : { 0u, 1u, 1000u, 5000u }) { // in an empty buffer, in the first block, in later ones
        for (const uint32_t after : { 1u, 10'000u }) {
            CommandBuffer commands;
            for (uint32_t i = 0; i < before; ++i) commands.record(CmdDraw{ .vertexCount = i });
            const CommandBuffer::Mark mark = commands.mark();
            for (uint32_t i = 0; i < after; ++i) commands.record(CmdDraw{ .vertexCount = 77 });
            commands.rollBack(mark);
            EXPECT_EQ(commands.commandCount(), before);
            commands.record(CmdDraw{ .vertexCount = before });
            const Listener heard = listen(commands);
            ASSERT_EQ(heard.draws.size(), before + 1);
            for (uint32_t i = 0; i <= before; ++i) ASSERT_EQ(heard.draws[i].vertexCount, i);
        }
    }
}

TEST(CommandBuffer, RollingBackReachesBehindAJoinedTail) {
    CommandBuffer head, tail;
    head.record(CmdDraw{ .vertexCount = 1 });
    const CommandBuffer::Mark mark = head.mark();
    for (int i = 0; i < 5000; ++i) tail.record(CmdDraw{ .vertexCount = 2 });
    head.append(std::move(tail));
    head.rollBack(mark);
    head.record(CmdDraw{ .vertexCount = 3 });
    const Listener heard = listen(head);
    ASSERT_EQ(heard.draws.size(), 2u);
    EXPECT_EQ(heard.draws[1].vertexCount, 3u);
}

TEST(CommandBuffer, TheReserveTakesTheEndsOfAFrameWhereverItsBlockEnds) {
    for (uint32_t draws = 1; draws < 6000; draws += 7) {
        CommandBuffer commands;
        for (uint32_t i = 0; i < draws; ++i) commands.record(CmdDraw{ .vertexCount = i });
        const size_t reserved = commands.bytesReserved();
        ASSERT_TRUE(commands.recordInReserve(CmdPopGroup{}));
        ASSERT_TRUE(commands.recordInReserve(CmdEndTimer{}));
        ASSERT_TRUE(commands.recordInReserve(CmdEndFrame{}));
        ASSERT_EQ(commands.bytesReserved(), reserved) << "it allocated";
        const Listener heard = listen(commands);
        ASSERT_EQ(heard.draws.size(), draws);
        ASSERT_EQ(heard.ids.size(), draws + 3);
        ASSERT_EQ(heard.ids.back(), kCommandId<CmdEndFrame>);
    }
}

TEST(CommandBuffer, AnEmptyBufferHasNoReserve) {
    CommandBuffer commands;
    EXPECT_FALSE(commands.recordInReserve(CmdEndFrame{}));
    EXPECT_EQ(commands.commandCount(), 0u);
}

TEST(CommandBuffer, SurvivesRandomMixesOfRecordingJoiningAndResetting) {
    std::mt19937 random(1);
    CommandBuffer head, tail;
    std::vector<uint32_t> expected, expectedTail;
    for (uint32_t step = 0; step < 50'000; ++step) {
        const auto dice = static_cast<uint32_t>(random() % 1000);
        if (dice < 600) {
            head.record(CmdDraw{ .vertexCount = step });
            expected.push_back(step);
        } else if (dice < 990) {
            tail.record(CmdDraw{ .vertexCount = step });
            expectedTail.push_back(step);
            if (dice % 7 == 0) static_cast<void>(tail.allocate(random() % 5000, 1u << (random() % 7)));
        } else if (dice < 997) {
            head.append(std::move(tail));
            expected.insert(expected.end(), expectedTail.begin(), expectedTail.end());
            expectedTail.clear();
        } else {
            const Listener heard = listen(head);
            ASSERT_EQ(heard.draws.size(), expected.size());
            ASSERT_TRUE(std::ranges::equal(heard.draws, expected, {}, &CmdDraw::vertexCount));
            head.reset();
            expected.clear();
        }
    }
}

} // namespace
} // namespace filament_core::backend
