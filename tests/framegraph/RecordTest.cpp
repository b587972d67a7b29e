// SPDX-License-Identifier: Apache-2.0
// compile() and record() on a validated null driver: the commands, the contents of the pool, the explanations.
#include "tests/framegraph/AllocationCount.h"
#include "tests/framegraph/GraphFixture.h"

namespace filament_core::framegraph {
namespace {

using namespace backend;

/// Writes a stream as text: the commands of a frame graph, in order.
struct Script {
    std::string text;
    void line(std::string_view what, std::string_view name = {}) {
        text += what;
        if (!name.empty()) text += ' ', text += name;
        text += '\n';
    }
    void execute(CmdBeginPass const& c) { line("begin", c.desc.debugName); }
    void execute(CmdNextSubpass const&) { line("next"); }
    void execute(CmdEndPass const&) { line("end"); }
    void execute(CmdPushGroup const& c) { line("push", c.name); }
    void execute(CmdPopGroup const&) { line("pop"); }
    void execute(CmdCreateTexture const& c) { line("create", c.desc.debugName); }
    void execute(CmdDestroyTexture const&) { line("destroy"); }
    void execute(CmdCreateBindGroup const& c) { line("bind group", c.desc.debugName); }
    void execute(CmdDraw const&) { line("draw"); }
    void execute(CmdBeginTimer const&) { line("timer"); }
    void execute(CmdEndTimer const&) { line("timer end"); }
    void execute(auto const&) { line("other"); }
};

struct PassDescs {
    std::vector<PassDesc> all;
    void execute(CmdBeginPass const& c) { all.push_back(c.desc); }
    void execute(auto const&) {}
};

class Record : public DeviceGraphTest {
protected:
    /// Compiles, records, submits, and starts the next graph.
    std::string frame(std::vector<PassTimer>* timers = nullptr) {
        const CompiledGraph plan = compile(graph, *pool);
        explained = toText(plan);
        graphviz = toGraphviz(plan);
        CommandBuffer& commands = stream->acquire();
        record(commands, plan, timers);
        Script script;
        replay(commands.view(), script);
        PassDescs passes;
        replay(commands.view(), passes);
        descs = passes.all;
        stream->submit(commands);
        graph.reset();
        arena.reset();
        return script.text;
    }

    /// color -> tone map, which samples or reads the pixel.
    void declareTwoPasses(bool atPixel) {
        const TextureId hdr = color("hdr"), out = target();
        graph.addPass(
                "color",
                [&](PassBuilder& b) {
                    b.writeColor(0, hdr, { .clear = { { 0, 0, 0, 1 } } });
                },
                [](PassContext&) {});
        graph.addPass(
                "tone map",
                [&](PassBuilder& b) {
                    if (atPixel)
                        b.readInput(hdr);
                    else
                        b.readSampled(hdr);
                    b.writeColor(0, out, { .overwrites = true });
                },
                [=, this](PassContext& c) {
                    merged = c.isMerged(hdr);
                    subpass = c.subpass();
                    outIndex = c.colorIndex(out);
                    layout = c.passLayout();
                    return c.texture(hdr);
                },
                [=, this](PassContext& c, TextureHandle prepared) { sameTexture = prepared == c.texture(hdr); });
    }

