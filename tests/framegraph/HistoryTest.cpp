// SPDX-License-Identifier: Apache-2.0
// Pictures that are kept from frame to frame: which texture is the previous one, when it is cleared, when it is
// destroyed.
#include "tests/framegraph/AllocationCount.h"
#include "tests/framegraph/GraphFixture.h"

namespace filament_core::framegraph {
namespace {

using namespace backend;

/// The passes, clears and textures of a stream.
struct Seen {
    std::vector<PassDesc> passes;
    std::vector<std::string> names; // of the passes; their own texts end with the graph
    uint32_t created = 0, destroyed = 0;
    void execute(CmdBeginPass const& c) {
        passes.push_back(c.desc);
        names.emplace_back(c.desc.debugName);
    }
    void execute(CmdCreateTexture const&) { ++created; }
    void execute(CmdDestroyTexture const&) { ++destroyed; }
    void execute(auto const&) {}
};

struct Frame {
    bool reads = true, writes = true;
    uint32_t width = 64;
    Format format = Format::RGBA16F;
    uint8_t levels = 1;
    std::string_view name = "taa";
    bool beginsAnew = false;
};

class HistoryTest : public DeviceGraphTest {
protected:
    /// A pass that reads the previous image, and one that writes the current one, as the frame requests.
    Seen frame(Frame const& what = {}) {
        const TextureId out = target();
        const History taa = graph.history(
                { .width = what.width, .height = 32, .format = what.format, .levels = what.levels, .name = what.name },
                { 0.25f, 0.5f, 0, 1 }, what.beginsAnew);
        previous = current = {};
        age = 99;
        if (what.writes) {
            graph.addPass(
                    "write",
                    [&](PassBuilder& b) {
                        if (hasDepth(what.format))
                            b.writeDepth(taa.current, { .overwrites = true });
                        else
                            b.writeColor(0, taa.current, { .overwrites = true });
                    },
                    [=, this](PassContext& c) { current = c.texture(taa.current); });
        }
        if (what.reads) {
            graph.addPass(
                    "show",
                    [&](PassBuilder& b) {
                        b.readSampled(taa.previous);
                        b.writeColor(0, out);
                    },
                    [=, this](PassContext& c) {
                        previous = c.texture(taa.previous);
                        age = c.historyAge(taa.previous);
                    });
        }
        return run();
    }

    Seen run() {
        const CompiledGraph plan = compile(graph, *pool);
        explained = toText(plan);
        CommandBuffer& commands = stream->acquire();
        record(commands, plan);
        Seen seen;
        replay(commands.view(), seen);
        stream->submit(commands);
        graph.reset();
        arena.reset();
        return seen;
    }

