// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/FrameData.h"

#include "backend/null/NullDriver.h"
#include "filament_core/prepare/ObjectData.h"
#include "shaders/interface/LtcTable.h"
#include "shaders/interface/ShaderInterface.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <vector>

namespace filament_core::passes {
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

/// What shaders would read: the contents of buffers, and which of them a bind group refers to.
struct BufferMemory {
    std::map<uint32_t, std::vector<std::byte>> buffers;
    std::map<uint32_t, std::map<uint8_t, backend::BindGroupEntry>> groups;
    uint32_t created = 0;

    void execute(CmdCreateBuffer const& c) { buffers[c.handle.bits].resize(c.desc.size), ++created; }
    void execute(CmdUpdateBuffer const& c) {
        std::vector<std::byte>& buffer = buffers.at(c.buffer.bits);
        ASSERT_LE(c.offset + c.bytes.size(), buffer.size());
        std::memcpy(buffer.data() + c.offset, c.bytes.data(), c.bytes.size());
    }
    void execute(backend::CmdCreateBindGroup const& c) {
        ++created;
        for (backend::BindGroupEntry const& entry : c.desc.entries) groups[c.handle.bits][entry.binding] = entry;
    }
    void execute(auto const&) {}

    /// `bytes` of a storage buffer, from element `first` on.
    std::span<const std::byte> readStorage(ViewGroup const& group, shader::ViewBinding binding, size_t first,
                                           size_t bytes) {
        backend::BindGroupEntry const& entry = groups.at(group.handle.bits).at(binding);
        EXPECT_LE(first + bytes, entry.size);
        return std::span(buffers.at(entry.buffer.bits)).subspan(first, bytes);
    }

    /// `bytes` of the range that a binding refers to, at the dynamic offset of the command.
    std::span<const std::byte> read(backend::CmdBindGroup const& bind, shader::ViewBinding binding, size_t bytes) {
        backend::BindGroupEntry const& entry = groups.at(bind.group.bits).at(binding);
        const uint32_t offset = bind.dynamicOffsets[binding]; // the two buffers come first
        EXPECT_EQ(offset % 256, 0u);
        EXPECT_LE(bytes, entry.size);
        EXPECT_LE(offset + entry.size, buffers.at(entry.buffer.bits).size()) << "the window ends outside of the buffer";
        return std::span(buffers.at(entry.buffer.bits)).subspan(offset, bytes);
    }
};

bool isEqual(std::span<const std::byte> a, std::span<const std::byte> b) { return std::ranges::equal(a, b); }

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

    /// Prepares and uploads the cube's current contents; `commands` receives the result.
    prepare::FramePacket upload() {
        arena.reset();
        commands.reset();
        const uint32_t count = boxes.scene.renderables.count();
        const prepare::FramePacket packet =
                prepareFrame(jobs, arena, boxes.scene, prepare::BoxScene::cubeView(std::max(count, 1u)));
        data.upload(jobs, commands, packet);
        return packet;
    }

    prepare::FramePacket upload(std::span<const prepare::ViewInput> views) {
        arena.reset();
        commands.reset();
        const prepare::FramePacket packet = prepareFrame(jobs, arena, boxes.scene, views);
        data.upload(jobs, commands, packet);
        replay(commands.view(), memory);
        return packet;
    }

    /// Some views see much, some little, some nothing.
    static std::vector<prepare::ViewInput> manyViews(uint32_t count) {
        using prepare::ViewKind;
        const prepare::ViewInput all = prepare::BoxScene::cubeView(count);
        std::vector<prepare::ViewInput> views(6, all);
        views[1].camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, 10 });
        views[2].kind = ViewKind::Shadow;
        views[3].camera = Camera::lookAt({ 3, 2, -4 }, { 0, 0, -10 });
        views[4].kind = ViewKind::Depth;
        views[4].camera = views[1].camera;
        return views;
    }

    void expectReadsItsObjects(prepare::ObjectList const& list, ViewGroup const& group) {
        for (uint32_t i = 0; i < list.size(); ++i) {
            const auto window = memory.read(group.bind(i), shader::kBindingObjects, sizeof(shader::ObjectUniforms));
            const shader::ObjectData expected =
                    prepare::objectData(list.placements[list.order[i].renderable], list.cameraWorld);
            const auto read = window.subspan(i % shader::kObjectsPerWindow * sizeof expected, sizeof expected);
            ASSERT_TRUE(isEqual(read, std::as_bytes(std::span(&expected, 1)))) << "object " << i;
        }
    }

    BufferMemory memory;

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
    ASSERT_EQ(data.views().size(), 1u);
    EXPECT_TRUE(data.views()[0].handle);
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
    // Three sets, each with a frame, a light and a froxel buffer and with object buffers of 1, 2, 4, 8 and 16 windows.
    EXPECT_LE(created.size(), 3u * (3 + 5));
}

