// SPDX-License-Identifier: Apache-2.0
/// Deformations: what moves the vertices of renderables: skins, whose bones follow nodes or are given, and weights of
/// morph targets. A deformed renderable has a slot of its own here, and its drawable names the slot.
///   Bounds  of a deformed renderable: its box at rest, grown by the morph targets as far as their weights reach, moved
///           by every bone. A vertex is a mean of where its bones put it, so it never leaves that box; boxes a bone
///           make it tight.
///   Bones   objectFromNode^-1 * worldFromJoint * jointFromBind, in double, rounded to float at the end.
///   Thread  the app thread between frames; read-only while a frame is prepared. updateSkin() runs on many threads at
///           once, each with skins of its own.
///   Memory  48 bytes a bone and what is described below; slots are reused.
///   Fails   never. Weights that are not finite count as 0, bones that are not finite as zero.
#pragma once

#include "backend/api/Handles.h"
#include "base/Handle.h"
#include "base/math/Box.h"
#include "filament_core/scene/Affine.h"
#include "filament_core/scene/Drawables.h"
#include "shaders/interface/ShaderInterface.h"

#include <filament/Objects.h>

#include <span>
#include <vector>

namespace filament::scene {

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
    uint32_t texels = 1;         ///< a vertex and target
    std::vector<MinMax> reach{}; ///< of each target: of the differences of positions, 0 included
};

struct SkinData {
    Node node{};                       ///< object space is its space; none: the world
    std::vector<Node> joints;          ///< empty: the bones are set by hand
    std::vector<Affine> jointFromBind; ///< parallel to joints
    std::vector<shader::BoneData> bones;
    std::vector<uint8_t> mirrors;       ///< parallel to bones: turns front faces into back faces
    std::vector<uint32_t> deformations; ///< slots of those who use it
    bool isStale = false;
};

struct Deformation {
    Renderable renderable{}; ///< none: the slot is free
    Skin skin{};
    uint8_t jointSets = 0; ///< 1 or 2 with a skin
    MorphTargets const* morph = nullptr;
    std::vector<float> weights; ///< of morph->targetCount targets
    MinMax restBounds;
    std::vector<MinMax> boneBounds; ///< by bone, of the vertices that it moves; empty: restBounds for all
};

class Deformations {
public:
    Skin addSkin(SkinData data);
    void removeSkin(Skin skin);
    SkinData& skin(Skin skin) { return mSkins[at(skin)]; }
    SkinData const& skin(Skin skin) const { return mSkins[at(skin)]; }
    /// By Skin::index(); free ones have no bones.
    std::span<SkinData> skins() { return mSkins; }
    std::span<const SkinData> skins() const { return mSkins; }

    /// The renderable is named later, by bind().
    uint32_t add(Deformation deformation);
    void bind(uint32_t slot, Renderable renderable) { mDeformations[slot].renderable = renderable; }
    void remove(uint32_t slot);
    Deformation& operator[](uint32_t slot) { return mDeformations[slot]; }
    std::span<const Deformation> all() const { return mDeformations; }

    bool hasSkins() const { return mSkinCount > 0; }
    bool empty() const { return mCount == 0; }

    // Which skins have to be computed again: an update of the nodes notes what it moved.

    void beginMoving(size_t nodeSlots);
    /// Many threads at once, each with nodes of its own.
    void noteMoved(uint32_t nodeSlot) { mMovedIn[nodeSlot] = mUpdate; }
    bool hasMoved(Node joint) const { return joint.index() < mMovedIn.size() && mMovedIn[joint.index()] == mUpdate; }
    /// Until the end of the update.
    bool isMoving() const { return mIsMoving; }
    void endMoving() { mIsMoving = mHasStale = false; }
    void markStale(Skin skin);
    bool hasStale() const { return mHasStale; }

private:
    uint32_t at(Skin skin) const {
        FILAMENT_ASSERT(mSkinHandles.isLive(skin), "the handle names a skin that was removed or never added");
        return skin.index();
    }

    HandleAllocator<SkinObject> mSkinHandles;
    std::vector<SkinData> mSkins; // by handle index
    uint32_t mSkinCount = 0;
    std::vector<Deformation> mDeformations;
    std::vector<uint32_t> mFree;
    uint32_t mCount = 0;
    std::vector<uint32_t> mMovedIn; // by node slot: the update that moved it last
    uint32_t mUpdate = 0;
    bool mIsMoving = false, mHasStale = false;
};

/// Rows of floats, and whether they mirror.
shader::BoneData boneFrom(Affine const& objectFromBind);
bool isMirroring(shader::BoneData const& bone);

/// The box of a deformed renderable; `skin`: null without one.
CenteredBox deformedBounds(Deformation const& deformation, SkinData const* skin);
/// Whether most of the bones that move its vertices mirror.
bool bonesMirror(Deformation const& deformation, SkinData const& skin);

} // namespace filament::scene
