// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DeformationData.h"

#include "filament_core/prepare/HashWords.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace filament_core::prepare {
namespace {

using scene::Deformation;

// A uniform offset that every device accepts.
constexpr uint32_t kAlignment = 256;
constexpr size_t kBlocksPerJob = 32;
static_assert(sizeof(shader::DeformationUniforms) <= kAlignment);
constexpr uint32_t kTexelsOfBone = 3;

/// Of the renderable at position `at`: the items of a range are in the order of the scene.
bool isSeen(VisibleItems const& view, uint32_t at) {
    const size_t range = at / kCullRange;
    const auto items = view.slots.subspan(range * kCullRange, view.firsts[range + 1] - view.firsts[range]);
    return std::ranges::binary_search(items, at, {}, &SortItem::renderable);
}

bool isVisible(scene::Renderables const& renderables, Deformation const& deformation,
               std::span<const VisibleItems> views) {
    if (!deformation.renderable) return false;
    const uint32_t at = renderables.index.at(deformation.renderable);
    return std::ranges::any_of(views, [&](VisibleItems const& view) {
        // Any level of detail may be the one that is drawn, and all of them have the same bones and weights.
        uint32_t level = renderables.drawable[at];
        const auto isDrawn = [&] { return view.isSeen(drawOf(level, false)) || view.isSeen(drawOf(level, true)); };
        while (level != scene::kNoLevel && !isDrawn()) level = renderables.drawables.level(level).coarser;
        return level != scene::kNoLevel && isSeen(view, at); // others may share the draw
    });
}

/// The blocks of uniforms: one of a kind. A few kinds are remembered; more only repeat blocks.
class KindBlocks {
public:
    /// Where the block of this kind is; kNowhere: the caller places it at `next`.
    uint32_t find(scene::DeformationKind const& kind, uint32_t next) {
        Entry& entry = mEntries[hashWords(kind.skin, kind.targets.bits) % mEntries.size()];
        if (entry.offset != kNowhere && entry.kind == kind) return entry.offset;
        entry = { kind, next };
        return kNowhere;
    }

private:
    struct Entry {
        scene::DeformationKind kind{};
        uint32_t offset = kNowhere;
    };
    std::array<Entry, 64> mEntries{};
};

uint32_t countActive(std::span<const float> weights) {
    return static_cast<uint32_t>(std::ranges::count_if(weights, [](float weight) { return weight != 0; }));
}

/// Room for the record of these weights.
uint32_t recordBones(std::span<const float> weights) {
    return (1 + countActive(weights) + kTexelsOfBone - 1) / kTexelsOfBone;
}

/// Without room for all of it, it has no weights, and without room for that it is not there.
void writeRecord(std::span<shader::BoneData> bones, PosePlace const& place, std::span<const float> weights) {
    if (place.begin >= bones.size()) return;
    const uint32_t needed = recordBones(weights);
    const bool fits = needed <= bones.size() - place.begin;
    const std::span record = bones.subspan(place.begin, fits ? needed : 1);
    // What is not written below is uploaded, too, and the memory has bytes of earlier frames.
    std::ranges::fill(record, shader::BoneData{});
    static_assert(sizeof(shader::BoneData) == kTexelsOfBone * sizeof(float4));
    const std::span texels(&record[0].row0, record.size() * kTexelsOfBone);
    texels[0] = float4(fits ? countActive(weights) : 0, place.bones, 0, 0);
    if (!fits) return;
    size_t next = 1;
    for (size_t target = 0; target < weights.size(); ++target)
        if (weights[target] != 0) texels[next++] = float4(weights[target], target, 0, 0);
}

shader::DeformationUniforms uniformsOf(Deformation const& deformation, uint32_t bones, uint32_t boneRoom) {
    shader::DeformationUniforms uniforms{ .shape = float4(0), .bones = { 0, 0, boneRoom, 0 } };
    if (deformation.skin && bones <= boneRoom) {
        uniforms.bones.x = boneRoom - bones;
        uniforms.bones.y = bones - 1;
        uniforms.shape.w = deformation.jointSets;
    }
    if (scene::MorphTargets const* const morph = deformation.morph) {
        uniforms.shape.y = static_cast<float>(morph->texels);
        uniforms.shape.z = static_cast<float>(morph->vertexCount);
    }
    return uniforms;
}

} // namespace

