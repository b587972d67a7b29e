// SPDX-License-Identifier: Apache-2.0
// Each step of compile() by itself, without a device.
#include "tests/framegraph/GraphFixture.h"

namespace filament_core::framegraph {
namespace {

// ---------------------------------------------------------------------------------------------- cull

class Cull : public GraphTest {};

TEST_F(Cull, AnUnreadPassDoesNotRunNorDoTheInputsOfItAlone) {
    const TextureId a = color("a"), b = color("b"), out = backbuffer();
    const uint32_t first = pass("first", [&](PassBuilder& p) { p.writeColor(0, a); });
    const uint32_t second = pass("second", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, b);
    });
    const uint32_t third = pass("third", [&](PassBuilder& p) { p.writeColor(0, out); });
    const PassOrder order = cullUnreadPasses(graph);
    EXPECT_FALSE(order.decisions[first].runs());
    EXPECT_FALSE(order.decisions[second].runs());
    ASSERT_EQ(order.order.size(), 1u);
    EXPECT_EQ(order.order[0], third);
    EXPECT_EQ(order.decisions[third].reason, Reason::WritesOutput);
    EXPECT_EQ(order.decisions[third].because, out);
}

TEST_F(Cull, PassesThatReachAnOutputRunInTheOrderOfDeclaration) {
    const TextureId a = color("a"), out = backbuffer();
    const uint32_t writer = pass("writer", [&](PassBuilder& p) { p.writeColor(0, a); });
    const uint32_t reader = pass("reader", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, out);
    });
    const PassOrder order = cullUnreadPasses(graph);
    EXPECT_EQ(std::vector<uint32_t>(order.order.begin(), order.order.end()), (std::vector<uint32_t>{ writer, reader }));
    EXPECT_EQ(order.decisions[writer].reason, Reason::ReadLater);
    EXPECT_EQ(order.decisions[writer].because, a);
    EXPECT_EQ(order.decisions[writer].reader, reader);
}

TEST_F(Cull, ASideEffectKeepsThePassAndWhatItReads) {
    const TextureId a = color("a");
    pass("writer", [&](PassBuilder& p) { p.writeColor(0, a); });
    const uint32_t readback = pass("read-back", [&](PassBuilder& p) {
        p.readTransfer(a);
        p.sideEffect();
    });
    const PassOrder order = cullUnreadPasses(graph);
    EXPECT_EQ(order.order.size(), 2u);
    EXPECT_EQ(order.decisions[readback].reason, Reason::SideEffect);
}

TEST_F(Cull, WhatIsClearedOrCoveredAfterwardsIsNotWanted) {
    const TextureId out = backbuffer();
    const uint32_t lost = pass("lost", [&](PassBuilder& p) { p.writeColor(0, out); });
    const uint32_t covered = pass("covered", [&](PassBuilder& p) {
        p.writeColor(0, out, { .clear = { { 1, 0, 0, 1 } } });
    });
    const uint32_t covers = pass("covers", [&](PassBuilder& p) { p.writeColor(0, out, { .overwrites = true }); });
    const PassOrder order = cullUnreadPasses(graph);
    EXPECT_FALSE(order.decisions[lost].runs());
    EXPECT_FALSE(order.decisions[covered].runs());
    EXPECT_TRUE(order.decisions[covers].runs());
}

TEST_F(Cull, DrawingOverAPictureKeepsThePassThatMadeIt) {
    const TextureId out = backbuffer();
    pass("base", [&](PassBuilder& p) { p.writeColor(0, out, { .clear = std::array<float, 4>{} }); });
    pass("overlay", [&](PassBuilder& p) { p.writeColor(0, out); });
    EXPECT_EQ(cullUnreadPasses(graph).order.size(), 2u);
}

TEST_F(Cull, ClearingOneLayerKeepsThePassesOfTheOthers) {
    const TextureId cascades = graph.createTexture({ .width = 64,
                                                     .height = 32,
                                                     .format = Format::D32F,
                                                     .layers = 2,
                                                     .type = backend::TextureKind::Texture2DArray,
                                                     .name = "cascades" });
    const TextureId out = backbuffer();
    for (uint16_t layer = 0; layer < 2; ++layer) {
        pass("cascade", [&](PassBuilder& p) { p.writeDepth(cascades, { .clear = 0.0f, .layer = layer }); });
    }
    pass("color", [&](PassBuilder& p) {
        p.readSampled(cascades);
        p.writeColor(0, out);
    });
    const Steps result = steps();
    EXPECT_EQ(result.order.order.size(), 3u);
    EXPECT_EQ(result.groups[0].depth.store, StoreOp::Store);
    EXPECT_EQ(result.groups[1].depth.load, LoadOp::Clear);
}

