// SPDX-License-Identifier: Apache-2.0
// Recording in ranges: the same stream whichever thread records, and no allocations once every buffer has been used.
#include "backend/stream/StreamHash.h"
#include "tests/framegraph/AllocationCount.h"
#include "tests/framegraph/GraphFixture.h"

#include <atomic>
#include <numeric>
#include <string>

namespace filament_core::framegraph {
namespace {

using namespace backend;

/// Commands of several sizes, with payloads; a range opens a group, so that the stream shows where ranges begin.
void recordItems(CommandBuffer& commands, size_t begin, size_t end) {
    commands.record(CmdPushGroup{ "items from " + std::to_string(begin) });
    for (size_t i = begin; i < end; ++i) {
        const auto number = static_cast<uint32_t>(i);
        commands.record(CmdDraw{ .vertexCount = number });
        if (i % 3 == 0) commands.record(CmdBindGroup{ .group = {}, .index = 1, .dynamicCount = 1 });
        if (i % 7 == 0) commands.record(CmdUpdateBuffer{ {}, i, std::as_bytes(std::span(&number, 1)) });
    }
    commands.record(CmdPopGroup{});
}

struct DrawsInOrder {
    uint32_t next = 0;
    std::vector<std::string> groups;
    void execute(CmdDraw const& command) { EXPECT_EQ(command.vertexCount, next++); }
    void execute(CmdPushGroup const& command) { groups.emplace_back(command.name); }
    void execute(auto const&) {}
};

class RangesWithWorkers : public testing::TestWithParam<int> {
protected:
    jobs::JobSystem jobs{ { .workers = GetParam() } };
    RangeRecorder recorder{ jobs };
};
INSTANTIATE_TEST_SUITE_P(RangeRecorder, RangesWithWorkers, testing::Values(0, 1, 2, 3, 16),
                         [](auto const& workers) { return std::to_string(workers.param) + "Workers"; });

TEST_P(RangesWithWorkers, TheStreamIsTheOneRecordedInTurn) {
    for (const size_t count : { 0u, 1u, 99u, 100u, 101u, 2500u, 40'000u }) {
        CommandBuffer inTurn, commands;
        inTurn.record(CmdPushGroup{ "before" });
        recordRangesInTurn(inTurn, count, 100, recordItems);
        inTurn.record(CmdPopGroup{});
        for (int repeat = 0; repeat < 5; ++repeat) {
            commands.reset();
            commands.record(CmdPushGroup{ "before" });
            recorder.record(commands, count, 100, recordItems);
            commands.record(CmdPopGroup{});
            ASSERT_EQ(hashStream(commands.view()), hashStream(inTurn.view())) << count << " items";
            ASSERT_EQ(commands.commandCount(), inTurn.commandCount());
        }
    }
}

TEST_P(RangesWithWorkers, EveryItemIsRecordedOnceAndRangesFollowFromTheCountAlone) {
    CommandBuffer commands;
    recorder.record(commands, 1050, 500, recordItems);
    DrawsInOrder seen;
    replay(commands.view(), seen);
    EXPECT_EQ(seen.next, 1050u);
    EXPECT_EQ(seen.groups, (std::vector<std::string>{ "items from 0", "items from 500", "items from 1000" }));
}

// Like a stream with two frames ahead: three buffers take turns with one recorder.
TEST_P(RangesWithWorkers, ASteadyFrameAllocatesNothing) {
    std::array<CommandBuffer, 3> frames;
    const auto draws = [](CommandBuffer& commands, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) commands.record(CmdDraw{ .vertexCount = static_cast<uint32_t>(i) });
    };
    const std::vector<std::byte> upload(300'000);
    const auto frame = [&](size_t number) {
        CommandBuffer& commands = frames[number % frames.size()];
        commands.reset();
        commands.record(CmdUpdateBuffer{ {}, 0, upload });
        recorder.record(commands, 20'000 + number % 2 * 10'000, 1024, draws);
    };
    for (size_t number = 0; number < 24; ++number) frame(number);
    const uint64_t before = allocationCount();
    for (size_t number = 24; number < 60; ++number) frame(number);
    EXPECT_EQ(allocationCount() - before, 0u);
}

class RecordRanges : public DeviceGraphTest, public testing::WithParamInterface<int> {
protected:
    /// A frame whose pass records 10 000 draws in ranges.
    uint64_t frameHash(RangeRecorder* ranges) {
        const TextureId out = target();
        graph.addPass(
                "draw", [&](PassBuilder& b) { b.writeColor(0, out, { .clear = std::array<float, 4>{} }); },
                [](PassContext& pass) {
                    pass.recordRanges(10'000, 1000, [](CommandBuffer& commands, size_t begin, size_t end) {
                        for (size_t i = begin; i < end; ++i)
                            commands.record(CmdSetScissor{ { 0, 0, static_cast<uint32_t>(i % 64), 1 } });
                    });
                });
        const CompiledGraph plan = compile(graph, *pool);
        CommandBuffer& commands = stream->acquire();
        record(commands, plan, nullptr, ranges);
        const uint64_t hash = hashStream(commands.view());
        EXPECT_GT(commands.commandCount(), 10'000u);
        stream->submit(commands);
        graph.reset();
        arena.reset();
        return hash;
    }
};
INSTANTIATE_TEST_SUITE_P(Record, RecordRanges, testing::Values(0, 1, 2, 3, 16),
                         [](auto const& workers) { return std::to_string(workers.param) + "Workers"; });

TEST_P(RecordRanges, APassRecordsTheSameStreamWithAndWithoutARangeRecorder) {
    jobs::JobSystem jobs{ { .workers = GetParam() } };
    RangeRecorder ranges(jobs);
    const uint64_t expected = frameHash(nullptr);
    for (int frame = 0; frame < 5; ++frame) ASSERT_EQ(frameHash(&ranges), expected) << "frame " << frame;
}

} // namespace
} // namespace filament_core::framegraph
