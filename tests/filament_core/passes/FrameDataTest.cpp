// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/FrameData.h"

#include "backend/null/NullDriver.h"
#include "filament_core/prepare/ObjectData.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <vector>

namespace filament::passes {
namespace {

using backend::CmdCreateBuffer;
using backend::CmdUpdateBuffer;

/// The commands of type C in a stream.
template <class C>
std::vector<C> commandsOf(backend::CommandBuffer const& commands) {
    std::vector<C> found;
    for (backend::CommandChunk const& chunk : commands.view()) {
        for (const std::byte* at = chunk.data; at < chunk.data + chunk.size;) {
            auto const& header = *reinterpret_cast<backend::CommandHeader const*>(at);
            if (header.id == backend::kCommandId<C>) {
                found.push_back(*reinterpret_cast<C const*>(at + backend::kCommandAlignment));
            }
            at += header.bytes;
        }
    }
    return found;
}

struct FrameDataTest : testing::Test {
    std::unique_ptr<backend::CommandStream> stream = std::move(*backend::CommandStream::start(
            [](backend::ResultSink& sink) -> Result<std::unique_ptr<backend::Driver>> {
                return backend::createNullDriver(sink);
            },
            { .ownThread = false }));
    prepare::BoxScene boxes;
    jobs::JobSystem jobs{ { .workers = 1 } };
    Arena arena;
    FrameData data{ *stream };
    backend::CommandBuffer commands;

    /// Prepares and uploads what the cube holds now; `commands` holds the result.
    prepare::FramePacket upload() {
        arena.reset();
        commands.reset();
        const uint32_t count = boxes.scene.renderables.count();
        const prepare::FramePacket packet =
                prepareFrame(jobs, arena, boxes.scene, prepare::BoxScene::cubeView(std::max(count, 1u)));
        data.upload(jobs, commands, packet, {});
        return packet;
    }

    std::vector<CmdUpdateBuffer> objectUpdates() const {
        std::vector<CmdUpdateBuffer> updates = commandsOf<CmdUpdateBuffer>(commands);
        std::erase_if(updates, [](CmdUpdateBuffer const& update) {
            return update.bytes.size() == sizeof(shader::FrameUniforms);
        });
        return updates;
    }
};

TEST_F(FrameDataTest, UploadsTheObjectsInDrawOrderFromMemoryOfTheCommandBuffer) {
    boxes.addCube(3000, 3, 5);
    const prepare::FramePacket packet = upload();
    const std::vector<CmdUpdateBuffer> updates = objectUpdates();
    ASSERT_EQ(updates.size(), 1u);
    ASSERT_EQ(updates[0].bytes.size(), 3000 * sizeof(shader::ObjectData));
    EXPECT_EQ(reinterpret_cast<uintptr_t>(updates[0].bytes.data()) % 64, 0u);
    auto const* objects = reinterpret_cast<shader::ObjectData const*>(updates[0].bytes.data());
    for (size_t i = 0; i < 3000; ++i) {
        scene::Placement const& placement =
                packet.mainView().objects.placements[packet.mainView().objects.order[i].renderable];
        const shader::ObjectData expected = prepare::objectData(placement, packet.mainView().objects.cameraWorld);
        ASSERT_EQ(objects[i].row0, expected.row0) << i;
        ASSERT_EQ(objects[i].row1, expected.row1) << i;
        ASSERT_EQ(objects[i].row2, expected.row2) << i;
        ASSERT_EQ(objects[i].flags, expected.flags) << i;
    }
    EXPECT_LT(commands.bytesUsed(), 3000 * sizeof(shader::ObjectData) + 64 * 1024) << "there is one copy";
}

TEST_F(FrameDataTest, AnEmptySceneUploadsNoObjectsButHasABufferToBind) {
    upload();
    EXPECT_TRUE(objectUpdates().empty());
    EXPECT_TRUE(data.viewGroup());
}

TEST_F(FrameDataTest, ObjectBuffersGrowByDoublingAndNoFrameOverwritesTheTwoBeforeIt) {
    std::set<uint32_t> created;
    std::vector<backend::BufferHandle> targets;
    for (uint32_t frame = 0; frame < 60; ++frame) {
        boxes.addCube(50, 1, 1);
        upload();
        for (CmdCreateBuffer const& create : commandsOf<CmdCreateBuffer>(commands)) created.insert(create.handle.bits);
        ASSERT_EQ(objectUpdates().size(), 1u);
        targets.push_back(objectUpdates()[0].buffer);
        for (uint32_t before = 1; before <= 2 && before <= frame; ++before) {
            EXPECT_NE(targets[frame], targets[frame - before]) << frame;
        }
    }
    // Three sets, each with a frame and a light buffer and with object buffers of 1, 2, 4, 8 and 16 windows.
    EXPECT_LE(created.size(), 3u * (2 + 5));
}

TEST_F(FrameDataTest, SteadyFramesUseTheMemoryOfTheFrameBefore) {
    boxes.addCube(5000, 1, 1);
    for (int frame = 0; frame < 6; ++frame) upload();
    const size_t reserved = commands.bytesReserved();
    for (int frame = 0; frame < 20; ++frame) upload();
    EXPECT_EQ(commands.bytesReserved(), reserved);
}

} // namespace
} // namespace filament::passes