TEST_F(Cull, OfAChainOnlyTheLevelsThatAreReadAreMade) {
    const TextureId a = chain("bloom", 4), out = backbuffer();
    std::array<uint32_t, 4> made{};
    made[0] = pass("top", [&](PassBuilder& p) { p.writeColor(0, a, { .overwrites = true }); });
    for (uint8_t level = 1; level < 4; ++level) {
        made[level] = pass("down", [&](PassBuilder& p) {
            p.readSampled(a, backend::oneLevel(static_cast<uint8_t>(level - 1)));
            p.writeColor(0, a, { .overwrites = true, .level = level });
        });
    }
    pass("show", [&](PassBuilder& p) {
        p.readSampled(a, backend::oneLevel(2));
        p.writeColor(0, out);
    });
    const Steps result = steps();
    const auto& decisions = result.order.decisions;
    EXPECT_TRUE(decisions[made[0]].runs() && decisions[made[1]].runs() && decisions[made[2]].runs());
    EXPECT_FALSE(decisions[made[3]].runs()) << "nobody reads level 3";
    EXPECT_EQ(decisions[made[1]].because, a);
    EXPECT_EQ(decisions[made[1]].level, 1);
    EXPECT_EQ(decisions[made[1]].reader, made[2]);
    EXPECT_EQ(result.lifetimes[a.index()].first, 0u);
    EXPECT_EQ(result.lifetimes[a.index()].last, 3u) << "the memory lives as long as any of its levels";
    for (size_t group = 0; group < 3; ++group) EXPECT_EQ(result.groups[group].colors[0].store, StoreOp::Store);
}

TEST_F(Cull, ALevelThatIsReplacedBeforeItIsReadNeedsNoFirstWriter) {
    const TextureId a = chain("bloom", 2), out = backbuffer();
    const uint32_t lost = pass("lost", [&](PassBuilder& p) { p.writeColor(0, a, { .level = 1 }); });
    const uint32_t kept = pass("kept", [&](PassBuilder& p) { p.writeColor(0, a); });
    pass("replace", [&](PassBuilder& p) { p.writeColor(0, a, { .clear = std::array<float, 4>{}, .level = 1 }); });
    pass("show", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, out);
    });
    const PassOrder order = cullUnreadPasses(graph);
    EXPECT_FALSE(order.decisions[lost].runs());
    EXPECT_TRUE(order.decisions[kept].runs());
}

TEST_F(Cull, AMarkedOutputKeepsItsPass) {
    const TextureId a = color("a");
    const uint32_t writer = pass("writer", [&](PassBuilder& p) { p.writeColor(0, a); });
    EXPECT_FALSE(cullUnreadPasses(graph).decisions[writer].runs());
    graph.markOutput(a);
    EXPECT_TRUE(cullUnreadPasses(graph).decisions[writer].runs());
}

TEST_F(Cull, AResolveTargetKeepsTheMultisampledPassAndReplacesOlderContents) {
    const TextureId ms = color("ms", 64, 4), resolved = color("resolved"), out = backbuffer();
    const uint32_t old = pass("old", [&](PassBuilder& p) { p.writeColor(0, resolved); });
    const uint32_t draw = pass("draw", [&](PassBuilder& p) {
        p.writeColor(0, ms, { .clear = std::array<float, 4>{}, .resolve = resolved });
    });
    pass("show", [&](PassBuilder& p) {
        p.readSampled(resolved);
        p.writeColor(0, out);
    });
    const PassOrder order = cullUnreadPasses(graph);
    EXPECT_FALSE(order.decisions[old].runs());
    EXPECT_EQ(order.decisions[draw].because, resolved);
}

// ---------------------------------------------------------------------------------------------- load and store

class LoadStore : public GraphTest {};