    TextureHandle previous, current; // previous: of the last graph
    uint32_t age = 0;
    std::string explained;
};

TEST_F(HistoryTest, TheFirstFrameReadsTheClearValueAndIsToldSo) {
    const Seen seen = frame();
    EXPECT_EQ(age, 0u);
    ASSERT_EQ(seen.passes.size(), 3u);
    EXPECT_EQ(seen.names[0], "previous taa");
    EXPECT_EQ(seen.passes[0].colors[0].texture, previous);
    EXPECT_EQ(seen.passes[0].colors[0].load, LoadOp::Clear);
    EXPECT_EQ(seen.passes[0].colors[0].clear, (std::array<float, 4>{ 0.25f, 0.5f, 0, 1 }));
    EXPECT_NE(previous, current);
    EXPECT_NE(explained.find("'previous taa' 64 x 32 RGBA16F, history, groups 1 to 1, no frame before: cleared"),
              std::string::npos)
            << explained;
    EXPECT_NE(explained.find("'taa' 64 x 32 RGBA16F, history, groups 0 to 0, kept for the next frame"),
              std::string::npos)
            << explained;
}

TEST_F(HistoryTest, WhatAFrameWritesIsWhatTheNextOneReads) {
    frame();
    for (int i = 0; i < 5; ++i) {
        const TextureHandle written = current;
        const Seen seen = frame();
        EXPECT_EQ(previous, written);
        EXPECT_EQ(age, 1u);
        EXPECT_EQ(seen.passes.size(), 2u) << "nothing is cleared";
        EXPECT_EQ(seen.created, 0u);
        EXPECT_NE(explained.find("written 1 graph(s) ago"), std::string::npos) << explained;
    }
}

TEST_F(HistoryTest, AFrameThatDoesNotWriteKeepsTheOlderPicture) {
    frame();
    const TextureHandle written = current;
    frame({ .writes = false });
    EXPECT_EQ(previous, written);
    EXPECT_EQ(age, 1u);
    frame({ .reads = false, .writes = false }); // declared, not used
    frame({ .writes = false });
    EXPECT_EQ(previous, written);
    EXPECT_EQ(age, 3u);
}

TEST_F(HistoryTest, AFrameThatOnlyWritesIsReadLater) {
    Seen seen = frame({ .reads = false });
    EXPECT_EQ(seen.passes.size(), 1u) << "nobody reads the previous picture: nothing to clear";
    const TextureHandle written = current;
    seen = frame();
    EXPECT_EQ(previous, written);
    EXPECT_EQ(seen.passes.size(), 2u);
}

TEST_F(HistoryTest, AnotherDescriptionStartsAnew) {
    frame();
    for (Frame const& changed : { Frame{ .width = 128 }, Frame{ .format = Format::RGBA8 }, Frame{ .levels = 2 } }) {
        const TextureHandle written = current;
        Seen seen = frame(changed);
        EXPECT_EQ(age, 0u);
        EXPECT_NE(previous, written);
        EXPECT_EQ(seen.created, 2u);
        EXPECT_EQ(seen.destroyed, 2u) << "the old ones go at once";
        seen = frame({});
        EXPECT_EQ(age, 0u);
    }
    EXPECT_EQ(pool->historyCount(), 1u);
}

TEST_F(HistoryTest, EveryLevelAndLayerIsCleared) {
    const TextureId out = target();
    const History cube = graph.history({ .width = 8,
                                         .height = 8,
                                         .format = Format::RGBA16F,
                                         .levels = 3,
                                         .layers = 6,
                                         .type = TextureKind::Cube,
                                         .name = "probe" });
    graph.addPass(
            "show",
            [&](PassBuilder& b) {
                b.readSampled(cube.previous);
                b.writeColor(0, out);
            },
            [](PassContext&) {});
    const Seen seen = run();
    ASSERT_EQ(seen.passes.size(), 3u * 6u + 1u);
    std::vector<std::array<uint32_t, 3>> cleared;
    for (PassDesc const& pass : std::span(seen.passes).first(18)) {
        cleared.push_back({ pass.colors[0].level, pass.colors[0].layer, pass.area.width });
    }
    for (uint32_t i = 0; i < 18; ++i) EXPECT_EQ(cleared[i], (std::array<uint32_t, 3>{ i / 6, i % 6, 8u >> i / 6 }));
}

TEST_F(HistoryTest, DepthHasAHistoryToo) {
    const Seen seen = frame({ .format = Format::D32F });
    ASSERT_EQ(seen.passes.size(), 3u);
    EXPECT_EQ(seen.passes[0].layout.depthFormat, Format::D32F);
    EXPECT_EQ(seen.passes[0].layout.colorCount, 0);
    EXPECT_EQ(seen.passes[0].depth.clear[0], 0.25f);
    frame({ .format = Format::D32F });
    EXPECT_EQ(age, 1u);
}

TEST_F(HistoryTest, ItsTexturesAreNeverSharedWithTransients) {
    for (int i = 0; i < 4; ++i) {
        const TextureId out = target(), early = color("early"), late = color("late");
        const History taa = graph.history({ .width = 64, .height = 32, .format = Format::RGBA16F, .name = "taa" });
        std::vector<TextureHandle> handles;
        const auto note = [&handles](TextureId id) {
            return [&handles, id](PassContext& c) { handles.push_back(c.texture(id)); };
        };
        graph.addPass(
                "early", [&](PassBuilder& b) { b.writeColor(0, early); }, note(early));
        graph.addPass(
                "write",
                [&](PassBuilder& b) {
                    b.readSampled(early);
                    b.readSampled(taa.previous);
                    b.writeColor(0, taa.current);
                },
                [&handles, taa](PassContext& c) {
                    handles.push_back(c.texture(taa.previous));
                    handles.push_back(c.texture(taa.current));
                });
        graph.addPass(
                "late", [&](PassBuilder& b) { b.writeColor(0, late); }, note(late));
        graph.addPass(
                "show",
                [&](PassBuilder& b) {
                    b.readSampled(late);
                    b.writeColor(0, out);
                },
                [](PassContext&) {});
        run();
        ASSERT_EQ(handles.size(), 4u);
        EXPECT_EQ(handles[0], handles[3]) << "disjoint transients share";
        EXPECT_NE(handles[1], handles[0]);
        EXPECT_NE(handles[2], handles[0]);
        EXPECT_NE(handles[1], handles[2]);
    }
}

TEST_F(HistoryTest, UnusedHistoriesAreDestroyedAfterAWhile) {
    frame();
    EXPECT_EQ(pool->historyCount(), 1u);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(run().destroyed, 0u) << "after " << i << " graphs";
    EXPECT_EQ(run().destroyed, 2u);
    EXPECT_EQ(pool->historyCount(), 0u);
    frame();
    EXPECT_EQ(age, 0u);
}

TEST_F(HistoryTest, NamesKeepHistoriesApart) {
    frame({ .name = "a" });
    frame({ .name = "b" });
    EXPECT_EQ(age, 0u);
    EXPECT_EQ(pool->historyCount(), 2u);
    frame({ .name = "a" });
    EXPECT_EQ(age, 2u);
}

TEST_F(HistoryTest, WhatIsKeptIsClearedWhereAFrameBeginsAnew) {
    frame();
    const TextureHandle written = current;
    const Seen anew = frame({ .beginsAnew = true });
    EXPECT_EQ(anew.created, 0u);
    EXPECT_EQ(previous, written) << "the same textures";
    EXPECT_EQ(age, 0u);
    EXPECT_EQ(anew.names[0], "previous taa");
    EXPECT_EQ(anew.passes[0].colors[0].load, LoadOp::Clear);
    EXPECT_EQ(frame().passes.size(), 2u) << "nothing is cleared";
    EXPECT_EQ(age, 1u) << "the frame that began anew is followed";
}

TEST_F(HistoryTest, AGraphThatIsCompiledButNotRecordedChangesNothing) {
    frame();
    const TextureHandle written = current;
    const History taa = graph.history({ .width = 64, .height = 32, .format = Format::RGBA16F, .name = "taa" });
    graph.addPass(
            "write", [&](PassBuilder& b) { b.writeColor(0, taa.current); }, [](PassContext&) {});
    compile(graph, *pool);
    graph.reset();
    frame();
    EXPECT_EQ(previous, written);
    EXPECT_EQ(age, 2u);
}

TEST_F(HistoryTest, ASteadyFrameDoesNotAllocate) {
    CommandBuffer commands;
    const auto once = [&] {
        const History taa = graph.history({ .width = 64, .height = 32, .format = Format::RGBA16F, .name = "taa" });
        graph.addPass(
                "accumulate",
                [&](PassBuilder& b) {
                    b.readSampled(taa.previous);
                    b.writeColor(0, taa.current, { .overwrites = true });
                },
                [](PassContext&) {});
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

using HistoryDeathTest = HistoryTest;

TEST_F(HistoryDeathTest, WritingThePreviousPicture) {
    const History taa = graph.history({ .width = 64, .height = 32, .format = Format::RGBA16F, .name = "taa" });
    pass("wrong", [&](PassBuilder& b) { b.writeColor(0, taa.previous); });
    EXPECT_DEATH(checkDeclarations(graph),
                 "pass 'wrong': writes texture 'previous taa', which a frame before this one left; write the current");
}

TEST_F(HistoryDeathTest, ReadingTheCurrentPictureBeforeItIsWritten) {
    const TextureId out = backbuffer();
    const History taa = graph.history({ .width = 64, .height = 32, .format = Format::RGBA16F, .name = "taa" });
    pass("early", [&](PassBuilder& b) {
        b.readSampled(taa.current);
        b.writeColor(0, out);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'early' reads texture 'taa', which no pass writes");
}

TEST_F(HistoryDeathTest, DeclaringOneTwice) {
    graph.history({ .format = Format::RGBA16F, .name = "taa" });
    EXPECT_DEATH(graph.history({ .format = Format::RGBA16F, .name = "taa" }), "history 'taa': declared twice");
}

TEST_F(HistoryDeathTest, PicturesThatCannotBeCleared) {
    EXPECT_DEATH(graph.history({ .format = Format::BC7, .name = "packed" }), "history 'packed': needs a renderable");
    EXPECT_DEATH(graph.history({ .format = Format::RGBA16F, .samples = 4, .name = "ms" }), "one sample a pixel");
}

TEST_F(HistoryDeathTest, AskingForTheAgeOfAnotherTexture) {
    const TextureId a = color("a");
    graph.markOutput(a);
    graph.addPass(
            "draw", [&](PassBuilder& b) { b.writeColor(0, a); }, [=](PassContext& c) { c.historyAge(a); });
    EXPECT_DEATH(run(), "pass 'draw': texture 'a' is not the previous one of a history");
}

} // namespace
} // namespace filament_core::framegraph