uint32_t takeBones(DeformationList& list, size_t count) {
    return std::exchange(list.boneCount, list.boneCount + static_cast<uint32_t>(count));
}

uint32_t placePose(DeformationList& list, uint32_t bones, Deformation const& deformation,
                   std::span<const float> weights) {
    return deformation.morph ? takeBones(list, recordBones(weights)) : bones;
}

uint64_t hashWeights(Deformation const& deformation, uint64_t seed) {
    seed = hashWords(seed, deformation.jointSets, deformation.skin.bits);
    return hashBytes(std::as_bytes(std::span(deformation.weights)), seed);
}

DeformationList placeDeformations(Arena& arena, scene::SceneData const& scene, std::span<const VisibleItems> views) {
    DeformationList list;
    if (scene.deformations.empty()) return list;
    const std::span<const Deformation> all = scene.deformations.all();
    const std::span<const scene::SkinRecord> skins = scene.deformations.skins();
    list.deformations = all;
    list.skins = skins;
    const auto places = arena.arrayForOverwrite<DeformationPlace>(all.size());
    const auto bones = arena.arrayForOverwrite<uint32_t>(skins.size());
    std::ranges::fill(bones, kNowhere);
    KindBlocks blocks;
    for (size_t i = 0; i < all.size(); ++i) {
        const auto slot = static_cast<uint32_t>(i);
        places[i] = {};
        if (!isVisible(scene.renderables, all[i], views)) continue;
        DeformationPlace& place = places[i];
        if (all[i].skin) {
            uint32_t& first = bones[all[i].skin.index()];
            // Several meshes may have one skin: its bones are placed with the first of them.
            if (first == kNowhere) first = takeBones(list, skins[all[i].skin.index()].bones.size());
            place.now.bones = first;
        }
        place.now.begin = placePose(list, place.now.bones, all[i], all[i].weights);
        const uint32_t shared = blocks.find(scene.deformations.kindOf(slot), list.bytes);
        place.ownsBlock = shared == kNowhere;
        place.block = place.ownsBlock ? std::exchange(list.bytes, list.bytes + kAlignment) : shared;
        if (all[i].morph) place.deltas = all[i].morph->deltas;
    }
    list.places = places;
    list.bones = bones;
    return list;
}

void writeBones(jobs::JobSystem& jobs, DeformationList const& list, std::span<shader::BoneData> bones) {
    const auto put = [&](uint32_t first, std::span<const shader::BoneData> from) {
        if (first != kNowhere && first + from.size() <= bones.size())
            std::ranges::copy(from, bones.subspan(first).begin());
    };
    jobs::parallelFor<"bones">(jobs, list.bones.size(), kBlocksPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) put(list.bones[i], list.skins[i].bones);
    });
    jobs::parallelFor<"last bones">(jobs, list.last.size(), kBlocksPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            if (list.places[i].ownsLastBones) put(list.places[i].last.bones, list.last[i].bones);
    });
    jobs::parallelFor<"morph weights">(jobs, list.places.size(), kBlocksPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            DeformationPlace const& place = list.places[i];
            if (!list.deformations[i].morph || place.now.begin == kNowhere) continue;
            writeRecord(bones, place.now, list.deformations[i].weights);
            if (place.last.begin != kNowhere) writeRecord(bones, place.last, list.last[i].weights);
        }
    });
}

void writeDeformations(DeformationList const& list, uint32_t boneRoom, std::span<std::byte> memory) {
    FILAMENT_ASSERT(memory.size() == list.bytes, "writeDeformations: the memory has the size that the list says");
    // The memory is that of an upload, with bytes of earlier frames, and all of it is uploaded.
    std::ranges::fill(memory, std::byte{});
    for (size_t i = 0; i < list.places.size(); ++i) {
        if (!list.places[i].ownsBlock) continue;
        Deformation const& deformation = list.deformations[i];
        const size_t bones = deformation.skin ? list.skins[deformation.skin.index()].bones.size() : 0;
        const shader::DeformationUniforms uniforms = uniformsOf(deformation, static_cast<uint32_t>(bones), boneRoom);
        std::memcpy(&memory[list.places[i].block], &uniforms, sizeof uniforms);
    }
}

} // namespace filament_core::prepare
