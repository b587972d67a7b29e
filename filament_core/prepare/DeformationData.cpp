// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DeformationData.h"

#include <algorithm>
#include <cstring>

namespace filament::prepare {
namespace {

using scene::Deformation;

// A uniform offset that every device accepts.
constexpr uint32_t kAlignment = 256;
constexpr size_t kBlocksPerJob = 32;

uint32_t aligned(size_t bytes) { return static_cast<uint32_t>((bytes + kAlignment - 1) / kAlignment * kAlignment); }

bool isVisible(scene::Renderables const& renderables, Deformation const& deformation,
               std::span<const VisibleItems> views) {
    if (!deformation.renderable) return false;
    const uint32_t drawable = renderables.drawable[renderables.index.at(deformation.renderable)];
    return std::ranges::any_of(views, [&](VisibleItems const& view) {
        return view.isSeen(drawOf(drawable, false)) || view.isSeen(drawOf(drawable, true));
    });
}

uint32_t activeTargets(Deformation const& deformation) {
    const auto zeros = std::ranges::count(deformation.weights, 0.0f);
    const auto active = deformation.weights.size() - static_cast<size_t>(zeros);
    return static_cast<uint32_t>(std::min<size_t>(active, shader::kMaxMorphTargets));
}

} // namespace

uint32_t morphBytes(Deformation const& deformation) {
    return static_cast<uint32_t>(sizeof(float4) * (1 + activeTargets(deformation)));
}

shader::MorphUniforms morphUniforms(Deformation const& deformation) {
    shader::MorphUniforms out{};
    const uint32_t count = activeTargets(deformation);
    const float sets = deformation.skin ? static_cast<float>(deformation.jointSets) : 0.0f;
    out.shape = float4(static_cast<float>(count), 0, 0, sets);
    if (!deformation.morph) return out;
    out.shape.y = static_cast<float>(deformation.morph->texels);
    out.shape.z = static_cast<float>(deformation.morph->vertexCount);
    for (size_t target = 0, next = 0; next < count; ++target) {
        const float weight = deformation.weights[target];
        if (weight != 0) out.targets[next++] = float4(weight, static_cast<float>(target), 0, 0);
    }
    return out;
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
    for (size_t i = 0; i < all.size(); ++i) {
        places[i] = {};
        if (!isVisible(scene.renderables, all[i], views)) continue;
        places[i].bones = 0; // without a skin any window will do: it is not read
        if (all[i].skin) {
            uint32_t& block = bones[all[i].skin.index()];
            if (block == kNowhere) {
                block = list.bytes;
                list.bytes += aligned(skins[all[i].skin.index()].bones.size() * sizeof(shader::BoneData));
            }
            places[i].bones = block;
        }
        places[i].weights = list.bytes;
        list.bytes += aligned(morphBytes(all[i]));
        if (all[i].morph) places[i].deltas = all[i].morph->deltas;
    }
    list.places = places;
    list.bones = bones;
    return list;
}

void writeDeformations(jobs::JobSystem& jobs, DeformationList const& list, std::span<std::byte> memory) {
    FILAMENT_ASSERT(memory.size() == list.bytes, "writeDeformations: the memory has the size that the list says");
    const auto put = [&](uint32_t block, void const* data, size_t bytes) {
        std::memcpy(memory.data() + block, data, bytes);
        std::memset(memory.data() + block + bytes, 0, aligned(bytes) - bytes);
    };
    jobs::parallelFor<"bones">(jobs, list.bones.size(), kBlocksPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            std::vector<shader::BoneData> const& bones = list.skins[i].bones;
            if (list.bones[i] != kNowhere) put(list.bones[i], bones.data(), bones.size() * sizeof(shader::BoneData));
        }
    });
    jobs::parallelFor<"morph weights">(jobs, list.places.size(), kBlocksPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            if (list.places[i].weights == kNowhere) continue;
            const shader::MorphUniforms weights = morphUniforms(list.deformations[i]);
            put(list.places[i].weights, &weights, morphBytes(list.deformations[i]));
        }
    });
}

} // namespace filament::prepare
