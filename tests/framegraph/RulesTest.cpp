// SPDX-License-Identifier: Apache-2.0
// Every rule of a graph names the pass and the texture that break it.
#include "tests/framegraph/GraphFixture.h"

namespace filament_core::framegraph {
namespace {

class GraphRulesDeathTest : public GraphTest {};

TEST_F(GraphRulesDeathTest, ReadingWithoutAWriter) {
    const TextureId a = color("a"), out = backbuffer();
    pass("reader", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, out);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'reader' reads texture 'a', which no pass writes");
}

TEST_F(GraphRulesDeathTest, ReadingBeforeItIsWritten) {
    const TextureId a = color("a"), out = backbuffer();
    pass("reader", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, out);
    });
    pass("writer", [&](PassBuilder& p) { p.writeColor(0, a); });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'reader' reads texture 'a' before pass 'writer' writes it");
}

TEST_F(GraphRulesDeathTest, ReadingAnImportedTextureWithUndefinedContents) {
    const TextureId out = backbuffer(InitialContents::Undefined);
    pass("reader", [&](PassBuilder& p) {
        p.readTransfer(out);
        p.sideEffect();
    });
    EXPECT_DEATH(checkDeclarations(graph), "'reader' reads texture 'backbuffer', which no pass writes");
}

TEST_F(GraphRulesDeathTest, AttachmentsOfDifferentSizes) {
    const TextureId a = color("a", 64), b = color("b", 65);
    pass("draw", [&](PassBuilder& p) {
        p.writeColor(0, a);
        p.writeColor(1, b);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'draw': attachment 'b' is 65 x 32, attachment 'a' is 64 x 32");
}

TEST_F(GraphRulesDeathTest, AttachmentsOfDifferentSampleCounts) {
    const TextureId a = color("a", 64, 4), b = color("b");
    pass("draw", [&](PassBuilder& p) {
        p.writeColor(0, a);
        p.writeColor(1, b);
    });
    EXPECT_DEATH(checkDeclarations(graph), "attachment 'b' has 1 samples, attachment 'a' has 4");
}

TEST_F(GraphRulesDeathTest, GapsAndDoublesInColourSlots) {
    const TextureId a = color("a"), b = color("b");
    pass("gap", [&](PassBuilder& p) {
        p.writeColor(0, a);
        p.writeColor(2, b);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'gap': colour slots have gaps");
    graph.reset();
    const TextureId c = color("c"), d = color("d");
    pass("double", [&](PassBuilder& p) {
        p.writeColor(0, c);
        p.writeColor(0, d);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'double': colour slot 0 of 'd' is taken");
}

TEST_F(GraphRulesDeathTest, TwoDepthAttachments) {
    const TextureId a = depth("a"), b = depth("b");
    pass("draw", [&](PassBuilder& p) {
        p.writeDepth(a);
        p.writeDepth(b);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'draw': 'b' is a second depth attachment");
}

TEST_F(GraphRulesDeathTest, AFormatThatDoesNotFitTheAttachment) {
    const TextureId z = depth("z");
    pass("draw", [&](PassBuilder& p) { p.writeColor(0, z); });
    EXPECT_DEATH(checkDeclarations(graph), "texture 'z' has format D32F: wrong for a colour attachment");
}

TEST_F(GraphRulesDeathTest, AttachingALevelThatDoesNotExist) {
    const TextureId a = color("a");
    pass("draw", [&](PassBuilder& p) { p.writeColor(0, a, { .level = 1 }); });
    EXPECT_DEATH(checkDeclarations(graph), "texture 'a' has 1 levels and 1 layers; level 1, layer 0 is attached");
}

TEST_F(GraphRulesDeathTest, AttachingASliceThatTheLevelLacks) {
    const TextureId volume = graph.createTexture({ .width = 8,
                                                   .height = 8,
                                                   .levels = 2,
                                                   .layers = 4,
                                                   .type = backend::TextureKind::Texture3D,
                                                   .name = "v" });
    pass("draw", [&](PassBuilder& p) { p.writeColor(0, volume, { .level = 1, .layer = 2 }); });
    EXPECT_DEATH(checkDeclarations(graph), "texture 'v' has 2 levels and 2 layers; level 1, layer 2 is attached");
}

TEST_F(GraphRulesDeathTest, SamplingAnAttachment) {
    const TextureId a = color("a");
    pass("write", [&](PassBuilder& p) { p.writeColor(0, a); });
    pass("feedback", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, a);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'feedback': texture 'a' is attached and read at the same time");
}

TEST_F(GraphRulesDeathTest, AttachingTwice) {
    const TextureId a = color("a");
    pass("draw", [&](PassBuilder& p) {
        p.writeColor(0, a);
        p.writeColor(1, a);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'draw': texture 'a' is attached twice");
}

TEST_F(GraphRulesDeathTest, ResolvingASingleSample) {
    const TextureId a = color("a"), b = color("b");
    pass("draw", [&](PassBuilder& p) { p.writeColor(0, a, { .resolve = b }); });
    EXPECT_DEATH(checkDeclarations(graph), "resolves 'a' \\(1 samples\\) to 'b' \\(1 samples\\)");
}

TEST_F(GraphRulesDeathTest, ResolvingTwoAttachmentsToOneTexture) {
    const TextureId a = color("a", 64, 4), b = color("b", 64, 4), c = color("c");
    pass("draw", [&](PassBuilder& p) {
        p.writeColor(0, a, { .resolve = c });
        p.writeColor(1, b, { .resolve = c });
    });
    EXPECT_DEATH(checkDeclarations(graph), "texture 'c' is a resolve target and something else");
}

TEST_F(GraphRulesDeathTest, ReadingAMultisampledTextureOtherwiseThanSampleBySample) {
    const TextureId a = color("a", 64, 4), out = backbuffer();
    pass("draw", [&](PassBuilder& p) { p.writeColor(0, a); });
    pass("resolve", [&](PassBuilder& p) {
        p.readSampled(a);
        p.writeColor(0, out);
    });
    checkDeclarations(graph);
    pass("copy", [&](PassBuilder& p) { p.readTransfer(a); });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'copy': reads multisampled texture 'a' otherwise than sample by");
}

TEST_F(GraphRulesDeathTest, TransfersInsideOfAPass) {
    const TextureId a = color("a"), out = backbuffer();
    pass("mixed", [&](PassBuilder& p) {
        p.writeTransfer(a);
        p.writeColor(0, out);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'mixed': has attachments and transfers");
}

TEST_F(GraphRulesDeathTest, ReadingInputsWithoutAttachments) {
    const TextureId a = color("a");
    pass("draw", [&](PassBuilder& p) { p.writeColor(0, a); });
    pass("read", [&](PassBuilder& p) {
        p.readInput(a);
        p.sideEffect();
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'read': reads the current pixel of an input, but has no attachments");
}

// ---------------------------------------------------------------------------------------------- levels and layers

TEST_F(GraphRulesDeathTest, ReadingALevelWithoutAWriter) {
    const TextureId a = chain("bloom", 3), out = backbuffer();
    pass("write", [&](PassBuilder& p) { p.writeColor(0, a, { .level = 1 }); });
    pass("read", [&](PassBuilder& p) {
        p.readSampled(a, { .level = 1 });
        p.writeColor(0, out);
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'read' reads texture 'bloom' level 2, which no pass writes");
}

TEST_F(GraphRulesDeathTest, ReadingALevelBeforeItIsWritten) {
    const TextureId a = chain("bloom", 3);
    pass("top", [&](PassBuilder& p) { p.writeColor(0, a); });
    pass("down 2", [&](PassBuilder& p) {
        p.readSampled(a, backend::oneLevel(1));
        p.writeColor(0, a, { .level = 2 });
    });
    pass("down 1", [&](PassBuilder& p) {
        p.readSampled(a, backend::oneLevel(0));
        p.writeColor(0, a, { .level = 1 });
    });
    EXPECT_DEATH(checkDeclarations(graph),
                 "pass 'down 2' reads texture 'bloom' level 1 before pass 'down 1' writes it");
}

TEST_F(GraphRulesDeathTest, SamplingTheLevelThatIsAttached) {
    const TextureId a = chain("bloom", 3);
    pass("top", [&](PassBuilder& p) { p.writeColor(0, a); });
    pass("next", [&](PassBuilder& p) { p.writeColor(0, a, { .level = 1 }); });
    pass("feedback", [&](PassBuilder& p) {
        p.readSampled(a, { .level = 0, .levelCount = 2 });
        p.writeColor(0, a, { .level = 1 });
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'feedback': texture 'bloom' level 1 is attached and read at the same");
}

TEST_F(GraphRulesDeathTest, RangesThatLeaveTheTexture) {
    const TextureId a = chain("bloom", 3), out = backbuffer();
    pass("write", [&](PassBuilder& p) { p.writeColor(0, a); });
    pass("read", [&](PassBuilder& p) {
        p.readSampled(a, { .level = 1, .levelCount = 3 });
        p.writeColor(0, out);
    });
    EXPECT_DEATH(checkDeclarations(graph),
                 "pass 'read': texture 'bloom' has 3 levels and 1 layers; declared are 3 from 1 and 1 from 0");
    graph.reset();
    const TextureId b = chain("bloom", 3);
    pass("read", [&](PassBuilder& p) { p.readTransfer(b, { .level = 3 }); });
    EXPECT_DEATH(checkDeclarations(graph), "declared are 0 from 3");
}

TEST_F(GraphRulesDeathTest, ResolvingToTheLevelThatIsSampled) {
    const TextureId ms = color("ms", 64, 4), a = chain("bloom", 2);
    pass("fill", [&](PassBuilder& p) { p.writeColor(0, a, { .clear = std::array<float, 4>{} }); });
    pass("draw", [&](PassBuilder& p) {
        p.readSampled(a, backend::oneLevel(0));
        p.writeColor(0, ms, { .resolve = a });
    });
    EXPECT_DEATH(checkDeclarations(graph), "pass 'draw': texture 'bloom' is a resolve target and something else");
}

TEST_F(GraphRulesDeathTest, ForgottenNamesSizesAndHandles) {
    EXPECT_DEATH(graph.createTexture({ .width = 1, .height = 1 }), "has a name");
    EXPECT_DEATH(graph.createTexture({ .width = 0, .height = 1, .name = "thin" }),
                 "texture 'thin': needs a format and a size");
    EXPECT_DEATH(graph.importTexture({}, { .name = "lost" }, InitialContents::Keep),
                 "'lost': imported without a handle");
    EXPECT_DEATH(pass("stray", [&](PassBuilder& p) { p.readSampled(TextureId{ 9 }); }),
                 "pass 'stray': declares a texture of another graph");
}

} // namespace
} // namespace filament_core::framegraph
