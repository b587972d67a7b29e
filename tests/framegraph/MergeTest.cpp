// SPDX-License-Identifier: Apache-2.0
#include "tests/framegraph/GraphFixture.h"

namespace filament_core::framegraph {
namespace {

class MergePasses : public GraphTest {
protected:
    /// color -> tone map at the current pixel; returns how the tone map was merged.
    Merge outcome(MergeLimits const& limits = {}) { return steps(limits).order.decisions[toneMap].merge; }

    void declareColor(TextureId hdr, TextureId z) {
        pass("color", [&](PassBuilder& p) {
            p.writeColor(0, hdr);
            p.writeDepth(z);
        });
    }
    void declareToneMap(TextureId hdr, TextureId out) {
        toneMap = pass("tone map", [&](PassBuilder& p) {
            p.readInput(hdr);
            p.writeColor(0, out, { .overwrites = true });
        });
    }
    uint32_t toneMap = 0;
};

TEST_F(MergePasses, APassThatReadsTheCurrentPixelBecomesASubpass) {
    const TextureId hdr = color("hdr"), z = depth("z"), out = backbuffer();
    pass("color", [&](PassBuilder& p) {
        p.writeColor(0, hdr, { .clear = std::array<float, 4>{} });
        p.writeDepth(z, { .clear = 0.0f });
    });
    declareToneMap(hdr, out);
    const Steps s = steps();
    ASSERT_EQ(s.groups.size(), 1u);
    PassGroup const& group = s.groups[0];
    EXPECT_EQ(group.name, "color + tone map");
    EXPECT_EQ(group.layout.subpassCount, 2);
    EXPECT_EQ(group.layout.colorCount, 2);
    EXPECT_EQ(group.colors[0].texture, hdr);
    EXPECT_EQ(group.colors[1].texture, out);
    EXPECT_EQ(group.layout.subpasses[0], (backend::SubpassDesc{ .colorMask = 1, .inputMask = 0, .usesDepth = true }));
    EXPECT_EQ(group.layout.subpasses[1], (backend::SubpassDesc{ .colorMask = 2, .inputMask = 1, .usesDepth = false }));
    EXPECT_EQ(s.order.decisions[toneMap].subpass, 1);
    // Nothing reads hdr or z afterwards: both stay in the tile, but the output does not.
    EXPECT_EQ(group.colors[0].store, StoreOp::Discard);
    EXPECT_EQ(group.colors[1].store, StoreOp::Store);
    EXPECT_EQ(s.usage[hdr.index()],
              TextureUsage::ColorAttachment | TextureUsage::InputAttachment | TextureUsage::Transient);
}

TEST_F(MergePasses, AnInputThatIsAlsoReadLaterIsStored) {
    const TextureId hdr = color("hdr"), ldr = color("ldr"), out = backbuffer();
    pass("color", [&](PassBuilder& p) { p.writeColor(0, hdr); });
    declareToneMap(hdr, ldr);
    pass("compare", [&](PassBuilder& p) {
        p.readSampled(hdr);
        p.readSampled(ldr);
        p.writeColor(0, out);
    });
    const Steps s = steps();
    ASSERT_EQ(s.groups.size(), 2u);
    EXPECT_EQ(s.groups[0].colors[0].store, StoreOp::Store);
    EXPECT_EQ(s.usage[hdr.index()],
              TextureUsage::ColorAttachment | TextureUsage::InputAttachment | TextureUsage::Sampled);
}

TEST_F(MergePasses, ChainsUpToFourSubpasses) {
    std::vector<TextureId> steps5;
    for (const char* name : { "a", "b", "c", "d", "e" }) steps5.push_back(color(name));
    pass("0", [&](PassBuilder& p) { p.writeColor(0, steps5[0]); });
    for (int i = 1; i < 5; ++i) {
        pass("next", [&](PassBuilder& p) {
            p.readInput(steps5[i - 1]);
            p.writeColor(0, steps5[i]);
        });
    }
    graph.markOutput(steps5[4]);
    const Steps s = steps();
    ASSERT_EQ(s.groups.size(), 2u);
    EXPECT_EQ(s.groups[0].count, 4u);
    EXPECT_EQ(s.order.decisions[4].merge, Merge::TooManySubpasses);
    EXPECT_EQ(s.usage[steps5[3].index()], TextureUsage::ColorAttachment | TextureUsage::Sampled);
}

TEST_F(MergePasses, ACulledPassInBetweenIsNoObstacle) {
    const TextureId hdr = color("hdr"), unread = color("unread"), out = backbuffer();
    pass("color", [&](PassBuilder& p) { p.writeColor(0, hdr); });
    pass("unread", [&](PassBuilder& p) { p.writeColor(0, unread); });
    declareToneMap(hdr, out);
    EXPECT_EQ(outcome(), Merge::Merged);
}

TEST_F(MergePasses, NotOnADeviceWithoutMergedPasses) {
    const TextureId hdr = color("hdr"), out = backbuffer();
    pass("color", [&](PassBuilder& p) { p.writeColor(0, hdr); });
    declareToneMap(hdr, out);
    const Steps s = steps({ .mergedPasses = false });
    EXPECT_EQ(s.order.decisions[toneMap].merge, Merge::DeviceCannot);
    ASSERT_EQ(s.groups.size(), 2u);
    EXPECT_EQ(s.groups[0].colors[0].store, StoreOp::Store);
    EXPECT_EQ(s.usage[hdr.index()], TextureUsage::ColorAttachment | TextureUsage::Sampled);
    EXPECT_EQ(s.groups[1].layout.subpasses[0],
              (backend::SubpassDesc{ .colorMask = 1, .inputMask = 0, .usesDepth = false }));
}

TEST_F(MergePasses, NotWhereTheProgramExpectsItsInputAtAnotherAttachment) {
    const TextureId first = color("first"), second = color("second"), out = backbuffer();
    pass("color", [&](PassBuilder& p) {
        p.writeColor(0, first);
        p.writeColor(1, second);
    });
    toneMap = pass("tone map", [&](PassBuilder& p) {
        p.readInput(second, 0);
        p.writeColor(0, out);
    });
    EXPECT_EQ(outcome(), Merge::OtherAttachments);
}

TEST_F(MergePasses, NotWhereTheProgramExpectsItsOutputAtAnotherAttachment) {
    const TextureId first = color("first"), second = color("second"), out = backbuffer();
    pass("color", [&](PassBuilder& p) {
        p.writeColor(0, first);
        p.writeColor(1, second);
    });
    toneMap = pass("tone map", [&](PassBuilder& p) {
        p.readInput(first, 0);
        p.writeColor(0, out); // attachment 2 of the merged pass, and the program writes location 1
    });
    EXPECT_EQ(outcome(), Merge::OtherAttachments);
}

TEST_F(MergePasses, WhereTheProgramNumbersItsAttachmentsAsTheMergedPassDoes) {
    const TextureId first = color("first"), second = color("second"), out = backbuffer();
    pass("color", [&](PassBuilder& p) {
        p.writeColor(0, first);
        p.writeColor(1, second);
    });
    toneMap = pass("tone map", [&](PassBuilder& p) {
        p.readInput(first, 0);
        p.readInput(second, 1);
        p.writeColor(0, out);
    });
    EXPECT_EQ(outcome(), Merge::Merged);
}

TEST_F(MergePasses, NotWithAnotherPassInBetween) {
    const TextureId hdr = color("hdr"), other = color("other"), out = backbuffer();
    pass("color", [&](PassBuilder& p) { p.writeColor(0, hdr); });
    pass("other", [&](PassBuilder& p) { p.writeColor(0, other); });
    toneMap = pass("tone map", [&](PassBuilder& p) {
        p.readInput(hdr);
        p.readSampled(other);
        p.writeColor(0, out);
    });
    EXPECT_EQ(outcome(), Merge::NotBefore);
}

TEST_F(MergePasses, NotWithTheFirstPassThatReadsAnImportedPicture) {
    const TextureId kept = graph.importTexture(backend::TextureHandle::make(9, 1),
                                               { .width = 64, .height = 32, .format = Format::RGBA16F, .name = "kept" },
                                               InitialContents::Keep);
    declareToneMap(kept, backbuffer());
    EXPECT_EQ(outcome(), Merge::NotBefore);
}

TEST_F(MergePasses, NotWithAnotherSize) {
    const TextureId hdr = color("hdr", 128), out = backbuffer();
    pass("color", [&](PassBuilder& p) { p.writeColor(0, hdr); });
    declareToneMap(hdr, out);
    EXPECT_EQ(outcome(), Merge::DifferentSize);
}

TEST_F(MergePasses, NotWithMultisampledPasses) {
    const TextureId ms = color("ms", 64, 4), hdr = color("hdr"), out = backbuffer();
    pass("color", [&](PassBuilder& p) { p.writeColor(0, ms, { .resolve = hdr }); });
    declareToneMap(hdr, out);
    EXPECT_EQ(outcome(), Merge::Multisampled);
}

TEST_F(MergePasses, NotIfTheLaterPassAlsoSamplesWhatTheEarlierOneWrote) {
    const TextureId hdr = color("hdr"), z = depth("z"), out = backbuffer();
    declareColor(hdr, z);
    toneMap = pass("tone map", [&](PassBuilder& p) {
        p.readInput(hdr);
        p.readSampled(z);
        p.writeColor(0, out);
    });
    EXPECT_EQ(outcome(), Merge::ReadsElsewhere);
}

TEST_F(MergePasses, SamplingAnotherLevelOfAnAttachmentIsNoObstacle) {
    const TextureId hdr = color("hdr"), a = chain("bloom", 2), out = backbuffer();
    pass("fill", [&](PassBuilder& p) { p.writeColor(0, a, { .level = 1 }); });
    pass("color", [&](PassBuilder& p) { p.writeColor(0, hdr); });
    const uint32_t both = pass("tone map", [&](PassBuilder& p) {
        p.readInput(hdr);
        p.readSampled(a, backend::oneLevel(1));
        p.writeColor(0, out);
        p.writeColor(1, a);
    });
    const Steps result = steps();
    EXPECT_EQ(result.order.decisions[both].merge, Merge::Merged);
}

TEST_F(MergePasses, AnInputIsOneLevelOfItsTexture) {
    const TextureId a = chain("bloom", 2), out = color("out", 32);
    graph.markOutput(out);
    pass("level 1", [&](PassBuilder& p) { p.writeColor(0, a, { .level = 1 }); });
    const TextureId half =
            graph.createTexture({ .width = 32, .height = 16, .format = Format::RGBA16F, .name = "half" });
    graph.markOutput(half);
    const uint32_t reader = pass("read", [&](PassBuilder& p) {
        p.readInput(a, kAnyAttachment, 1);
        p.writeColor(0, half);
    });
    const Steps result = steps();
    EXPECT_EQ(result.order.decisions[reader].merge, Merge::Merged);
    EXPECT_EQ(result.groups[0].subpasses[1].inputMask, 1);
    EXPECT_EQ(result.groups[0].colors[0].level, 1);
}

TEST_F(MergePasses, NotIfTheLaterPassWritesWhatTheEarlierOneSamples) {
    const TextureId hdr = color("hdr"), history = color("history");
    pass("before", [&](PassBuilder& p) { p.writeColor(0, history); });
    pass("color", [&](PassBuilder& p) {
        p.readSampled(history);
        p.writeColor(0, hdr);
    });
    declareToneMap(hdr, history);
    graph.markOutput(history);
    EXPECT_EQ(outcome(), Merge::ReadsElsewhere);
}

TEST_F(MergePasses, NotIfItClearsAnAttachmentInUse) {
    const TextureId hdr = color("hdr"), z = depth("z"), out = backbuffer();
    declareColor(hdr, z);
    toneMap = pass("tone map", [&](PassBuilder& p) {
        p.readInput(hdr);
        p.writeDepth(z, { .clear = 0.0f });
        p.writeColor(0, out);
    });
    EXPECT_EQ(outcome(), Merge::ClearsAgain);
}

TEST_F(MergePasses, NotWithAnotherDepthAttachment) {
    const TextureId hdr = color("hdr"), z = depth("z"), other = depth("other"), out = backbuffer();
    declareColor(hdr, z);
    toneMap = pass("tone map", [&](PassBuilder& p) {
        p.readInput(hdr);
        p.writeDepth(other);
        p.writeColor(0, out);
    });
    EXPECT_EQ(outcome(), Merge::DifferentDepth);
}

TEST_F(MergePasses, NotBeyondTheDevicesColourAttachments) {
    const TextureId hdr = color("hdr"), out = backbuffer();
    pass("color", [&](PassBuilder& p) { p.writeColor(0, hdr); });
    declareToneMap(hdr, out);
    EXPECT_EQ(outcome({ .mergedPasses = true, .maxColorAttachments = 1 }), Merge::TooManyAttachments);
}

TEST_F(MergePasses, PassesThatDoNotReadInputsStayApart) {
    const TextureId out = backbuffer();
    pass("base", [&](PassBuilder& p) { p.writeColor(0, out); });
    pass("overlay", [&](PassBuilder& p) { p.writeColor(0, out); });
    EXPECT_EQ(steps().groups.size(), 2u);
}

} // namespace
} // namespace filament_core::framegraph