    std::string explained, graphviz;
    std::vector<PassDesc> descs;
    bool merged = false, sameTexture = false;
    uint8_t subpass = 0, outIndex = 0;
    PassLayout layout{};
};

TEST_F(Record, EveryGroupIsOnePassWithItsNameInGroups) {
    declareTwoPasses(false);
    EXPECT_EQ(frame(), "create hdr\n"
                       "begin color\npush color\npop\nend\n"
                       "begin tone map\npush tone map\npop\nend\n");
    ASSERT_EQ(descs.size(), 2u);
    EXPECT_EQ(descs[0].colors[0].load, LoadOp::Clear);
    EXPECT_EQ(descs[0].colors[0].store, StoreOp::Store);
    EXPECT_EQ(descs[1].colors[0].load, LoadOp::Discard);
    EXPECT_EQ(descs[1].area, (Rect{ 0, 0, 64, 32 }));
    EXPECT_FALSE(merged);
    EXPECT_EQ(outIndex, 0);
    EXPECT_TRUE(sameTexture);
}

TEST_F(Record, MergedPassesAreSubpassesOfOne) {
    declareTwoPasses(true);
    EXPECT_EQ(frame(), "create hdr\n"
                       "begin color + tone map\npush color\npop\nnext\npush tone map\npop\nend\n");
    ASSERT_EQ(descs.size(), 1u);
    EXPECT_EQ(descs[0].layout, layout);
    EXPECT_EQ(descs[0].colors[0].store, StoreOp::Discard);
    EXPECT_TRUE(merged);
    EXPECT_EQ(subpass, 1);
    EXPECT_EQ(outIndex, 1); // behind the attachment of the pass before
}

TEST_F(Record, MultisampledAttachmentsResolve) {
    const TextureId ms = color("ms", 64, 4), out = target();
    graph.addPass(
            "color", [&](PassBuilder& b) { b.writeColor(0, ms, { .clear = std::array<float, 4>{}, .resolve = out }); },
            [](PassContext&) {});
    frame();
    ASSERT_EQ(descs.size(), 1u);
    EXPECT_EQ(descs[0].layout.samples, 4);
    EXPECT_EQ(descs[0].layout.resolveMask, 1);
    EXPECT_TRUE(descs[0].colors[0].resolve);
    EXPECT_EQ(descs[0].colors[0].store, StoreOp::Discard); // only the resolved image is wanted
}

TEST_F(Record, MultisampledDepthIsReadThroughItsResolveTarget) {
    const TextureId ms = graph.createTexture(
            { .width = 64, .height = 32, .format = Format::D32F, .samples = 4, .name = "ms depth" });
    const TextureId z = depth("depth"), out = target();
    graph.addPass(
            "depth", [&](PassBuilder& b) { b.writeDepth(ms, { .clear = 0.0f, .resolve = z }); }, [](PassContext&) {});
    graph.addPass(
            "occlusion",
            [&](PassBuilder& b) {
                b.readSampled(z);
                b.writeColor(0, out, { .overwrites = true });
            },
            [](PassContext&) {});
    frame();
    ASSERT_EQ(descs.size(), 2u);
    EXPECT_TRUE(descs[0].layout.resolvesDepth);
    EXPECT_EQ(descs[0].layout.resolveMask, 0);
    EXPECT_TRUE(descs[0].depth.resolve);
    EXPECT_EQ(descs[0].depth.store, StoreOp::Discard); // only what was resolved is wanted
    EXPECT_NE(explained.find("depth 'ms depth': clear, discard, resolve to 'depth'"), std::string::npos) << explained;
    EXPECT_NE(explained.find("0 'depth' runs: 'depth' is read by 'occlusion'"), std::string::npos) << explained;
}

TEST_F(Record, APassWithoutAttachmentsRecordsOutsideOfPasses) {
    const TextureId a = color("a");
    graph.addPass(
            "draw", [&](PassBuilder& b) { b.writeColor(0, a, { .clear = std::array<float, 4>{} }); },
            [](PassContext&) {});
    Ticket ticket = stream->nextTicket();
    graph.addPass(
            "read-back",
            [&](PassBuilder& b) {
                b.readTransfer(a);
                b.sideEffect();
            },
            [=](PassContext& c) {
                c.commands().record(
                        CmdReadTexture{ .texture = c.texture(a), .rect = { 0, 0, 4, 4 }, .ticket = ticket });
            });
    EXPECT_EQ(frame(), "create a\nbegin draw\npush draw\npop\nend\npush read-back\nother\npop\n");
    stream->waitIdle();
    EXPECT_EQ(stream->takeReadback(ticket)->size(), 4u * 4 * 8);
}

TEST_F(Record, BeforePassRunsBeforeTheMergedPassBegins) {
    const TextureId hdr = color("hdr"), out = target();
    graph.addPass(
            "color", [&](PassBuilder& b) { b.writeColor(0, hdr, { .clear = std::array<float, 4>{} }); },
            [](PassContext&) {});
    graph.addPass(
            "tone map",
            [&](PassBuilder& b) {
                b.readInput(hdr);
                b.writeColor(0, out, { .overwrites = true });
            },
            [=](PassContext& c) {
                BindGroupLayout inputs;
                inputs.bindings[0] = { .binding = 0,
                                       .type = BindingType::InputAttachment,
                                       .stages = ShaderStage::Fragment,
                                       .inputAttachment = c.colorIndex(hdr) };
                inputs.count = 1;
                BindGroupEntry entry;
                entry.texture = c.texture(hdr);
                return c.bindGroup(inputs, { &entry, 1 }, "inputs");
            },
            [](PassContext&, BindGroupHandle group) { EXPECT_TRUE(group); });
    EXPECT_EQ(frame(), "create hdr\nbind group inputs\n"
                       "begin color + tone map\npush color\npop\nnext\npush tone map\npop\nend\n");
}

TEST_F(Record, ARehearsalAsksEveryPassThatRunsAndNoOther) {
    const TextureId hdr = color("hdr"), unread = color("unread"), out = target();
    std::vector<std::string> asked;
    std::vector<std::string>* const list = &asked;
    const auto add = [&](const char* name, TextureId to, TextureId from) {
        graph.addPass(
                name,
                [&](PassBuilder& b) {
                    if (from) b.readInput(from);
                    b.writeColor(0, to, { .overwrites = true });
                },
                [=](PassContext& c) {
                    EXPECT_TRUE(c.isRehearsal());
                    EXPECT_FALSE(c.bindGroup({}, {}, name)) << "none is made";
                    list->push_back(name);
                    return static_cast<uint32_t>(c.subpass());
                },
                [](PassContext&, uint32_t) { ADD_FAILURE() << "nothing is drawn"; });
    };
    add("color", hdr, {});
    add("nobody reads it", unread, {});
    add("tone map", out, hdr);
    const CompiledGraph plan = compile(graph, *pool);
    asked.reserve(2);
    const uint64_t before = allocationCount();
    rehearse(plan);
    EXPECT_EQ(allocationCount(), before);
    EXPECT_EQ(asked, (std::vector<std::string>{ "color", "tone map" }));
    graph.reset();
}

TEST_F(Record, AFrameAfterARehearsalIsTheSame) {
    declareTwoPasses(true);
    rehearse(compile(graph, *pool));
    EXPECT_TRUE(merged);
    graph.reset();
    arena.reset();
    declareTwoPasses(true);
    EXPECT_EQ(frame(), "create hdr\nbegin color + tone map\npush color\npop\nnext\npush tone map\npop\nend\n");
}

TEST_F(Record, PassesSampleTheLevelAboveTheOneThatTheyWrite) {
    const TextureId a = chain("bloom", 3), out = target();
    BindGroupLayout sampled;
    sampled.bindings[0] = { .binding = 0, .type = BindingType::SampledTexture, .stages = ShaderStage::Fragment };
    sampled.count = 1;
    std::vector<TextureRange> shown;
    const SamplerHandle sampler = stream->allocateSampler();
    graph.addPass(
            "top", [&](PassBuilder& b) { b.writeColor(0, a, { .clear = std::array<float, 4>{} }); },
            [](PassContext&) {});
    for (uint8_t level = 1; level < 3; ++level) {
        graph.addPass(
                "down",
                [&](PassBuilder& b) {
                    b.readSampled(a, oneLevel(static_cast<uint8_t>(level - 1)));
                    b.writeColor(0, a, { .overwrites = true, .level = level });
                },
                [=](PassContext& c) {
                    if (level == 1) c.commands().record(CmdCreateSampler{ sampler, {} });
                    const BindGroupEntry above{ .texture = c.texture(a),
                                                .sampler = sampler,
                                                .range = oneLevel(static_cast<uint8_t>(level - 1)) };
                    return c.bindGroup(sampled, { &above, 1 }, "above");
                },
                [](PassContext&, BindGroupHandle group) { EXPECT_TRUE(group); });
    }
    graph.addPass(
            "show",
            [&](PassBuilder& b) {
                b.readSampled(a, oneLevel(2));
                b.writeColor(0, out, { .overwrites = true });
            },
            [=](PassContext& c) {
                c.commands().record(CmdDestroySampler{ sampler });
                return 0;
            },
            [](PassContext&, int) {});
    frame();
    stream->free(sampler);
    ASSERT_EQ(descs.size(), 4u);
    EXPECT_EQ(descs[1].colors[0].level, 1);
    EXPECT_EQ(descs[2].area, (Rect{ 0, 0, 16, 8 }));
    EXPECT_EQ(pool->bindGroupCount(), 2u) << "two parts of one texture are two bind groups";
    EXPECT_EQ(pool->textureCount(), 1u);
    for (const char* line : { "1 'down' runs: 'bloom' level 1 is read by 'down'",
                              "colour 0 'bloom' level 2: discard, store", "reads 'bloom' level 1\n" }) {
        EXPECT_NE(explained.find(line), std::string::npos) << line << " is not in\n" << explained;
    }
    EXPECT_NE(graphviz.find("t0 -> p2 [label=\"level 1\"];"), std::string::npos) << graphviz;
}

TEST_F(Record, TimersMeasureGroups) {
    std::vector<PassTimer> timers;
    declareTwoPasses(false);
    const std::string script = frame(&timers);
    ASSERT_EQ(timers.size(), 2u);
    EXPECT_EQ(script.substr(0, script.find("push")), "create hdr\ntimer\nbegin color\n");
    stream->waitIdle();
    EXPECT_TRUE(stream->takeTimer(timers[0].ticket).has_value());
    EXPECT_TRUE(stream->takeTimer(timers[1].ticket).has_value());
}

// ---------------------------------------------------------------------------------------------- pool

class Pool : public Record {
protected:
    /// A chain of `count` passes, each sampling the previous one.
    void declareChain(int count, const char* const* names) {
        TextureId previous = color(names[0]);
        graph.addPass(
                names[0], [&](PassBuilder& b) { b.writeColor(0, previous, { .clear = std::array<float, 4>{} }); },
                [](PassContext&) {});
        for (int i = 1; i < count; ++i) {
            const TextureId next = i + 1 == count ? target() : color(names[i]);
            graph.addPass(
                    names[i],
                    [&](PassBuilder& b) {
                        b.readSampled(previous);
                        b.writeColor(0, next, { .overwrites = true });
                    },
                    [](PassContext&) {});
            previous = next;
        }
    }
    static constexpr const char* kNames[] = { "a", "b", "c", "d", "e" };
};

TEST_F(Pool, DisjointLifetimesOfEqualDescriptionsShareOneTexture) {
    declareChain(5, kNames);
    frame();
    EXPECT_EQ(pool->textureCount(), 2u); // ping and pong, for four transients
    EXPECT_NE(explained.find("'a' 64 x 32 RGBA16F, groups 0 to 1, shares memory with 'c'"), std::string::npos)
            << explained;
}

TEST_F(Pool, OverlappingLifetimesDoNotShare) {
    const TextureId a = color("a"), b = color("b"), c = color("c"), out = target();
    for (const TextureId texture : { a, b, c }) {
        graph.addPass(
                "write", [&](PassBuilder& p) { p.writeColor(0, texture); }, [](PassContext&) {});
    }
    graph.addPass(
            "show",
            [&](PassBuilder& p) {
                p.readSampled(a);
                p.readSampled(b);
                p.readSampled(c);
                p.writeColor(0, out);
            },
            [](PassContext&) {});
    frame();
    EXPECT_EQ(pool->textureCount(), 3u);
}

TEST_F(Pool, AnEqualFrameCreatesNothing) {
    declareChain(4, kNames);
    EXPECT_NE(frame().find("create"), std::string::npos);
    declareChain(4, kNames);
    EXPECT_EQ(frame().find("create"), std::string::npos);
}

TEST_F(Pool, WhatNoGraphUsesForAWhileIsDestroyed) {
    declareTwoPasses(false);
    frame();
    EXPECT_EQ(pool->textureCount(), 1u);
    std::string script;
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(pool->textureCount(), 1u) << "destroyed after " << i << " frames";
        script = frame(); // an empty graph
    }
    EXPECT_EQ(script, "");
    EXPECT_EQ(frame(), "destroy\n");
    EXPECT_EQ(pool->textureCount(), 0u);
}

TEST_F(Pool, AGraphThatIsCompiledTwiceButRecordedOnceIsCreatedOnce) {
    declareTwoPasses(false);
    compile(graph, *pool);
    const std::string script = frame();
    EXPECT_EQ(script.find("create"), script.rfind("create"));
    EXPECT_NE(script.find("create hdr"), std::string::npos);
}

TEST_F(Pool, EqualBindGroupsAreMadeOnce) {
    std::vector<BindGroupHandle> handles;
    for (int i = 0; i < 2; ++i) {
        const TextureId a = color("a"), out = target();
        graph.addPass(
                "draw", [&](PassBuilder& b) { b.writeColor(0, a, { .clear = std::array<float, 4>{} }); },
                [](PassContext&) {});
        graph.addPass(
                "show",
                [&](PassBuilder& b) {
                    b.readSampled(a);
                    b.writeColor(0, out);
                },
                [=](PassContext& c) { return c.bindGroup({}, {}, "empty"); },
                [&handles](PassContext&, BindGroupHandle group) { handles.push_back(group); });
        frame();
    }
    ASSERT_EQ(handles.size(), 2u);
    EXPECT_EQ(handles[0], handles[1]);
    EXPECT_EQ(pool->bindGroupCount(), 1u);
}

TEST_F(Pool, ASteadyFrameDoesNotAllocate) {
    CommandBuffer commands;
    const auto once = [&] {
        declareChain(5, kNames);
        const CompiledGraph plan = compile(graph, *pool);
        commands.reset();
        record(commands, plan);
        graph.reset();
        arena.reset();
    };
    target();
    graph.reset();
    once();
    stream->submit([&]() -> CommandBuffer& { // the driver must see the creations before destroyAll()
        CommandBuffer& first = stream->acquire();
        first.append(std::move(commands));
        return first;
    }());
    for (int i = 0; i < 3; ++i) once();
    const uint64_t before = allocationCount();
    ASSERT_GT(before, 0u);
    for (int i = 0; i < 10; ++i) once();
    EXPECT_EQ(allocationCount() - before, 0u);
}

// ---------------------------------------------------------------------------------------------- contracts, explanation

TEST_F(Record, TheTextTellsWhatRanWhatDidNotAndWhy) {
    const TextureId unread = color("unread");
    graph.addPass(
            "debug view", [&](PassBuilder& b) { b.writeColor(0, unread); }, [](PassContext&) {});
    declareTwoPasses(true);
    frame();
    for (const char* line : {
                 "passes: 3 declared, 2 run in 1 groups",
                 "0 'debug view' culled: nobody reads what it writes",
                 "1 'color' runs: 'hdr' is read by 'tone map'",
                 "2 'tone map' runs: it writes output 'target'; merged with the pass before it",
                 "'color + tone map' 64 x 32, 1 sample(s), 2 subpass(es)",
                 "colour 0 'hdr': clear, discard",
                 "colour 1 'target': discard, store",
                 "'hdr' 64 x 32 RGBA16F, groups 0 to 0, never leaves the tile",
                 "'unread' 64 x 32 RGBA16F, unused",
                 "'target' 64 x 32 RGBA16F, imported",
         }) {
        EXPECT_NE(explained.find(line), std::string::npos) << line << "\nis not in\n" << explained;
    }
}

TEST_F(Record, TheDrawingFramesMergedPassesAndDashesCulledOnes) {
    const TextureId unread = color("un\"read");
    graph.addPass(
            "debug view", [&](PassBuilder& b) { b.writeColor(0, unread); }, [](PassContext&) {});
    declareTwoPasses(true);
    frame();
    for (const char* line : {
                 "p0 [shape=box, label=\"debug view\", style=dashed];",
                 "subgraph cluster_0 {\n    label=\"merged\";\n    p1 [shape=box, label=\"color\"];\n",
                 "label=\"un\\\"read\\n64 x 32 RGBA16F\"",
                 "t1 -> p2 [label=\"pixel\"];",
                 "p2 -> t2;",
         }) {
        EXPECT_NE(graphviz.find(line), std::string::npos) << line << "\nis not in\n" << graphviz;
    }
}

class PassContextDeathTest : public Record {};

TEST_F(PassContextDeathTest, UsingATextureThatThePassDidNotDeclare) {
    const TextureId a = color("a"), out = target();
    graph.addPass(
            "draw", [&](PassBuilder& b) { b.writeColor(0, out); }, [=](PassContext& c) { c.texture(a); });
    EXPECT_DEATH(frame(), "pass 'draw': uses texture 'a' without having declared it");
    graph.reset();
}

TEST_F(PassContextDeathTest, ShowingAnotherLevelThanTheDeclaredOne) {
    const TextureId a = chain("bloom", 2), out = target();
    graph.addPass(
            "fill", [&](PassBuilder& b) { b.writeColor(0, a); }, [](PassContext&) {});
    graph.addPass(
            "show",
            [&](PassBuilder& b) {
                b.readSampled(a, oneLevel(0));
                b.writeColor(0, out);
            },
            [=](PassContext& c) {
                const BindGroupEntry entry{ .texture = c.texture(a) };
                return c.bindGroup({}, { &entry, 1 }, "levels");
            },
            [](PassContext&, BindGroupHandle) {});
    EXPECT_DEATH(frame(), "pass 'show': bind group 'levels' shows another part of texture 'bloom' than the pass");
}

TEST_F(PassContextDeathTest, MakingABindGroupInsideOfAPass) {
    const TextureId out = target();
    graph.addPass(
            "draw", [&](PassBuilder& b) { b.writeColor(0, out); },
            [=](PassContext& c) { c.bindGroup({}, {}, "late"); });
    EXPECT_DEATH(frame(), "pass 'draw': bind group 'late' is made inside of a pass; make it in beforePass");
    graph.reset();
}

TEST_F(PassContextDeathTest, RecordingInARehearsal) {
    const TextureId out = target();
    graph.addPass(
            "draw", [&](PassBuilder& b) { b.writeColor(0, out); },
            [](PassContext& c) {
                c.commands().record(CmdPushGroup{ "upload" });
                return 0;
            },
            [](PassContext&, int) {});
    EXPECT_DEATH(rehearse(compile(graph, *pool)), "pass 'draw': records commands in a rehearsal");
    graph.reset();
}

TEST_F(PassContextDeathTest, AskingForTheIndexOfATextureThatIsNoAttachment) {
    const TextureId a = color("a"), out = target();
    graph.addPass(
            "draw", [&](PassBuilder& b) { b.writeColor(0, a); }, [](PassContext&) {});
    graph.addPass(
            "show",
            [&](PassBuilder& b) {
                b.readSampled(a);
                b.writeColor(0, out);
            },
            [=](PassContext& c) { c.colorIndex(a); });
    EXPECT_DEATH(frame(), "pass 'show': texture 'a' is no colour attachment of it");
    graph.reset();
}

} // namespace
} // namespace filament_core::framegraph
