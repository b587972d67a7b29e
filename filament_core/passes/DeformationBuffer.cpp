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

BindGroupHandle DeformationBuffer::groupFor(CommandStream& stream, CommandBuffer& commands, TextureHandle deltas,
                                            bool isOfMotion) {
    const auto known = std::ranges::find_if(
            mGroups, [&](Group const& group) { return group.deltas == deltas && group.isOfMotion == isOfMotion; });
    if (known != mGroups.end()) {
        known->lastUse = mFrame;
        return known->handle;
    }
    const std::array<BindGroupEntry, 5> entries{ {
            { .binding = shader::kBindingBones, .buffer = mBuffer, .size = kBoneWindow },
            { .binding = shader::kBindingMorph, .buffer = mBuffer, .size = kMorphWindow },
            { .binding = shader::kBindingMorphDeltas, .texture = deltas, .sampler = mNearest },
            { .binding = shader::kBindingLastBones, .buffer = mBuffer, .size = kBoneWindow },
            { .binding = shader::kBindingLastMorph, .buffer = mBuffer, .size = kMorphWindow },
    } };
    const BindGroupLayout layout = shader::deformationGroupLayout(isOfMotion);
    mGroups.reserve(mGroups.size() + 1);
    NewHandle group(stream, stream.allocateBindGroup());
    commands.record(CmdCreateBindGroup{ group, { layout, std::span(entries).first(layout.count), "deformation" } });
    mGroups.push_back({ deltas, isOfMotion, group.keep(), mFrame });
    return mGroups.back().handle;
}

void DeformationBuffer::upload(CommandStream& stream, jobs::JobSystem& jobs, CommandBuffer& commands,
                               prepare::DeformationList const& list) {
    mBinds.clear();
    mLastBinds.clear();
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
    mLastBinds.resize(list.last.size());
    for (size_t i = 0; i < mBinds.size(); ++i) bind(stream, commands, list.places[i], i);
}

// Offsets are in the order of the layout.
void DeformationBuffer::bind(CommandStream& stream, CommandBuffer& commands, prepare::DeformationPlace const& place,
                             size_t slot) {
    const TextureHandle deltas = place.deltas ? place.deltas : mNoDeltas;
    if (place.weights != prepare::kNowhere) {
        mBinds[slot] = {
            groupFor(stream, commands, deltas, false), shader::kGroupDeformation, 2, { place.bones, place.weights }
        };
    }
    if (place.lastWeights != prepare::kNowhere) {
        mLastBinds[slot] = { groupFor(stream, commands, deltas, true),
                             shader::kGroupDeformation,
                             4,
                             { place.bones, place.weights, place.lastBones, place.lastWeights } };
    }
}

void DeformationBuffer::destroy(CommandStream& stream, CommandBuffer& commands) {
    dropUnused(stream, commands, 0);
    if (mBuffer) stream.destroy(commands, std::exchange(mBuffer, {}));
    if (mNoDeltas) stream.destroy(commands, std::exchange(mNoDeltas, {}));
    if (mNearest) stream.destroy(commands, std::exchange(mNearest, {}));
    *this = {};
}

} // namespace filament_core::passes