TEST_F(FrameDataTest, SteadyFramesUseTheMemoryOfTheFrameBefore) {
    boxes.addCube(5000, 1, 1);
    for (int frame = 0; frame < 6; ++frame) upload();
    const size_t reserved = commands.bytesReserved();
    for (int frame = 0; frame < 20; ++frame) upload();
    EXPECT_EQ(commands.bytesReserved(), reserved);
}

TEST_F(FrameDataTest, EveryViewReadsItsOwnUniformsLightsAndObjects) {
    boxes.addCube(3000, 3, 5);
    for (int i = 0; i < 40; ++i) {
        addLight(boxes.scene, { .type = scene::LightRecord::Type::Point,
                                .positionWorld = { 0, 0, -i },
                                .intensity = 1.0f + static_cast<float>(i),
                                .rangeMeters = 3 });
    }
    const std::vector<prepare::ViewInput> views = manyViews(3000);
    const prepare::FramePacket packet = upload(views);
    ASSERT_EQ(data.views().size(), views.size());
    EXPECT_GT(packet.views[3].lights.size(), 0u);
    EXPECT_NE(packet.views[3].lights.size(), packet.views[0].lights.size());
    EXPECT_GT(packet.views[0].froxels.words.size(), 0u);
    EXPECT_GT(packet.views[3].froxels.words.size(), 0u);
    for (size_t i = 0; i < views.size(); ++i) {
        prepare::ViewPacket const& view = packet.views[i];
        ViewGroup const& group = data.views()[i];
        shader::FrameUniforms uniforms;
        std::memcpy(&uniforms, memory.read(group.bind(0), shader::kBindingFrame, sizeof uniforms).data(),
                    sizeof uniforms);
        const auto lights = static_cast<size_t>(uniforms.froxelPlaces.y) * sizeof(shader::PunctualLight);
        const auto words = static_cast<size_t>(uniforms.froxelPlaces.z) * sizeof(uint32_t);
        EXPECT_TRUE(isEqual(memory.readStorage(group, shader::kBindingLights, lights, view.lights.size_bytes()),
                            std::as_bytes(view.lights)))
                << "lights of view " << i;
        EXPECT_TRUE(isEqual(memory.readStorage(group, shader::kBindingFroxels, words, view.froxels.words.size_bytes()),
                            std::as_bytes(view.froxels.words)))
                << "froxels of view " << i;
        uniforms.froxelPlaces.y = uniforms.froxelPlaces.z = 0;
        EXPECT_TRUE(isEqual(std::as_bytes(std::span(&uniforms, 1)), std::as_bytes(std::span(&view.uniforms, 1))))
                << "uniforms of view " << i;
        expectReadsItsObjects(view.objects, group);
        if (testing::Test::HasFatalFailure()) FAIL() << "view " << i;
    }
}

TEST_F(FrameDataTest, UploadsOnlyTheBytesOfLightsAndFroxelsThatAFrameUses) {
    const auto uploaded = [&] {
        size_t bytes = 0;
        for (CmdUpdateBuffer const& update : commandsOf<CmdUpdateBuffer>(commands)) bytes += update.bytes.size();
        return bytes - sizeof(shader::FrameUniforms);
    };
    upload();
    EXPECT_EQ(uploaded(), 0u) << "no lights, no bytes";
    boxes.add({ 0, 0, -5 }, boxes.material()); // lit, in view
    for (int i = 0; i < 40; ++i) {
        addLight(boxes.scene, { .type = scene::LightRecord::Type::Point,
                                .positionWorld = { 0, 0, -i },
                                .intensity = 1,
                                .rangeMeters = 3 });
    }
    const prepare::FramePacket packet = upload();
    prepare::ViewPacket const& view = packet.mainView();
    EXPECT_GT(view.froxels.words.size(), 0u);
    const size_t objects = view.objects.size() * sizeof(shader::ObjectData);
    EXPECT_EQ(uploaded(), objects + view.lights.size_bytes() + view.froxels.words.size_bytes());
}

