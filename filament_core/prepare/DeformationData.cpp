// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DeformationData.h"

#include "filament_core/prepare/HashWords.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

namespace filament_core::prepare {
namespace {

using scene::Deformation;

// A uniform offset that every device accepts.
constexpr uint32_t kAlignment = 256;
constexpr size_t kBlocksPerJob = 32;
constexpr size_t kHeaderWords = offsetof(shader::DeformationUniforms, targets) / sizeof(float4);

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

/// The blocks of skins, which have no weights: one of a kind. A few kinds are remembered; more only repeat blocks.
class SkinBlocks {
public:
    /// Where the block of this kind is; kNowhere: the caller places it at `next`.
    uint32_t find(uint32_t kind, uint32_t next) {
        Entry& entry = mEntries[kind % mEntries.size()];
        if (entry.offset != kNowhere && entry.kind == kind) return entry.offset;
        entry = { kind, next };
        return kNowhere;
    }

private:
    struct Entry {
        uint32_t kind = 0, offset = kNowhere;
    };
    std::array<Entry, 64> mEntries{};
};

/// The smallest magnitude of a weight that is kept, and how many of exactly this magnitude are.
struct Threshold {
    float magnitude = 0;
    size_t ties = 0;
};

size_t countLarger(std::span<const float> weights, float magnitude) {
    return static_cast<size_t>(
            std::ranges::count_if(weights, [&](float weight) { return std::abs(weight) > magnitude; }));
}

/// Of the kMaxActiveTargets weights of the largest magnitude; bisects the bits of floats, which are in their order.
Threshold thresholdOf(std::span<const float> weights) {
    if (weights.size() <= shader::kMaxActiveTargets || countLarger(weights, 0) <= shader::kMaxActiveTargets) return {};
    uint32_t below = 0, enough = std::bit_cast<uint32_t>(std::numeric_limits<float>::max());
    while (enough - below > 1) {
        const uint32_t middle = below + (enough - below) / 2;
        const bool fits = countLarger(weights, std::bit_cast<float>(middle)) <= shader::kMaxActiveTargets;
        (fits ? enough : below) = middle;
    }
    const auto magnitude = std::bit_cast<float>(enough);
    return { magnitude, shader::kMaxActiveTargets - countLarger(weights, magnitude) };
}

/// Skin and targets of a deformation, now or in the last frame.
struct Shape {
    Deformation const& deformation;
    std::span<const float> weights;
    size_t boneCount;
};

/// The targets whose weight is not 0, in their order; see DeformationUniforms.
uint32_t writeTargets(std::span<const float> weights, std::span<float4> targets) {
    Threshold kept = thresholdOf(weights);
    uint32_t next = 0;
    for (size_t target = 0; target < weights.size(); ++target) {
        const float magnitude = std::abs(weights[target]);
        // Among weights of exactly the smallest magnitude the first ones stay, so that the choice needs no further
        // order.
        const bool isTie = kept.ties > 0 && magnitude == kept.magnitude;
        if (!(magnitude > kept.magnitude) && !isTie) continue;
        kept.ties -= isTie;
        targets[next++] = float4(weights[target], static_cast<float>(target), 0, 0);
    }
    return next;
}

/// Fills `block`, which has the size that deformationBlock() says.
void writeBlock(Shape const& shape, uint32_t boneRoom, std::span<std::byte> block) {
    const std::span words(reinterpret_cast<float4*>(block.data()), block.size() / sizeof(float4));
    // The memory is that of an upload, with bytes of earlier frames. What is not written below is uploaded, too.
    std::memset(block.data(), 0, block.size());
    const uint32_t active = writeTargets(shape.weights, words.subspan(kHeaderWords));
    const bool isSkinned = shape.deformation.skin && shape.boneCount <= boneRoom;
    const glm::uvec4 bones(isSkinned ? boneRoom - shape.boneCount : 0, isSkinned ? shape.boneCount - 1 : 0, 0, 0);
    words[0] = float4(active, 0, 0, isSkinned ? static_cast<float>(shape.deformation.jointSets) : 0.0f);
    if (scene::MorphTargets const* const morph = shape.deformation.morph) {
        words[0].y = static_cast<float>(morph->texels);
        words[0].z = static_cast<float>(morph->vertexCount);
    }
    std::memcpy(&words[1], &bones, sizeof bones);
}

} // namespace

uint32_t deformationBlock(std::span<const float> weights) {
    const size_t active = std::min<size_t>(countLarger(weights, 0), shader::kMaxActiveTargets);
    const size_t bytes = (kHeaderWords + active) * sizeof(float4);
    return static_cast<uint32_t>((bytes + kAlignment - 1) / kAlignment * kAlignment);
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
    SkinBlocks blocks;
    for (size_t i = 0; i < all.size(); ++i) {
        const auto slot = static_cast<uint32_t>(i);
        places[i] = {};
        if (!isVisible(scene.renderables, all[i], views)) continue;
        places[i].bones = 0; // without a skin it is not read
        if (all[i].skin) {
            uint32_t& first = bones[all[i].skin.index()];
            // Several meshes may have one skin: its bones are placed with the first of them.
            if (first == kNowhere) {
                first = list.boneCount;
                list.boneCount += static_cast<uint32_t>(skins[all[i].skin.index()].bones.size());
            }
            places[i].bones = first;
        }
        const uint32_t shared = all[i].morph ? kNowhere : blocks.find(scene.deformations.kindOf(slot), list.bytes);
        places[i].ownsBlock = shared == kNowhere;
        places[i].weights = places[i].ownsBlock ? list.bytes : shared;
        if (places[i].ownsBlock) list.bytes += deformationBlock(all[i].weights);
        if (all[i].morph) places[i].deltas = all[i].morph->deltas;
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
        for (size_t i = begin; i < end; ++i) put(list.places[i].lastBones, list.last[i].bones);
    });
}

void writeDeformations(jobs::JobSystem& jobs, DeformationList const& list, uint32_t boneRoom,
                       std::span<std::byte> memory) {
    FILAMENT_ASSERT(memory.size() == list.bytes, "writeDeformations: the memory has the size that the list says");
    const auto put = [&](uint32_t at, Shape const& shape) {
        writeBlock(shape, boneRoom, memory.subspan(at, deformationBlock(shape.weights)));
    };
    jobs::parallelFor<"morph weights">(jobs, list.places.size(), kBlocksPerJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            DeformationPlace const& place = list.places[i];
            Deformation const& now = list.deformations[i];
            if (!place.ownsBlock) continue;
            const size_t bones = now.skin ? list.skins[now.skin.index()].bones.size() : 0;
            put(place.weights, { now, now.weights, bones });
            if (place.lastWeights != kNowhere && place.lastWeights != place.weights)
                put(place.lastWeights, { now, list.last[i].weights, bones });
        }
    });
}

} // namespace filament_core::prepare
