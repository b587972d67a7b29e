// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/Deformations.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace filament_core::scene {
namespace {

constexpr float kEverywhere = 1e30f; // metres; leaves room for a node's transform

// Arvo 1990, "Transforming axis-aligned bounding boxes", Graphics Gems; by rows.
void addMoved(MinMax& bounds, MinMax const& box, shader::BoneData const& bone) {
    const float3 center = (box.min + box.max) * 0.5f, half = (box.max - box.min) * 0.5f;
    const std::array<float4, 3> rows{ bone.row0, bone.row1, bone.row2 };
    float3 moved, reach;
    for (int axis = 0; axis < 3; ++axis) {
        const float4 row = rows[static_cast<size_t>(axis)];
        moved[axis] = glm::dot(float3(row), center) + row.w;
        reach[axis] = glm::dot(glm::abs(float3(row)), half);
    }
    bounds.min = glm::min(bounds.min, moved - reach); // the reach is not negative: neither corner moves the other side
    bounds.max = glm::max(bounds.max, moved + reach);
}

/// The largest displacement of any vertex by the weighted targets.
MinMax morphReach(Deformation const& deformation) {
    MinMax reach{ float3(0.0f), float3(0.0f) };
    for (size_t i = 0; i < deformation.weights.size(); ++i) {
        MinMax const& target = deformation.morph->reach[i];
        const float weight = deformation.weights[i];
        const float3 a = target.min * weight, b = target.max * weight;
        reach.min += glm::min(a, b);
        reach.max += glm::max(a, b);
    }
    return reach;
}

bool isFinite(MinMax const& box) {
    const float3 zero = (box.min - box.min) + (box.max - box.max);
    return zero == float3(0.0f);
}

} // namespace

Skin Deformations::addSkin(SkinRecord data) {
    const Skin skin = mSkinHandles.allocate();
    if (skin.index() >= mSkins.size()) mSkins.resize(skin.index() + 1);
    data.isStale = true;
    mHasStale = true;
    mSkins[skin.index()] = std::move(data);
    ++mSkinCount;
    return skin;
}

void Deformations::removeSkin(Skin skin) {
    FILAMENT_ASSERT(mSkins[at(skin)].deformations.empty(), "a skin is removed after the renderables that it moves");
    mSkins[skin.index()] = {};
    mSkinHandles.free(skin);
    --mSkinCount;
}

uint32_t Deformations::add(Deformation deformation) {
    if (mFree.empty()) {
        // Room for all slots, so that remove() never needs memory.
        mFree.reserve(mDeformations.size() + 1);
        mDeformations.emplace_back();
        mFree.push_back(static_cast<uint32_t>(mDeformations.size() - 1));
    }
    const uint32_t slot = mFree.back();
    // The last step that may run out of memory; only after it does the slot leave the free list.
    if (deformation.skin) skin(deformation.skin).deformations.push_back(slot);
    mFree.pop_back();
    mDeformations[slot] = std::move(deformation);
    ++mCount;
    return slot;
}

void Deformations::remove(uint32_t slot) {
    if (const Skin of = mDeformations[slot].skin) std::erase(skin(of).deformations, slot);
    mDeformations[slot] = {};
    mFree.push_back(slot);
    --mCount;
}

DeformationKind Deformations::kindOf(uint32_t slot) const {
    constexpr uint32_t kDeformed = 1u << 31, kTwoSets = 1u << 30;
    Deformation const& deformation = mDeformations[slot];
    const size_t bones = deformation.skin ? skin(deformation.skin).bones.size() : 0;
    FILAMENT_ASSERT(bones < kTwoSets, "a skin has fewer than 2^30 bones");
    return { kDeformed | (deformation.jointSets > 1 ? kTwoSets : 0) | static_cast<uint32_t>(bones),
             deformation.morph ? deformation.morph->deltas : backend::TextureHandle{} };
}

void Deformations::beginMoving(size_t nodeSlots) {
    if (mMovedIn.size() < nodeSlots) mMovedIn.resize(nodeSlots, 0);
    ++mUpdate;
    mIsMoving = true;
}

void Deformations::markStale(Skin of) {
    skin(of).isStale = true;
    mHasStale = true;
}

shader::BoneData boneFrom(Affine const& objectFromBind) {
    const auto row = [&](size_t i) {
        return float4(float3(objectFromBind.linearRow(i)),
                      static_cast<float>(objectFromBind.translation()[static_cast<int>(i)]));
    };
    shader::BoneData bone{ row(0), row(1), row(2) };
    // A value that does not fit into a float is no longer finite.
    const float4 zero = (bone.row0 - bone.row0) + (bone.row1 - bone.row1) + (bone.row2 - bone.row2);
    return zero == float4(0.0f) ? bone : shader::BoneData{};
}

bool isMirroring(shader::BoneData const& bone) {
    const double3 x(bone.row0), y(bone.row1), z(bone.row2);
    return glm::dot(x, glm::cross(y, z)) < 0;
}

CenteredBox deformedBounds(Deformation const& deformation, SkinRecord const* skin) {
    const MinMax reach = morphReach(deformation);
    const auto grown = [&](MinMax const& box) { return MinMax{ box.min + reach.min, box.max + reach.max }; };
    MinMax bounds = grown(deformation.restBounds);
    if (skin) {
        MinMax moved;
        const MinMax whole = bounds;
        for (size_t i = 0; i < skin->bones.size(); ++i) {
            const bool isKnown = i < deformation.boneBounds.size();
            if (isKnown && deformation.boneBounds[i].empty()) continue;
            if (!isKnown && !deformation.boneBounds.empty()) continue;
            addMoved(moved, isKnown ? grown(deformation.boneBounds[i]) : whole, skin->bones[i]);
        }
        if (!moved.empty()) bounds = moved;
    }
    // Bounds that overflow become infinite in effect. Rounding must not shrink half extents.
    if (!isFinite(bounds)) return { float3(0.0f), float3(kEverywhere) };
    CenteredBox box = boxFromMinMax(bounds.min, bounds.max);
    box.halfExtent *= 1.000001f;
    return box;
}

bool bonesMirror(Deformation const& deformation, SkinRecord const& skin) {
    size_t used = 0, mirroring = 0;
    for (size_t i = 0; i < skin.bones.size(); ++i) {
        const bool isUsed = deformation.boneBounds.empty() ||
                            (i < deformation.boneBounds.size() && !deformation.boneBounds[i].empty());
        used += isUsed;
        mirroring += isUsed && skin.mirrors[i];
    }
    return mirroring * 2 > used;
}

} // namespace filament_core::scene