TEST_F(LoadStore, TheFirstWriteDiscardsAndTheLastReaderEndsTheStore) {
    const TextureId a = color("a"), z = depth("z"), out = backbuffer();
    pass("draw", [&](PassBuilder& p) {
        p.writeColor(0, a);
        p.writeDepth(z, { .clear = 0.0f });
    });
    pass("more", [&](PassBuilder& p) {
        p.writeColor(0, a);
        p.testDepth(z);
    });
    pass("show", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, out, { .overwrites = true });
    });
    const Steps s = steps();
    EXPECT_EQ(s.groups[0].colors[0].load, LoadOp::Discard);
    EXPECT_EQ(s.groups[0].colors[0].store, StoreOp::Store);
    EXPECT_EQ(s.groups[0].depth.load, LoadOp::Clear);
    EXPECT_EQ(s.groups[0].depth.store, StoreOp::Store); // tested in the second pass
    EXPECT_EQ(s.groups[1].colors[0].load, LoadOp::Load);
    EXPECT_EQ(s.groups[1].depth.load, LoadOp::Load);
    EXPECT_EQ(s.groups[1].depth.store, StoreOp::Discard); // nobody afterwards
    EXPECT_EQ(s.groups[2].colors[0].load, LoadOp::Discard);
    EXPECT_EQ(s.groups[2].colors[0].store, StoreOp::Store);
}

TEST_F(LoadStore, AnImportedTextureLoadsItsContentsOnlyIfTheyAreKept) {
    const TextureId out = backbuffer(InitialContents::Undefined);
    pass("draw", [&](PassBuilder& p) { p.writeColor(0, out); });
    EXPECT_EQ(steps().groups[0].colors[0].load, LoadOp::Discard);
    graph.reset();
    const TextureId kept = backbuffer(InitialContents::Keep);
    pass("draw", [&](PassBuilder& p) { p.writeColor(0, kept); });
    EXPECT_EQ(steps().groups[0].colors[0].load, LoadOp::Load);
}

TEST_F(LoadStore, AnImportedDepthBufferThatIsOnlyTestedSurvives) {
    const TextureId z = graph.importTexture(backend::TextureHandle::make(5, 1),
                                            { .width = 64, .height = 32, .format = Format::D32F, .name = "z" },
                                            InitialContents::Keep);
    const TextureId out = backbuffer();
    pass("draw", [&](PassBuilder& p) {
        p.testDepth(z);
        p.writeColor(0, out);
    });
    const Steps s = steps();
    EXPECT_EQ(s.groups[0].depth.load, LoadOp::Load);
    EXPECT_EQ(s.groups[0].depth.store, StoreOp::Store);
}

TEST_F(LoadStore, ContentsThatAreReplacedBeforeAnybodyReadsThemAreNotStored) {
    const TextureId a = color("a"), first = color("first"), out = backbuffer();
    pass("one", [&](PassBuilder& p) {
        p.writeColor(0, first);
        p.writeColor(1, a);
    });
    pass("two", [&](PassBuilder& p) {
        p.readSampled(first);
        p.writeColor(0, a, { .overwrites = true });
    });
    pass("show", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, out);
    });
    const Steps s = steps();
    EXPECT_EQ(s.groups[0].colors[0].store, StoreOp::Store);
    EXPECT_EQ(s.groups[0].colors[1].store, StoreOp::Discard);
}

TEST_F(LoadStore, LevelsOfATextureAreFollowedOneByOne) {
    const TextureId chain =
            graph.createTexture({ .width = 64, .height = 32, .format = Format::RGBA16F, .levels = 2, .name = "chain" });
    const TextureId out = backbuffer();
    pass("level 0", [&](PassBuilder& p) { p.writeColor(0, chain); });
    pass("level 1", [&](PassBuilder& p) { p.writeColor(0, chain, { .level = 1 }); });
    pass("level 1 again", [&](PassBuilder& p) { p.writeColor(0, chain, { .level = 1 }); });
    pass("show", [&](PassBuilder& p) {
        p.readSampled(chain);
        p.writeColor(0, out);
    });
    const Steps s = steps();
    EXPECT_EQ(s.groups[1].colors[0].load, LoadOp::Discard);
    EXPECT_EQ(s.groups[1].width, 32u);
    EXPECT_EQ(s.groups[1].height, 16u);
    EXPECT_EQ(s.groups[2].colors[0].load, LoadOp::Load);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(s.groups[i].colors[0].store, StoreOp::Store);
}