TEST_F(FrameDataTest, UploadsTheTableOfAreaLightsOnlyIfAViewHasSome) {
    const auto tables = [&] {
        return std::ranges::count_if(commandsOf<CmdUpdateBuffer>(commands), [](CmdUpdateBuffer const& update) {
            return update.bytes.size() == sizeof(shader::kLtcTable);
        });
    };
    const std::vector<prepare::ViewInput> views = manyViews(1);
    const auto one = std::span(views).first(1);
    boxes.add({ 0, 0, -5 }, boxes.material()); // lit, in view
    addLight(boxes.scene, { .type = scene::LightRecord::Type::Point, .intensity = 1 });
    upload(one);
    EXPECT_EQ(tables(), 0);
    addLight(boxes.scene, { .type = scene::LightRecord::Type::Disc, .intensity = 1, .halfExtent = { 1, 1 } });
    upload(one);
    EXPECT_EQ(tables(), 1);
    ViewGroup const& group = data.views()[0];
    shader::FrameUniforms uniforms;
    std::memcpy(&uniforms, memory.read(group.bind(0), shader::kBindingFrame, sizeof uniforms).data(), sizeof uniforms);
    const auto at = static_cast<size_t>(uniforms.froxelPlaces.w) * sizeof(float);
    EXPECT_TRUE(isEqual(memory.readStorage(group, shader::kBindingFroxels, at, sizeof(shader::kLtcTable)),
                        std::as_bytes(std::span(shader::kLtcTable))));
}

TEST_F(FrameDataTest, UploadsTheProfilesOfAView) {
    std::vector<uint32_t> words(1000);
    std::iota(words.begin(), words.end(), 17u);
    const auto profile = std::make_shared<const std::vector<uint32_t>>(words);
    const auto other = std::make_shared<const std::vector<uint32_t>>(77, 5u);
    const std::vector<prepare::ViewInput> views = manyViews(1);
    const auto one = std::span(views).first(1);
    boxes.add({ 0, 0, -5 }, boxes.material()); // lit, in view
    using Type = scene::LightRecord::Type;
    addLight(boxes.scene, { .type = Type::Disc, .intensity = 1, .halfExtent = { 1, 1 } });
    for (auto const& each : { profile, other, profile })
        addLight(boxes.scene, { .type = Type::Point, .intensity = 1, .profile = each });
    upload(one);
    ViewGroup const& group = data.views()[0];
    shader::FrameUniforms uniforms;
    std::memcpy(&uniforms, memory.read(group.bind(0), shader::kBindingFrame, sizeof uniforms).data(), sizeof uniforms);
    const auto first = static_cast<uint32_t>(uniforms.skyFactor.w);
    EXPECT_EQ(first, static_cast<uint32_t>(uniforms.froxelPlaces.w) + shader::kLtcTable.size()) << "behind the table";
    const auto read = [&](uint32_t word, size_t count) {
        return memory.readStorage(group, shader::kBindingFroxels, size_t{ word } * 4, count * 4);
    };
    const std::vector<uint32_t>* const expected[] = { profile.get(), other.get(), profile.get() };
    for (uint32_t i = 0; i < 3; ++i) {
        uint32_t place = 0;
        std::memcpy(&place, read(first + i * shader::kProfiledLightWords + 3, 1).data(), 4);
        EXPECT_TRUE(isEqual(read(first + place, expected[i]->size()), std::as_bytes(std::span(*expected[i])))) << i;
    }
    size_t bytes = 0;
    for (CmdUpdateBuffer const& update : commandsOf<CmdUpdateBuffer>(commands)) {
        if (update.bytes.size() == words.size() * 4) ++bytes;
    }
    EXPECT_EQ(bytes, 1u) << "two lights share it";
}

TEST_F(FrameDataTest, FramesOfManyAndOfOneViewTakeTurnsWithoutCreatingAnything) {
    boxes.addCube(2000, 1, 1);
    const std::vector<prepare::ViewInput> views = manyViews(2000);
    const auto one = std::span(views).first(1);
    for (int frame = 0; frame < 12; ++frame) upload(frame % 2 ? std::span(views) : one);
    memory.created = 0;
    const size_t reserved = commands.bytesReserved();
    for (int frame = 0; frame < 12; ++frame) upload(frame % 2 ? std::span(views) : one);
    EXPECT_EQ(memory.created, 0u);
    EXPECT_EQ(commands.bytesReserved(), reserved);
}

} // namespace
} // namespace filament_core::passes
