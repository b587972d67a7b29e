// SPDX-License-Identifier: Apache-2.0
#include "framegraph/Memory.h"

#include "tests/framegraph/GraphFixture.h"

namespace filament::framegraph {
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
    EXPECT_NE(toText(plan).find("memory: 0.03 MB of textures, 0.00 MB of them in the tile; sharing saves 0.02 MB"),
              std::string::npos)
            << toText(plan);
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
} // namespace filament::framegraph
