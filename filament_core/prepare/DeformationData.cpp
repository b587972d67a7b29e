// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DeformationData.h"

#include <algorithm>
#include <cstring>

namespace filament_core::prepare {
namespace {

using scene::Deformation;

// A uniform offset that every device accepts.
constexpr uint32_t kAlignment = 256;
constexpr size_t kBlocksPerJob = 32;

bool isVisible(scene::Renderables const& renderables, Deformation const& deformation,
               std::span<const VisibleItems> views) {
    if (!deformation.renderable) return false;
    const uint32_t drawable = renderables.drawable[renderables.index.at(deformation.renderable)];
    return std::ranges::any_of(views, [&](VisibleItems const& view) {
        return view.isSeen(drawOf(drawable, false)) || view.isSeen(drawOf(drawable, true));
    });
}

uint32_t activeTargets(std::span<const float> weights) {
    const auto active = weights.size() - static_cast<size_t>(std::ranges::count(weights, 0.0f));
    return static_cast<uint32_t>(std::min<size_t>(active, shader::kMaxMorphTargets));
}

} // namespace

uint32_t deformationBlock(size_t bytes) {
    return static_cast<uint32_t>((bytes + kAlignment - 1) / kAlignment * kAlignment);
}

uint32_t morphBytes(std::span<const float> weights) {
    return static_cast<uint32_t>(sizeof(float4) * (1 + activeTargets(weights)));
}

shader::MorphUniforms morphUniforms(Deformation const& deformation, std::span<const float> weights) {
    shader::MorphUniforms out{};
    const uint32_t count = activeTargets(weights);
    const float sets = deformation.skin ? static_cast<float>(deformation.jointSets) : 0.0f;
    out.shape = float4(static_cast<float>(count), 0, 0, sets);
    if (!deformation.morph) return out;
    out.shape.y = static_cast<float>(deformation.morph->texels);
    out.shape.z = static_cast<float>(deformation.morph->vertexCount);
    for (size_t target = 0, next = 0; next < count; ++target) {
        const float weight = weights[target];
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
                list.bytes += deformationBlock(skins[all[i].skin.index()].bones.size() * sizeof(shader::BoneData));
            }
            places[i].bones = block;
        }
        places[i].weights = list.bytes;
        list.bytes += deformationBlock(morphBytes(all[i].weights));
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
        std::memset(memory.data() + block + bytes, 0, deformationBlock(bytes) - bytes);
    };
    jobs::parallelFor<"bones">(jobs, list.bones.size(), kBlocksPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            std::vector<shader::BoneData> const& bones = list.skins[i].bones;
            if (list.bones[i] != kNowhere) put(list.bones[i], bones.data(), bones.size() * sizeof(shader::BoneData));
        }
    });
    const auto putWeights = [&](uint32_t block, Deformation const& deformation, std::span<const float> weights) {
        const shader::MorphUniforms uniforms = morphUniforms(deformation, weights);
        put(block, &uniforms, morphBytes(weights));
    };
    jobs::parallelFor<"morph weights">(jobs, list.places.size(), kBlocksPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            DeformationPlace const& place = list.places[i];
            Deformation const& now = list.deformations[i];
            if (place.weights != kNowhere) putWeights(place.weights, now, now.weights);
            if (place.lastWeights == kNowhere) continue;
            putWeights(place.lastWeights, now, list.last[i].weights);
            put(place.lastBones, list.last[i].bones.data(), list.last[i].bones.size_bytes());
        }
    });
}

} // namespace filament_core::prepare
