// SPDX-License-Identifier: Apache-2.0
// Buffers as resources of a graph: culling, lifetimes, usages, and the rules.
#include "tests/framegraph/AllocationCount.h"
#include "tests/framegraph/GraphFixture.h"

namespace filament_core::framegraph {
namespace {

using namespace backend;

class BufferGraph : public DeviceGraphTest {
protected:
    struct Frame {
        std::vector<BufferDesc> created;
        std::vector<BufferHandle> createdHandles;
        uint32_t destroyed = 0, dispatches = 0;
        void execute(CmdCreateBuffer const& c) {
            created.push_back(c.desc);
            createdHandles.push_back(c.handle);
        }
        void execute(CmdDestroyBuffer const&) { ++destroyed; }
        void execute(CmdUpdateBuffer const&) { ++dispatches; } // stands for the work of a pass
        void execute(auto const&) {}
    };

    Frame frame() {
        const CompiledGraph plan = compile(graph, *pool);
        explained = toText(plan);
        graphviz = toGraphviz(plan);
        CommandBuffer& commands = stream->acquire();
        record(commands, plan);
        Frame seen;
        replay(commands.view(), seen);
        stream->submit(commands);
        graph.reset();
        arena.reset();
        return seen;
    }

    /// A pass that writes `buffer` as storage, without commands.
    void write(std::string_view name, BufferId buffer, Previous previous = Previous::Overwrite) {
        graph.addPass(
                name, [&](PassBuilder& b) { b.writeBuffer(buffer, BufferUse::Storage, previous); },
                [](PassContext&) {});
    }
    /// A pass that draws into the target and reads `buffer`.
    void draw(std::string_view name, BufferId buffer, BufferUse use, TextureId out) {
        graph.addPass(
                name,
                [&](PassBuilder& b) {
                    b.readBuffer(buffer, use);
                    b.writeColor(0, out);
                },
                [](PassContext&) {});
    }

