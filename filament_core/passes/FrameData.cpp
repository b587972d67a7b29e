// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/FrameData.h"

#include "filament_core/prepare/ObjectData.h"
#include "shaders/interface/LtcTable.h"
#include "shaders/package/GroupLayouts.h"

#include <algorithm>
#include <utility>

namespace filament_core::passes {
namespace {

using namespace backend;
using shader::FrameUniforms;
using shader::kObjectsPerWindow;

// A uniform offset that every device accepts.
constexpr uint32_t kAlignment = 256;
constexpr uint32_t kUniformBytes = (sizeof(FrameUniforms) + kAlignment - 1) / kAlignment * kAlignment;
constexpr uint32_t kWindowBytes = sizeof(shader::ObjectUniforms);
constexpr uint32_t kLightBytes = sizeof(shader::PunctualLight);
constexpr uint32_t kWordBytes = sizeof(uint32_t);
static_assert(kWindowBytes % kAlignment == 0);

// At least one, so that there is something to bind.
uint32_t windowsOf(prepare::ViewPacket const& view) {
    const auto objects = static_cast<uint32_t>(view.objects.size());
    return std::max(1u, (objects + kObjectsPerWindow - 1) / kObjectsPerWindow);
}

template <class T>
std::span<const std::byte> bytesOf(T const& value) {
    return std::as_bytes(std::span(&value, 1));
}

} // namespace

void FrameData::release(CommandBuffer& commands, BindGroupHandle& group) {
    if (group) mStream.destroy(commands, std::exchange(group, {}));
}

void FrameData::release(CommandBuffer& commands, Blocks& blocks) {
    if (blocks.buffer) mStream.destroy(commands, std::exchange(blocks.buffer, {}));
    blocks.capacity = 0;
}

// Each step is remembered as soon as it is recorded: if a frame runs out of memory here, it is left out, and the next
// one creates the rest.
void FrameData::reserve(CommandBuffer& commands, Set& set, Blocks& blocks, uint32_t count, BlockKind const& kind) {
    if (count <= blocks.capacity) return;
    const uint32_t grown = std::max(count, blocks.capacity * 2);
    // The group names the buffers: it goes with any of them, and bindViews() makes another once all have their place.
    release(commands, set.view);
    release(commands, blocks);
    NewHandle handle(mStream, mStream.allocateBuffer());
    commands.record(CmdCreateBuffer{ handle, { uint64_t{ grown } * kind.bytes, kind.usage, kind.name } });
    blocks = { handle.keep(), grown };
    if (&blocks == &set.froxels) set.images.clear();
}

FrameData::Needs FrameData::placeViews(prepare::FramePacket const& packet) {
    prepare::LightImageLists const& images = packet.mainView().images;
    Needs needs{ .lights = static_cast<uint32_t>(images.records.size()), .words = images.words };
    mViews.clear();
    mLists.clear();
    const auto place = [&](size_t lights, size_t words) {
        const ViewGroup group{ .uniforms = needs.views * kUniformBytes,
                               .objects = needs.windows * kWindowBytes,
                               .firstLight = needs.lights,
                               .firstWord = needs.words };
        ++needs.views;
        needs.lights += static_cast<uint32_t>(lights);
        needs.words += static_cast<uint32_t>(words);
        return group;
    };
    for (prepare::ViewPacket const& view : packet.views) {
        mViews.push_back(place(view.lights.size(), view.froxels.words.size()));
        for (prepare::ChannelLights const& list : view.channels.lists)
            mLists.push_back(place(list.lights.size(), list.froxels.words.size()));
        needs.windows += windowsOf(view);
        needs.hasTable = needs.hasTable || view.hasAreaLights;
    }
    if (!packet.fields().empty()) {
        mViews[0].fields = needs.windows * kWindowBytes;
        for (ViewGroup& list : std::span(mLists).first(packet.mainView().channels.lists.size()))
            list.fields = mViews[0].fields;
        // One more: what is bound with the last field is a whole window.
        const auto bytes = static_cast<uint32_t>(packet.fields().size_bytes());
        needs.windows += (bytes + kWindowBytes - 1) / kWindowBytes + 1;
    }
    needs.table = needs.words;
    if (needs.hasTable) needs.words += static_cast<uint32_t>(shader::kLtcTable.size());
    for (size_t i = 0; i < mViews.size(); ++i) {
        prepare::ProfileLists const& profiles = packet.views[i].profiles;
        if (profiles.empty()) continue;
        mViews[i].firstProfileWord = needs.words;
        needs.words += static_cast<uint32_t>(profiles.lights.size());
        for (auto const& table : profiles.tables) needs.words += static_cast<uint32_t>(table.size());
    }
    needs.lights = std::max(1u, needs.lights); // something to bind
    needs.words = std::max(1u, needs.words);
    return needs;
}

void FrameData::bindViews(CommandBuffer& commands, Set& set) {
    const auto [frame, lights, froxels] = viewBuffers();
    const BindGroupEntry objects{ .binding = shader::kBindingObjects,
                                  .buffer = set.objects.buffer,
                                  .size = kWindowBytes };
    const std::array entries{ frame, objects, lights, froxels };
    NewHandle view(mStream, mStream.allocateBindGroup());
    commands.record(CmdCreateBindGroup{ view, { shader::viewGroupLayout(), entries, "view" } });
    set.view = view.keep();
}

std::array<BindGroupEntry, 3> FrameData::viewBuffers() const {
    Set const& set = mSets[mCurrent];
    return {
        { { .binding = shader::kBindingFrame, .buffer = set.uniforms.buffer, .size = sizeof(FrameUniforms) },
          { .binding = shader::kBindingLights, .buffer = set.lights.buffer, .size = set.lights.capacity * kLightBytes },
          { .binding = shader::kBindingFroxels,
            .buffer = set.froxels.buffer,
            .size = set.froxels.capacity * kWordBytes } }
    };
}

// Always allocates for a whole set, whatever the number of objects, so that the command buffer can reuse the block of
// an earlier frame. The objects are written directly into it.
void FrameData::uploadObjects(jobs::JobSystem& jobs, CommandBuffer& commands, Set const& set,
                              prepare::FramePacket const& packet) {
    if (std::ranges::all_of(packet.views, [](auto const& view) { return view.objects.empty(); })) return;
    const std::span<std::byte> memory =
            commands.allocate(set.objects.capacity * size_t{ kWindowBytes }, jobs::kCacheLineBytes);
    for (size_t i = 0; i < mViews.size(); ++i) {
        prepare::ObjectList const& list = packet.views[i].objects;
        if (list.empty()) continue;
        const uint32_t first = mViews[i].objects;
        const std::span objects(reinterpret_cast<shader::ObjectData*>(memory.data() + first), list.size());
        prepare::writeObjects(jobs, list, objects);
        commands.recordAdopted(CmdUpdateBuffer{ set.objects.buffer, first, std::as_bytes(objects) });
    }
    const std::span fields = std::as_bytes(packet.fields());
    if (!fields.empty()) commands.record(CmdUpdateBuffer{ set.objects.buffer, mViews[0].fields, fields });
}

// The only bytes of lights and froxels that a frame uploads are those that it uses.
void FrameData::uploadLights(CommandBuffer& commands, Set const& set, FrameUniforms uniforms,
                             std::span<const shader::PunctualLight> lights, std::span<const uint32_t> froxelWords,
                             ViewGroup const& group) {
    uniforms.froxelPlaces.y = static_cast<float>(group.firstLight);
    uniforms.froxelPlaces.z = static_cast<float>(group.firstWord);
    commands.record(CmdUpdateBuffer{ set.uniforms.buffer, group.uniforms, bytesOf(uniforms) });
    const std::span lightBytes = std::as_bytes(lights), words = std::as_bytes(froxelWords);
    if (!lightBytes.empty())
        commands.record(CmdUpdateBuffer{ set.lights.buffer, uint64_t{ group.firstLight } * kLightBytes, lightBytes });
    if (!words.empty())
        commands.record(CmdUpdateBuffer{ set.froxels.buffer, uint64_t{ group.firstWord } * kWordBytes, words });
}

void FrameData::uploadView(CommandBuffer& commands, Set const& set, prepare::ViewPacket const& view,
                           ViewGroup const& group, uint32_t table) {
    const auto withTable = [&](FrameUniforms uniforms) {
        if (view.hasAreaLights) uniforms.froxelPlaces.w = static_cast<float>(table);
        if (!view.profiles.empty()) uniforms.skyFactor.w = static_cast<float>(group.firstProfileWord);
        return uniforms;
    };
    uploadLights(commands, set, withTable(view.uniforms), view.lights, view.froxels.words, group);
    ViewGroup const* at = group.lists;
    for (prepare::ChannelLights const& list : view.channels.lists)
        uploadLights(commands, set, withTable(list.uniforms), list.lights, list.froxels.words, *at++);
    if (!view.profiles.empty()) uploadProfiles(commands, set, view.profiles, group.firstProfileWord);
}

void FrameData::uploadProfiles(CommandBuffer& commands, Set const& set, prepare::ProfileLists const& profiles,
                               uint32_t firstWord) {
    const auto upload = [&](std::span<const uint32_t> words) {
        commands.record(
                CmdUpdateBuffer{ set.froxels.buffer, uint64_t{ firstWord } * kWordBytes, std::as_bytes(words) });
        firstWord += static_cast<uint32_t>(words.size());
    };
    upload(profiles.lights);
    for (auto const& table : profiles.tables) upload(table);
}

// Tables are as large as textures, and stay where they are while the same images are in view.
void FrameData::uploadImages(CommandBuffer& commands, Set& set, prepare::LightImageLists const& images) {
    if (!images.empty()) commands.record(CmdUpdateBuffer{ set.lights.buffer, 0, std::as_bytes(images.records) });
    mImages.clear();
    uint32_t word = shader::kFirstImageWord;
    for (auto const& table : images.tables) {
        mImages.push_back({ table[3], word });
        word += static_cast<uint32_t>(table.size());
    }
    if (mImages == set.images) return;
    set.images.clear(); // until all are there
    for (size_t i = 0; i < images.tables.size(); ++i) {
        commands.record(CmdUpdateBuffer{ set.froxels.buffer, uint64_t{ mImages[i].word } * kWordBytes,
                                         std::as_bytes(images.tables[i]) });
    }
    std::swap(set.images, mImages);
}

void FrameData::upload(jobs::JobSystem& jobs, CommandBuffer& commands, prepare::FramePacket const& packet) {
    // The sets are used in turn: frames before this one may still be replayed, or read by the device.
    mCurrent = (mCurrent + 1) % static_cast<uint32_t>(mSets.size());
    Set& set = mSets[mCurrent];
    // All places are known before anything is uploaded: buffers grow once, and the group is made at most once.
    const Needs needs = placeViews(packet);
    reserve(commands, set, set.objects, needs.windows, { kWindowBytes, BufferUsage::Uniform, "objects" });
    reserve(commands, set, set.uniforms, needs.views, { kUniformBytes, BufferUsage::Uniform, "frame" });
    reserve(commands, set, set.lights, needs.lights, { kLightBytes, BufferUsage::Storage, "lights" });
    reserve(commands, set, set.froxels, needs.words, { kWordBytes, BufferUsage::Storage, "froxels" });
    if (!set.view) bindViews(commands, set);
    uploadImages(commands, set, packet.mainView().images);
    for (ViewGroup& list : mLists) list.handle = set.view;
    ViewGroup const* lists = mLists.data();
    for (size_t i = 0; i < mViews.size(); ++i) {
        mViews[i].handle = set.view;
        mViews[i].lists = std::exchange(lists, lists + packet.views[i].channels.lists.size());
        uploadView(commands, set, packet.views[i], mViews[i], needs.table);
    }
    if (needs.hasTable) {
        commands.record(CmdUpdateBuffer{ set.froxels.buffer, uint64_t{ needs.table } * kWordBytes,
                                         std::as_bytes(std::span(shader::kLtcTable)) });
    }
    uploadObjects(jobs, commands, set, packet);
    set.deformation.upload(mStream, jobs, commands, packet.deformations);
}

CmdBindGroup ViewGroup::bind(uint32_t object) const {
    // In the order of the layout: frame, objects.
    return { handle, shader::kGroupView, 2, { uniforms, objects + object / kObjectsPerWindow * kWindowBytes } };
}

CmdBindGroup ViewGroup::bindField(uint32_t field) const {
    constexpr uint32_t kFieldBytes = sizeof(shader::IrradianceField);
    static_assert(kFieldBytes % kAlignment == 0);
    return { handle, shader::kGroupView, 2, { uniforms, fields + field * kFieldBytes } };
}

void FrameData::destroy(CommandBuffer& commands) {
    for (Set& set : mSets) {
        release(commands, set.view);
        release(commands, set.uniforms);
        release(commands, set.lights);
        release(commands, set.froxels);
        release(commands, set.objects);
        set.deformation.destroy(mStream, commands);
        set = {};
    }
}

} // namespace filament_core::passes
