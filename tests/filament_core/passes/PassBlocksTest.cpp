// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/PassBlocks.h"

#include "backend/layers/Validated.h"
#include "backend/null/NullDriver.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>

namespace filament_core::passes {
namespace {

using backend::BindGroupEntry;

struct PassBlocksTest : testing::Test {
    ~PassBlocksTest() override {
        backend::CommandBuffer& commands = stream->acquire();
        blocks.destroy(commands);
        stream->submit(commands);
        EXPECT_TRUE(stream->takeErrors().empty());
    }

    /// A frame with blocks of these sizes, each filled with its number.
    std::vector<BindGroupEntry> frame(std::vector<size_t> const& sizes) {
        backend::CommandBuffer& commands = stream->acquire();
        blocks.begin();
        std::vector<PassBlock> added;
        for (size_t i = 0; i < sizes.size(); ++i)
            added.push_back(blocks.add(std::vector<std::byte>(sizes[i], static_cast<std::byte>(i))));
        blocks.upload(commands);
        stream->submit(commands);
        std::vector<BindGroupEntry> entries;
        for (PassBlock const& block : added) entries.push_back(blocks.entry(0, block));
        return entries;
    }

    std::unique_ptr<backend::CommandStream> stream = std::move(*backend::CommandStream::start(
            [](backend::ResultSink& sink) -> Result<std::unique_ptr<backend::Driver>> {
                return backend::validate(backend::createNullDriver(sink), sink);
            },
            { .ownThread = false }));
    PassBlocks blocks{ *stream };
};

TEST_F(PassBlocksTest, LieOneBehindTheOtherWhereTheDeviceMayBindThem) {
    const uint32_t alignment = stream->info().limits.uniformOffsetAlignment;
    const std::vector<BindGroupEntry> entries = frame({ 16, 300, 16 });
    uint64_t end = 0;
    for (BindGroupEntry const& entry : entries) {
        EXPECT_EQ(entry.offset % alignment, 0u);
        EXPECT_GE(entry.offset, end);
        end = entry.offset + entry.size;
        EXPECT_EQ(entry.buffer, entries[0].buffer);
    }
    EXPECT_EQ(entries[1].size, 300u);
}

TEST_F(PassBlocksTest, OfAFrameAreNotOverwrittenByTheTwoBehindItAndComeBackInTheThird) {
    const BindGroupEntry first = frame({ 16 })[0], second = frame({ 16 })[0], third = frame({ 16 })[0];
    EXPECT_NE(first.buffer, second.buffer);
    EXPECT_NE(second.buffer, third.buffer);
    EXPECT_NE(first.buffer, third.buffer);
    const BindGroupEntry fourth = frame({ 16 })[0];
    EXPECT_EQ(fourth.buffer, first.buffer);
    EXPECT_EQ(fourth.offset, first.offset);
}

TEST_F(PassBlocksTest, GrowToTheLargestFrameAndStay) {
    std::set<uint32_t> buffers;
    for (const size_t count : { 1, 100, 5, 100, 50, 100, 1, 1, 1, 99, 99, 99 }) {
        for (BindGroupEntry const& entry : frame(std::vector<size_t>(count, 64))) buffers.insert(entry.buffer.bits);
    }
    EXPECT_LE(buffers.size(), 6u) << "two for each of three sets";
    EXPECT_TRUE(frame({}).empty()) << "a frame without blocks uploads none";
}

} // namespace
} // namespace filament_core::passes
