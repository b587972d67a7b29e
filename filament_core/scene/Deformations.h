// SPDX-License-Identifier: Apache-2.0
/// Deformations: vertex deformation of renderables: skins, whose bones follow nodes or are set by the user, and
/// weights of morph targets. A deformed renderable has its own slot here (Renderables::deformation).
///   Bounds  the box at rest, grown by the morph targets according to their weights, then moved by every bone. A vertex
///           is a weighted mean of the positions its bones give it, so it never leaves that box. One box per bone makes
///           it tight.
///   Bones   objectFromNode^-1 * worldFromJoint * jointFromBind in double precision, rounded to float at the end.
///   Thread  the app thread between frames; read-only while a frame is prepared. updateSkin() runs on many threads at
///           once, each with its own skins.
///   Memory  48 bytes per bone and the data described below; slots are reused.
///   Fails   never. Weights that are not finite count as 0, bones that are not finite as a zero transform.
#pragma once

#include "backend/api/Handles.h"
#include "base/math/Box.h"
#include "filament_core/scene/Affine.h"
#include "filament_core/scene/Drawables.h"
#include "filament_core/scene/ObjectHandles.h"
#include "shaders/interface/ShaderInterface.h"

#include <filament_core/Objects.h>

#include <span>
#include <vector>

namespace filament_core::scene {

/// Closed; empty where min > max.
struct MinMax {
    float3 min{ 3e38f }, max{ -3e38f };
    bool empty() const { return min.x > max.x; }
    void add(float3 point) { min = glm::min(min, point), max = glm::max(max, point); }
};

/// The targets of one geometry on the device. See shader::kMorphTextureWidth.
struct MorphTargets {
    backend::TextureHandle deltas;
    uint32_t vertexCount = 0, targetCount = 0;
    uint32_t texels = 1;         ///< per vertex and target
    std::vector<MinMax> reach{}; ///< of each target: range of the position displacements, 0 included
};

struct SkinRecord {
    Node node{};                       ///< object space is its space; none: the world
    std::vector<Node> joints;          ///< empty: the bones are set by hand
    std::vector<Affine> jointFromBind; ///< parallel to joints
    std::vector<shader::BoneData> bones;
    std::vector<uint8_t> mirrors;       ///< parallel to bones: the bone turns front faces into back faces
    std::vector<uint32_t> deformations; ///< slots of the renderables that use it
    bool isStale = false;
};

struct Deformation {
    Renderable renderable{}; ///< none: the slot is free
    Skin skin{};
    uint8_t jointSets = 0; ///< 1 or 2 with a skin
    MorphTargets const* morph = nullptr;
    std::vector<float> weights; ///< of morph->targetCount targets
    MinMax restBounds;
    std::vector<MinMax> boneBounds; ///< by bone, of the vertices that it moves; empty: restBounds for all bones
};

class Deformations {
public:
    explicit Deformations(uint16_t owner = 0) : mSkinHandles(owner) {}

    Skin addSkin(SkinRecord data);
    void removeSkin(Skin skin);
    SkinRecord& skin(Skin skin) { return mSkins[at(skin)]; }
    SkinRecord const& skin(Skin skin) const { return mSkins[at(skin)]; }
    /// By Skin::index(); free ones have no bones.
    std::span<SkinRecord> skins() { return mSkins; }
    std::span<const SkinRecord> skins() const { return mSkins; }

    /// bind() names the renderable later.
    uint32_t add(Deformation deformation);
    void bind(uint32_t slot, Renderable renderable) { mDeformations[slot].renderable = renderable; }
    void remove(uint32_t slot);
    /// Equal for what can share a draw: the same morph targets, and skins with the same numbers of bones and of sets of
    /// joints. Bones and weights are data of each object.
    DeformationKind kindOf(uint32_t slot) const;
    Deformation& operator[](uint32_t slot) { return mDeformations[slot]; }
    std::span<const Deformation> all() const { return mDeformations; }

    bool hasSkins() const { return mSkinCount > 0; }
    bool empty() const { return mCount == 0; }

    // Which skins must be recomputed: an update of the nodes records the moved ones.

    void beginMoving(size_t nodeSlots);
    /// Many threads at once, each with its own nodes.
    void noteMoved(uint32_t nodeSlot) { mMovedIn[nodeSlot] = mUpdate; }
    bool hasMoved(Node joint) const { return joint.index() < mMovedIn.size() && mMovedIn[joint.index()] == mUpdate; }
    /// Until the end of the update.
    bool isMoving() const { return mIsMoving; }
    void endMoving() { mIsMoving = mHasStale = false; }
    void markStale(Skin skin);
    bool hasStale() const { return mHasStale; }

private:
    uint32_t at(Skin skin) const {
        if (!mSkinHandles.isLive(skin)) mSkinHandles.refuse(skin);
        return skin.index();
    }

    ObjectHandles<SkinObject> mSkinHandles;
    std::vector<SkinRecord> mSkins; // by handle index
    uint32_t mSkinCount = 0;
    std::vector<Deformation> mDeformations;
    std::vector<uint32_t> mFree;
    uint32_t mCount = 0;
    std::vector<uint32_t> mMovedIn; // by node slot: the update that moved it last
    uint32_t mUpdate = 0;
    bool mIsMoving = false, mHasStale = false;
};

/// The rows as floats, and whether the bone mirrors.
shader::BoneData boneFrom(Affine const& objectFromBind);
bool isMirroring(shader::BoneData const& bone);

/// The box of a deformed renderable; `skin`: null without one.
CenteredBox deformedBounds(Deformation const& deformation, SkinRecord const* skin);
/// Whether most of the bones that move its vertices mirror.
bool bonesMirror(Deformation const& deformation, SkinRecord const& skin);

} // namespace filament_core::scene
