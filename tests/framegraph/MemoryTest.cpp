// SPDX-License-Identifier: Apache-2.0
#include "framegraph/Memory.h"

#include "tests/framegraph/GraphFixture.h"

namespace filament_core::framegraph {
namespace {

TEST(GraphMemory, CountsLevelsLayersAndSamples) {
    EXPECT_EQ(bytesOf({ .width = 64, .height = 32, .format = Format::RGBA8 }), 64u * 32 * 4);
    EXPECT_EQ(bytesOf({ .width = 64, .height = 32, .format = Format::RGBA8, .samples = 4 }), 4u * 64 * 32 * 4);
    EXPECT_EQ(bytesOf({ .width = 64, .height = 32, .format = Format::D32F, .layers = 3 }), 3u * 64 * 32 * 4);
    EXPECT_EQ(bytesOf({ .width = 4, .height = 1, .format = Format::RGBA8, .levels = 3 }), (4u + 2 + 1) * 4);
}

using GraphMemoryTest = DeviceGraphTest;

TEST_F(GraphMemoryTest, SharedTexturesAreSavedAndThoseOfCulledPassesAreNothing) {
    const TextureId a = color("a"), b = color("b"), c = color("c"), unread = color("unread");
    const TextureId out = target();
    const uint32_t first = pass("first", [&](PassBuilder& p) { p.writeColor(0, a, { .overwrites = true }); });
    pass("second", [&](PassBuilder& p) { p.readSampled(a), p.writeColor(0, b, { .overwrites = true }); });
    pass("third", [&](PassBuilder& p) { p.readSampled(b), p.writeColor(0, c, { .overwrites = true }); });
    const uint32_t culled = pass("culled", [&](PassBuilder& p) { p.writeColor(0, unread, { .overwrites = true }); });
    pass("last", [&](PassBuilder& p) { p.readSampled(c), p.writeColor(0, out, { .overwrites = true }); });
    const CompiledGraph plan = compile(graph, *pool);
    backend::CommandBuffer& commands = stream->acquire();
    record(commands, plan);
    stream->submit(commands);
    constexpr uint64_t kBytes = 64 * 32 * 8;
    const AttachmentMemory memory = attachmentMemory(plan);
    EXPECT_EQ(memory.bytes, 2 * kBytes) << "c takes the place of a";
    EXPECT_EQ(memory.saved, kBytes);
    EXPECT_EQ(attachmentBytes(plan, first), kBytes);
    EXPECT_EQ(attachmentBytes(plan, culled), 0u);
    EXPECT_NE(
            toText(plan).find("memory: 0.03 MB of textures, 0.00 MB of them in the tile; sharing saves 0.02 MB, 33 %"),
            std::string::npos)
            << toText(plan);
}

/// What a test has planned is also recorded, so that the driver sees every creation.
class SharedTransients : public DeviceGraphTest {
protected:
    CompiledGraph planAndRecord() {
        const CompiledGraph plan = compile(graph, *pool);
        backend::CommandBuffer& commands = stream->acquire();
        record(commands, plan);
        stream->submit(commands);
        return plan;
    }
    void restart() {
        graph.reset();
        arena.reset();
    }
    /// Each texture is read by the pass that writes the next one.
    void declareChain(std::initializer_list<Format> formats) {
        TextureId before;
        for (const Format format : formats) {
            const TextureId made = graph.createTexture({ .width = 64, .height = 32, .format = format, .name = "made" });
            pass("pass", [&](PassBuilder& p) {
                if (before) p.readSampled(before);
                p.writeColor(0, made, { .overwrites = true });
            });
            before = made;
        }
        const TextureId out = target();
        pass("last", [&](PassBuilder& p) { p.readSampled(before), p.writeColor(0, out, { .overwrites = true }); });
    }
};

TEST_F(SharedTransients, OtherFormatsShareMemoryThatIsLargeEnough) {
    declareChain({ Format::RGBA16F, Format::R8, Format::R32F, Format::RGBA8 });
    const CompiledGraph plan = planAndRecord();
    EXPECT_EQ(plan.textures[0].memory, plan.textures[2].memory) << "R32F is smaller than RGBA16F, and comes later";
    EXPECT_NE(plan.textures[0].handle, plan.textures[2].handle);
    EXPECT_EQ(plan.textures[1].memory, plan.textures[3].memory);
    EXPECT_NE(plan.textures[0].memory, plan.textures[1].memory) << "both live in the second pass";
    const AttachmentMemory memory = attachmentMemory(plan);
    EXPECT_EQ(memory.bytes, 64u * 32 * (8 + 4));
    EXPECT_EQ(memory.saved, 64u * 32 * (4 + 1));
    EXPECT_NE(toText(plan).find("'made' 64 x 32 R8, groups 1 to 2, shares memory with 'made'"), std::string::npos)
            << toText(plan);
}

TEST_F(SharedTransients, TheSameGraphsTakeTheSameTextures) {
    const auto handlesOf = [&](std::initializer_list<Format> formats) {
        declareChain(formats);
        const CompiledGraph plan = planAndRecord();
        std::vector<backend::TextureHandle> handles;
        for (TexturePlan const& texture : plan.textures) handles.push_back(texture.handle);
        restart();
        return handles;
    };
    const std::initializer_list<Format> kOne{ Format::RGBA16F, Format::R8, Format::R32F };
    const std::initializer_list<Format> kOther{ Format::R32F, Format::RGBA16F, Format::RGBA8, Format::R8 };
    const auto one = handlesOf(kOne), other = handlesOf(kOther);
    const uint32_t textures = pool->textureCount();
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(handlesOf(kOne), one);
        EXPECT_EQ(handlesOf(kOther), other);
    }
    EXPECT_EQ(pool->textureCount(), textures);
}

TEST_F(SharedTransients, AHostWhoseGraphWasNeverRecordedIsNoHost) {
    declareChain({ Format::RGBA16F });
    compile(graph, *pool); // promises a texture
    restart();
    declareChain({ Format::R32F }); // smaller: it could have been placed on that
    planAndRecord();
    restart();
    for (int i = 0; i < 8; ++i) { // until the promise is forgotten
        declareChain({ Format::R32F });
        planAndRecord();
        restart();
    }
    EXPECT_EQ(pool->textureCount(), 1u);
}

TEST_F(GraphMemoryTest, APassOccupiesTheLevelThatItDrawsTo) {
    const TextureId mips =
            graph.createTexture({ .width = 64, .height = 32, .format = Format::RGBA8, .levels = 4, .name = "mips" });
    const TextureId out = target();
    std::array<uint32_t, 4> levels{};
    for (uint8_t level = 0; level < 4; ++level) {
        levels[level] = pass("level", [&](PassBuilder& p) {
            if (level > 0) p.readSampled(mips, backend::oneLevel(static_cast<uint8_t>(level - 1)));
            p.writeColor(0, mips, { .overwrites = true, .level = level });
        });
    }
    pass("last", [&](PassBuilder& p) { p.readSampled(mips), p.writeColor(0, out, { .overwrites = true }); });
    const CompiledGraph plan = compile(graph, *pool);
    for (uint32_t level = 0; level < 4; ++level)
        EXPECT_EQ(attachmentBytes(plan, levels[level]), (64u >> level) * (32 >> level) * 4) << level;
}

} // namespace
} // namespace filament_core::framegraph