    std::string explained, graphviz;
};

TEST_F(BufferGraph, APassRunsIfSomebodyReadsTheBufferThatItWrites) {
    const BufferId bins = graph.createBuffer("bins", 1024), unread = graph.createBuffer("unread", 64);
    const TextureId out = target();
    write("histogram", bins);
    write("nobody", unread);
    draw("tone map", bins, BufferUse::Uniform, out);
    const Frame seen = frame();
    ASSERT_EQ(seen.created.size(), 1u);
    EXPECT_EQ(seen.created[0].size, 1024u);
    EXPECT_EQ(seen.created[0].usage, BufferUsage::Storage | BufferUsage::Uniform);
    for (const char* line :
         { "0 'histogram' runs: buffer 'bins' is read by 'tone map'", "1 'nobody' culled: nobody reads what it writes",
           "0 'histogram' outside of passes", "'bins' 1024 bytes, groups 0 to 1", "'unread' 64 bytes, unused" }) {
        EXPECT_NE(explained.find(line), std::string::npos) << line << " is not in\n" << explained;
    }
    EXPECT_NE(graphviz.find("p0 -> b0 [label=\"storage\"];"), std::string::npos) << graphviz;
    EXPECT_NE(graphviz.find("b0 -> p2 [label=\"uniforms\"];"), std::string::npos) << graphviz;
}

TEST_F(BufferGraph, WhatIsOverwrittenIsNotWantedWhatIsAddedToIs) {
    for (const Previous previous : { Previous::Overwrite, Previous::Keep }) {
        const BufferId bins = graph.createBuffer("bins", 64);
        graph.markOutput(bins);
        write("first", bins);
        write("second", bins, previous);
        const PassOrder order = cullUnreadPasses(graph);
        EXPECT_EQ(order.decisions[0].runs(), previous == Previous::Keep);
        EXPECT_TRUE(order.decisions[1].runs());
        EXPECT_EQ(order.decisions[1].reason, Reason::WritesOutput);
        EXPECT_EQ(order.decisions[1].becauseBuffer, bins);
        graph.reset();
    }
}

TEST_F(BufferGraph, AnImportedBufferIsAnOutputAndKeepsItsHandle) {
    const BufferHandle outside = stream->allocateBuffer();
    CommandBuffer& commands = stream->acquire();
    commands.record(CmdCreateBuffer{ outside, { .size = 64, .usage = BufferUsage::Storage } });
    stream->submit(commands);
    const BufferId buffer = graph.importBuffer(outside, "exposure", 64, InitialContents::Keep);
    BufferHandle seen;
    graph.addPass(
            "adapt",
            [&](PassBuilder& b) {
                b.readBuffer(buffer, BufferUse::Storage);
                b.writeBuffer(buffer, BufferUse::Storage);
            },
            [&seen, buffer](PassContext& c) { seen = c.buffer(buffer); });
    EXPECT_TRUE(frame().created.empty());
    EXPECT_EQ(seen, outside);
    CommandBuffer& last = stream->acquire();
    stream->destroy(last, outside);
    stream->submit(last);
}

TEST_F(BufferGraph, DisjointBuffersOfOneSizeAndUsageShareMemory) {
    const TextureId out = target();
    BufferId previous = graph.createBuffer("a", 256);
    write("a", previous);
    for (const char* name : { "b", "c", "d" }) {
        const BufferId next = graph.createBuffer(name, 256);
        graph.addPass(
                name,
                [&](PassBuilder& b) {
                    b.readBuffer(previous, BufferUse::Storage);
                    b.writeBuffer(next, BufferUse::Storage, Previous::Overwrite);
                },
                [](PassContext&) {});
        previous = next;
    }
    draw("show", previous, BufferUse::Storage, out);
    frame();
    EXPECT_EQ(pool->bufferCount(), 2u);
    EXPECT_NE(explained.find("'a' 256 bytes, groups 0 to 1, shares memory with 'c'"), std::string::npos) << explained;
}

TEST_F(BufferGraph, WhatNoGraphUsesForAWhileIsDestroyed) {
    const BufferId bins = graph.createBuffer("bins", 64);
    graph.markOutput(bins);
    write("histogram", bins);
    EXPECT_EQ(frame().created.size(), 1u);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(frame().destroyed, 0u);
    EXPECT_EQ(frame().destroyed, 1u);
    EXPECT_EQ(pool->bufferCount(), 0u);
}

TEST_F(BufferGraph, ReadBacksAndUploadsAreUsesToo) {
    const BufferId staging = graph.createBuffer("staging", 16);
    const Ticket ticket = stream->nextTicket();
    graph.addPass(
            "upload", [&](PassBuilder& b) { b.writeBuffer(staging, BufferUse::Transfer, Previous::Overwrite); },
            [=](PassContext& c) {
                const std::array<std::byte, 16> zeros{};
                c.commands().record(CmdUpdateBuffer{ c.buffer(staging), 0, zeros });
            });
    graph.addPass(
            "read-back",
            [&](PassBuilder& b) {
                b.readBuffer(staging, BufferUse::Transfer);
                b.sideEffect();
            },
            [=](PassContext& c) {
                c.commands().record(CmdReadBuffer{ .buffer = c.buffer(staging), .size = 16, .ticket = ticket });
            });
    const Frame seen = frame();
    ASSERT_EQ(seen.created.size(), 1u);
    EXPECT_EQ(seen.created[0].usage, BufferUsage::TransferSource);
    stream->waitIdle();
    EXPECT_EQ(stream->takeReadback(ticket)->size(), 16u);
}

TEST_F(BufferGraph, ASteadyFrameDoesNotAllocate) {
    CommandBuffer commands;
    const auto once = [&] {
        const BufferId bins = graph.createBuffer("bins", 64);
        graph.markOutput(bins);
        write("histogram", bins);
        const CompiledGraph plan = compile(graph, *pool);
        commands.reset();
        record(commands, plan);
        graph.reset();
        arena.reset();
    };
    once();
    CommandBuffer& first = stream->acquire(); // the driver must see the creations before destroyAll()
    first.append(std::move(commands));
    stream->submit(first);
    for (int i = 0; i < 3; ++i) once();
    const uint64_t before = allocationCount();
    ASSERT_GT(before, 0u);
    for (int i = 0; i < 10; ++i) once();
    EXPECT_EQ(allocationCount() - before, 0u);
}

using BufferGraphDeathTest = BufferGraph;

TEST_F(BufferGraphDeathTest, ReadingWithoutAWriter) {
    const BufferId bins = graph.createBuffer("bins", 64);
    draw("tone map", bins, BufferUse::Uniform, backbuffer());
    EXPECT_DEATH(checkDeclarations(graph), "pass 'tone map' reads buffer 'bins', which no pass writes");
    graph.reset();
    const BufferId late = graph.createBuffer("late", 64);
    draw("tone map", late, BufferUse::Uniform, backbuffer());
    write("histogram", late);
    EXPECT_DEATH(checkDeclarations(graph), "pass 'tone map' reads buffer 'late' before pass 'histogram' writes it");
}

TEST_F(BufferGraphDeathTest, WritingInTheWrongWayOrPlace) {
    const BufferId bins = graph.createBuffer("bins", 64);
    const TextureId out = backbuffer();
    pass("draw", [&](PassBuilder& p) {
        p.writeColor(0, out);
        p.writeBuffer(bins, BufferUse::Storage);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'draw': has attachments and writes buffer 'bins'");
    graph.reset();
    const BufferId vertices = graph.createBuffer("vertices", 64);
    pass("fill", [&](PassBuilder& p) { p.writeBuffer(vertices, BufferUse::Vertex); });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'fill': writes buffer 'vertices', but not as storage");
    graph.reset();
    const BufferId cleared = graph.createBuffer("cleared", 64);
    pass("clear", [&](PassBuilder& p) { p.writeBuffer(cleared, BufferUse::Storage, Previous::Clear); });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'clear': buffer 'cleared' cannot be cleared");
}

TEST_F(BufferGraphDeathTest, ForgottenNamesSizesAndHandles) {
    EXPECT_DEATH(graph.createBuffer("", 4), "a buffer of a frame graph has a name");
    EXPECT_DEATH(graph.createBuffer("empty", 0), "buffer 'empty': needs at least one byte");
    EXPECT_DEATH(graph.importBuffer({}, "lost", 4, InitialContents::Keep), "buffer 'lost': imported without a handle");
    EXPECT_DEATH(pass("stray", [&](PassBuilder& p) { p.readBuffer(BufferId{ 9 }, BufferUse::Storage); }),
                 "pass 'stray': declares a buffer of another graph");
}

TEST_F(BufferGraphDeathTest, UsingABufferThatThePassDidNotDeclare) {
    const BufferId bins = graph.createBuffer("bins", 64), other = graph.createBuffer("other", 64);
    graph.markOutput(bins);
    graph.addPass(
            "histogram", [&](PassBuilder& b) { b.writeBuffer(bins, BufferUse::Storage); },
            [=](PassContext& c) { c.buffer(other); });
    EXPECT_DEATH(frame(), "pass 'histogram': uses buffer 'other' without having declared it");
}

} // namespace
} // namespace filament_core::framegraph
