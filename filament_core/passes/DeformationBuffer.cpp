// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DeformationBuffer.h"

#include "backend/stream/RecordingGuards.h"
#include "filament_core/prepare/DeformationData.h"
#include "shaders/package/GroupLayouts.h"

#include <algorithm>
#include <array>
#include <utility>

namespace filament_core::passes {
namespace {

using namespace backend;

constexpr uint32_t kWindow = sizeof(shader::DeformationUniforms); // also the tail: one may start at the last block
constexpr uint32_t kRowTexels = shader::kBonesPerRow * sizeof(shader::BoneData) / sizeof(float4);

uint32_t rowsOf(uint32_t bones) { return (bones + shader::kBonesPerRow - 1) / shader::kBonesPerRow; }

} // namespace

void DeformationBuffer::dropUnused(CommandStream& stream, CommandBuffer& commands, uint32_t keptFrames) {
    for (size_t i = mGroups.size(); i-- > 0;) {
        if (mFrame - mGroups[i].lastUse < keptFrames) continue;
        stream.destroy(commands, mGroups[i].handle);
        mGroups.erase(mGroups.begin() + static_cast<ptrdiff_t>(i));
    }
}

void DeformationBuffer::reserve(CommandStream& stream, CommandBuffer& commands, uint32_t bytes) {
    if (bytes <= mBytes) return;
    // The groups name the buffer, and go before it. Until the next one is recorded there is none: if memory runs out in
    // between, the next frame creates it, and uses no handle of a destroyed one.
    dropUnused(stream, commands, 0);
    if (mBuffer) stream.destroy(commands, std::exchange(mBuffer, {}));
    const uint32_t grown = std::max(bytes, mBytes * 2);
    mBytes = 0;
    NewHandle handle(stream, stream.allocateBuffer());
    commands.record(CmdCreateBuffer{ handle, { uint64_t{ grown } + kWindow, BufferUsage::Uniform, "deformations" } });
    mBuffer = handle.keep();
    mBytes = grown;
}

void DeformationBuffer::reserveRows(CommandStream& stream, CommandBuffer& commands, uint32_t rows, uint32_t most) {
    if (rows <= mRows) return;
    dropUnused(stream, commands, 0);
    if (mBones) stream.destroy(commands, std::exchange(mBones, {}));
    const uint32_t grown = std::min(std::max(rows, mRows * 2), most);
    mRows = 0;
    NewHandle texture(stream, stream.allocateTexture());
    commands.record(CmdCreateTexture{ texture,
                                      { .format = Format::RGBA32F,
                                        .usage = TextureUsage::Sampled | TextureUsage::TransferTarget,
                                        .width = kRowTexels,
                                        .height = grown,
                                        .debugName = "bones" } });
    mBones = texture.keep();
    mRows = grown;
}

/// Whole rows, or the used part of the only one. Returns how many bones this device has room for.
uint32_t DeformationBuffer::uploadBones(CommandStream& stream, jobs::JobSystem& jobs, CommandBuffer& commands,
                                        prepare::DeformationList const& list) {
    const uint32_t most = stream.info().limits.maxTextureSize, rows = std::min(rowsOf(list.boneCount), most);
    if (rows == 0) return 0;
    reserveRows(stream, commands, rows, most);
    const uint32_t bones = rows == 1 ? list.boneCount : rows * shader::kBonesPerRow;
    const size_t bytes = bones * sizeof(shader::BoneData);
    const std::span<std::byte> memory = commands.allocate(bytes, jobs::kCacheLineBytes);
    const std::span records(reinterpret_cast<shader::BoneData*>(memory.data()), bones);
    const uint32_t used = std::min(bones, list.boneCount);
    prepare::writeBones(jobs, list, records.first(used));
    // An upload covers whole rows, and no bytes of other frames may reach the device: traces of a frame are the same in
    // every run.
    std::ranges::fill(records.subspan(used), shader::BoneData{});
    const uint32_t width = rows == 1 ? bones * kRowTexels / shader::kBonesPerRow : kRowTexels;
    commands.recordAdopted(CmdUploadTexture{ mBones, 0, 0, 1, { 0, 0, width, rows }, memory });
    return bones;
}

void DeformationBuffer::makeFixed(CommandStream& stream, CommandBuffer& commands) {
    if (!mNearest) {
        NewHandle sampler(stream, stream.allocateSampler());
        commands.record(CmdCreateSampler{ sampler, {} });
        mNearest = sampler.keep();
    }
    if (mNoTexels) return;
    constexpr std::array<float, 4> kZero{};
    NewHandle texture(stream, stream.allocateTexture());
    AllOrNothing both(commands);
    commands.record(CmdCreateTexture{ texture,
                                      { .format = Format::RGBA32F,
                                        .usage = TextureUsage::Sampled | TextureUsage::TransferTarget,
                                        .debugName = "no morph targets" } });
    commands.record(CmdUploadTexture{ texture, 0, 0, 1, { 0, 0, 1, 1 }, std::as_bytes(std::span(kZero)) });
    both.complete();
    mNoTexels = texture.keep();
}

BindGroupHandle DeformationBuffer::groupFor(CommandStream& stream, CommandBuffer& commands, TextureHandle deltas) {
    const auto known = std::ranges::find(mGroups, deltas, &Group::deltas);
    if (known != mGroups.end()) {
        known->lastUse = mFrame;
        return known->handle;
    }
    const std::array entries{
        BindGroupEntry{ .binding = shader::kBindingBones, .texture = mBones, .sampler = mNearest },
        BindGroupEntry{ .binding = shader::kBindingDeformation, .buffer = mBuffer, .size = kWindow },
        BindGroupEntry{ .binding = shader::kBindingMorphDeltas, .texture = deltas, .sampler = mNearest },
    };
    // Room comes first: a group that is recorded must be remembered, or it would never be destroyed.
    mGroups.reserve(mGroups.size() + 1);
    NewHandle group(stream, stream.allocateBindGroup());
    commands.record(CmdCreateBindGroup{ group, { shader::deformationGroupLayout(), entries, "deformation" } });
    mGroups.push_back({ deltas, group.keep(), mFrame });
    return mGroups.back().handle;
}

void DeformationBuffer::upload(CommandStream& stream, jobs::JobSystem& jobs, CommandBuffer& commands,
                               prepare::DeformationList const& list) {
    mBinds.clear();
    if (list.bytes == 0 && mGroups.empty()) return;
    ++mFrame;
    dropUnused(stream, commands, kKeptFrames);
    if (list.bytes == 0) return;
    makeFixed(stream, commands);
    reserve(stream, commands, list.bytes);
    const uint32_t boneRoom = uploadBones(stream, jobs, commands, list);
    const std::span<std::byte> memory = commands.allocate(list.bytes, jobs::kCacheLineBytes);
    prepare::writeDeformations(list, boneRoom, memory);
    commands.recordAdopted(CmdUpdateBuffer{ mBuffer, 0, memory });
    mBinds.resize(list.places.size());
    for (size_t i = 0; i < mBinds.size(); ++i) {
        prepare::DeformationPlace const& place = list.places[i];
        if (place.now.begin == prepare::kNowhere) continue;
        const TextureHandle deltas = place.deltas ? place.deltas : mNoTexels;
        mBinds[i] = { groupFor(stream, commands, deltas), shader::kGroupDeformation, 1, { place.block } };
    }
}

void DeformationBuffer::destroy(CommandStream& stream, CommandBuffer& commands) {
    dropUnused(stream, commands, 0);
    if (mBuffer) stream.destroy(commands, std::exchange(mBuffer, {}));
    if (mBones) stream.destroy(commands, std::exchange(mBones, {}));
    if (mNoTexels) stream.destroy(commands, std::exchange(mNoTexels, {}));
    if (mNearest) stream.destroy(commands, std::exchange(mNearest, {}));
    *this = {};
}

} // namespace filament_core::passes
