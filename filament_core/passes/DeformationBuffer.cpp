// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DeformationBuffer.h"

#include "backend/stream/RecordingGuards.h"
#include "filament_core/prepare/DeformationData.h"
#include "shaders/package/GroupLayouts.h"

#include <algorithm>
#include <array>
#include <utility>

namespace filament::passes {
namespace {

using namespace backend;

constexpr uint32_t kBoneWindow = sizeof(shader::BoneUniforms), kMorphWindow = sizeof(shader::MorphUniforms);
constexpr uint32_t kTail = std::max(kBoneWindow, kMorphWindow); // a window may start at the last block

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
    dropUnused(stream, commands, 0);
    if (mBuffer) stream.destroy(commands, std::exchange(mBuffer, {}));
    const uint32_t grown = std::max(bytes, mBytes * 2);
    mBytes = 0;
    NewHandle handle(stream, stream.allocateBuffer());
    commands.record(CmdCreateBuffer{ handle, { uint64_t{ grown } + kTail, BufferUsage::Uniform, "deformations" } });
    mBuffer = handle.keep();
    mBytes = grown;
}

void DeformationBuffer::makeFixed(CommandStream& stream, CommandBuffer& commands) {
    if (!mNearest) {
        NewHandle sampler(stream, stream.allocateSampler());
        commands.record(CmdCreateSampler{ sampler, {} });
        mNearest = sampler.keep();
    }
    if (mNoDeltas) return;
    constexpr std::array<float, 4> kZero{};
    NewHandle texture(stream, stream.allocateTexture());
    AllOrNothing both(commands);
    commands.record(CmdCreateTexture{ texture,
                                      { .format = Format::RGBA32F,
                                        .usage = TextureUsage::Sampled | TextureUsage::TransferTarget,
                                        .debugName = "no morph targets" } });
    commands.record(CmdUploadTexture{ texture, 0, 0, 1, { 0, 0, 1, 1 }, std::as_bytes(std::span(kZero)) });
    both.complete();
    mNoDeltas = texture.keep();
}

BindGroupHandle DeformationBuffer::groupFor(CommandStream& stream, CommandBuffer& commands, TextureHandle deltas) {
    const auto known = std::ranges::find(mGroups, deltas, &Group::deltas);
    if (known != mGroups.end()) {
        known->lastUse = mFrame;
        return known->handle;
    }
    const std::array<BindGroupEntry, 3> entries{ {
            { .binding = shader::kBindingBones, .buffer = mBuffer, .size = kBoneWindow },
            { .binding = shader::kBindingMorph, .buffer = mBuffer, .size = kMorphWindow },
            { .binding = shader::kBindingMorphDeltas, .texture = deltas, .sampler = mNearest },
    } };
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
    const std::span<std::byte> memory = commands.allocate(list.bytes, jobs::kCacheLineBytes);
    prepare::writeDeformations(jobs, list, memory);
    commands.recordAdopted(CmdUpdateBuffer{ mBuffer, 0, memory });
    mBinds.resize(list.places.size());
    for (size_t i = 0; i < mBinds.size(); ++i) {
        prepare::DeformationPlace const& place = list.places[i];
        if (place.weights == prepare::kNowhere) continue;
        const BindGroupHandle group = groupFor(stream, commands, place.deltas ? place.deltas : mNoDeltas);
        mBinds[i] = { group, shader::kGroupDeformation, 2, { place.bones, place.weights } };
    }
}

void DeformationBuffer::destroy(CommandStream& stream, CommandBuffer& commands) {
    dropUnused(stream, commands, 0);
    if (mBuffer) stream.destroy(commands, std::exchange(mBuffer, {}));
    if (mNoDeltas) stream.destroy(commands, std::exchange(mNoDeltas, {}));
    if (mNearest) stream.destroy(commands, std::exchange(mNearest, {}));
    *this = {};
}

} // namespace filament::passes
