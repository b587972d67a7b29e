// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/FrameData.h"

#include "filament_core/prepare/ObjectData.h"
#include "shaders/package/ViewLayout.h"

#include <algorithm>
#include <utility>

namespace filament::passes {
namespace {

using namespace backend;
using shader::FrameUniforms;
using shader::kObjectsPerWindow;

constexpr uint32_t kWindowBytes = sizeof(shader::ObjectUniforms);
constexpr size_t kCacheLineBytes = 64;

template <class T>
std::span<const std::byte> bytesOf(T const& value) {
    return std::as_bytes(std::span(&value, 1));
}

} // namespace

BufferHandle FrameData::createBuffer(CommandBuffer& commands, uint64_t bytes, const char* name) {
    NewHandle handle(mStream, mStream.allocateBuffer());
    commands.record(CmdCreateBuffer{ handle, { bytes, BufferUsage::Uniform, name } });
    return handle.keep();
}

void FrameData::release(CommandBuffer& commands, BindGroupHandle& group) {
    if (group) mStream.destroy(commands, std::exchange(group, {}));
}

void FrameData::release(CommandBuffer& commands, BufferHandle& buffer) {
    if (buffer) mStream.destroy(commands, std::exchange(buffer, {}));
}

// Each step is remembered when it is recorded: a frame that runs out of memory here is left out, and the next one makes
// what is missing.
void FrameData::makeObjects(CommandBuffer& commands, Set& set, uint32_t windows) {
    release(commands, set.view);
    release(commands, set.objects);
    const uint32_t grown = std::max(windows, set.windows * 2);
    set.windows = 0;
    set.objects = createBuffer(commands, static_cast<uint64_t>(grown) * kWindowBytes, "objects");
    set.windows = grown;
}

void FrameData::makeFixed(CommandBuffer& commands, Set& set) {
    if (!set.frame) set.frame = createBuffer(commands, sizeof(FrameUniforms), "frame");
    if (!set.lights) set.lights = createBuffer(commands, sizeof(shader::LightUniforms), "lights");
    if (set.post) return;
    const BindGroupEntry entry{ .binding = shader::kBindingFrame, .buffer = set.frame, .size = sizeof(FrameUniforms) };
    NewHandle post(mStream, mStream.allocateBindGroup());
    commands.record(CmdCreateBindGroup{
            post, { shader::viewGroupLayout(shader::MaterialDomain::PostProcess), std::span(&entry, 1), "post" } });
    set.post = post.keep();
}

void FrameData::bind(CommandBuffer& commands, Set& set, ViewTextures const& textures) {
    release(commands, set.view);
    set.textures = textures;
    const std::array<BindGroupEntry, 7> entries{ {
            { .binding = shader::kBindingFrame, .buffer = set.frame, .size = sizeof(FrameUniforms) },
            { .binding = shader::kBindingObjects, .buffer = set.objects, .size = kWindowBytes },
            { .binding = shader::kBindingLights, .buffer = set.lights, .size = sizeof(shader::LightUniforms) },
            { .binding = shader::kBindingSpecular, .texture = textures.specular, .sampler = textures.trilinear },
            { .binding = shader::kBindingDfg, .texture = textures.dfg, .sampler = textures.bilinear },
            { .binding = shader::kBindingSky, .texture = textures.sky, .sampler = textures.bilinear },
            { .binding = shader::kBindingIrradiance, .texture = textures.irradiance, .sampler = textures.bilinear },
    } };
    NewHandle view(mStream, mStream.allocateBindGroup());
    commands.record(CmdCreateBindGroup{ view, { shader::viewGroupLayout(), entries, "view" } });
    set.view = view.keep();
}

// A whole set's worth of memory whatever the number of objects, so that the buffer finds the block of an earlier frame
// again; the objects are written into it and nowhere else.
void FrameData::uploadObjects(jobs::JobSystem& jobs, CommandBuffer& commands, Set const& set,
                              prepare::ObjectList const& list) {
    if (list.empty()) return;
    const std::span<std::byte> memory = commands.allocate(set.windows * size_t{ kWindowBytes }, kCacheLineBytes);
    const std::span objects(reinterpret_cast<shader::ObjectData*>(memory.data()), list.size());
    prepare::writeObjects(jobs, list, objects);
    commands.recordAdopted(CmdUpdateBuffer{ set.objects, 0, std::as_bytes(objects) });
}

void FrameData::upload(jobs::JobSystem& jobs, CommandBuffer& commands, prepare::FramePacket const& packet,
                       ViewTextures const& textures) {
    mCurrent = (mCurrent + 1) % static_cast<uint32_t>(mSets.size());
    Set& set = mSets[mCurrent];
    prepare::ViewPacket const& view = packet.mainView();
    const auto objects = static_cast<uint32_t>(view.objects.size());
    const uint32_t windows = std::max(1u, (objects + kObjectsPerWindow - 1) / kObjectsPerWindow);
    if (windows > set.windows) makeObjects(commands, set, windows);
    makeFixed(commands, set);
    if (!set.view || set.textures != textures) bind(commands, set, textures);

    commands.record(CmdUpdateBuffer{ set.frame, 0, bytesOf(view.uniforms) });
    if (!view.lights.empty()) commands.record(CmdUpdateBuffer{ set.lights, 0, std::as_bytes(view.lights) });
    uploadObjects(jobs, commands, set, view.objects);
    set.deformation.upload(mStream, jobs, commands, packet.deformations);
}

CmdBindGroup FrameData::bindView(BindGroupHandle group, uint32_t object) {
    // In the order of the layout: frame, objects, lights.
    return { group, shader::kGroupView, 3, { 0, object / kObjectsPerWindow * kWindowBytes, 0 } };
}

void FrameData::destroy(CommandBuffer& commands) {
    for (Set& set : mSets) {
        release(commands, set.view);
        release(commands, set.post);
        release(commands, set.frame);
        release(commands, set.lights);
        release(commands, set.objects);
        set.deformation.destroy(mStream, commands);
        set = {};
    }
}

} // namespace filament::passes
