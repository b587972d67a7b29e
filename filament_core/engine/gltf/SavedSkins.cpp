// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/gltf/SaveContext.h"
#include "shaders/interface/ShaderInterface.h"

#include <set>

namespace filament_core::engine {

using assets::kNone;

void SavedSkins::finish() {
    std::map<uint32_t, uint32_t> known; // by Skin::index(), into GltfMerge::skins
    for (Use const& use : mUses) {
        const auto next = static_cast<uint32_t>(mContext.merge.skins.size());
        const auto [entry, isNew] = known.try_emplace(use.skin.index(), next);
        if (isNew) {
            assets::GltfMergeSkin skin = skinOf(mContext.scene.data.deformations.skin(use.skin), use.parent);
            mContext.merge.skins.push_back(std::move(skin));
        }
        mContext.merge.nodes[use.node].skin = entry->second;
    }
}

/// A bone that follows no node, because the program sets it or its joint was removed, becomes a joint at the place of
/// the mesh, with the bone as its matrix.
assets::GltfMergeSkin SavedSkins::skinOf(scene::SkinRecord const& record, uint32_t parent) {
    assets::GltfMergeSkin skin;
    std::set<uint32_t> used; // glTF names each joint once
    for (size_t i = 0; i < record.bones.size(); ++i) {
        const bool follows = i < record.joints.size() && mContext.scene.data.transforms.isAlive(record.joints[i]);
        const Place place = follows ? mWritten[record.joints[i].index()] : Place{ parent, false };
        const bool isFree = place.isItself && used.insert(place.written).second;
        skin.joints.push_back(isFree ? place.written : addBone(i, place.written));
        shader::BoneData const& bone = record.bones[i];
        skin.jointFromBind.push_back(
                follows ? float4x4(scene::matrixFrom(record.jointFromBind[i]))
                        : glm::transpose(float4x4(bone.row0, bone.row1, bone.row2, float4(0, 0, 0, 1))));
    }
    return skin;
}

/// At the place of what is above it.
uint32_t SavedSkins::addBone(size_t number, uint32_t parent) {
    std::vector<assets::GltfMergeNode>& nodes = mContext.merge.nodes;
    const auto index = static_cast<uint32_t>(nodes.size());
    nodes.push_back({ .name = fmt::format("bone {}", number) });
    (parent == kNone ? mContext.merge.roots : nodes[parent].children).push_back(index);
    return index;
}

} // namespace filament_core::engine