TEST_F(LoadStore, AnUnsampledLevelIsNotStoredForTheSakeOfAnother) {
    const TextureId a = chain("bloom", 2), ldr = color("ldr"), out = backbuffer();
    pass("both", [&](PassBuilder& p) {
        p.writeColor(0, a);
        p.writeColor(1, ldr);
    });
    pass("level 1", [&](PassBuilder& p) { p.writeColor(0, a, { .level = 1 }); });
    pass("show", [&](PassBuilder& p) {
        p.readSampled(a, backend::oneLevel(1));
        p.readSampled(ldr);
        p.writeColor(0, out);
    });
    const Steps result = steps();
    ASSERT_EQ(result.groups.size(), 3u);
    EXPECT_EQ(result.groups[0].colors[0].store, StoreOp::Discard);
    EXPECT_EQ(result.groups[1].colors[0].store, StoreOp::Store);
}

TEST_F(LoadStore, AnUploadCountsAsAWrite) {
    const TextureId a = color("a"), out = backbuffer();
    pass("upload", [&](PassBuilder& p) { p.writeTransfer(a); });
    pass("draw over", [&](PassBuilder& p) { p.writeColor(0, a); });
    pass("show", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, out);
    });
    const Steps s = steps();
    ASSERT_EQ(s.groups.size(), 3u);
    EXPECT_FALSE(s.groups[0].hasAttachments());
    EXPECT_EQ(s.groups[1].colors[0].load, LoadOp::Load);
}

// ---------------------------------------------------------------------------------------------- lifetimes, usage

class Usage : public GraphTest {};

TEST_F(Usage, LifetimesSpanFirstToLastUseOfThePassesThatRun) {
    const TextureId a = color("a"), b = color("b"), unread = color("unread"), out = backbuffer();
    pass("0", [&](PassBuilder& p) { p.writeColor(0, a); });
    pass("culled", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, unread);
    });
    pass("1", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, b);
    });
    pass("2", [&](PassBuilder& p) {
        p.readSampled(b);
        p.writeColor(0, out);
    });
    const Steps s = steps();
    EXPECT_EQ(s.lifetimes[a.index()].first, 0u);
    EXPECT_EQ(s.lifetimes[a.index()].last, 1u);
    EXPECT_EQ(s.lifetimes[b.index()].first, 1u);
    EXPECT_EQ(s.lifetimes[b.index()].last, 2u);
    EXPECT_FALSE(s.lifetimes[unread.index()].isUsed());
}

TEST_F(Usage, FollowsFromWhatRunningPassesDo) {
    const TextureId a = color("a"), ms = color("ms", 64, 4), z = depth("z"), out = backbuffer();
    pass("draw", [&](PassBuilder& p) { p.writeColor(0, ms, { .resolve = a }); });
    pass("depth", [&](PassBuilder& p) {
        p.writeDepth(z);
        p.writeColor(0, a);
    });
    pass("show", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, out);
    });
    pass("read", [&](PassBuilder& p) {
        p.readTransfer(a);
        p.sideEffect();
    });
    const Steps s = steps();
    EXPECT_EQ(s.usage[a.index()], TextureUsage::ColorAttachment | TextureUsage::Sampled | TextureUsage::TransferSource);
    EXPECT_EQ(s.usage[ms.index()], TextureUsage::ColorAttachment | TextureUsage::Transient);
    EXPECT_EQ(s.usage[z.index()], TextureUsage::DepthAttachment | TextureUsage::Transient);
    EXPECT_EQ(s.usage[out.index()], TextureUsage::ColorAttachment);
}

TEST_F(Usage, ATransientAttachmentIsNeitherLoadedNorStored) {
    const TextureId z = depth("z"), out = backbuffer();
    pass("draw", [&](PassBuilder& p) {
        p.writeDepth(z);
        p.writeColor(0, out);
    });
    const Steps s = steps();
    ASSERT_TRUE(has(s.usage[z.index()], TextureUsage::Transient));
    EXPECT_NE(s.groups[0].depth.load, LoadOp::Load);
    EXPECT_EQ(s.groups[0].depth.store, StoreOp::Discard);
}

} // namespace
} // namespace filament_core::framegraph
