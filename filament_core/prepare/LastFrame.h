// SPDX-License-Identifier: Apache-2.0
/// LastFrame: what a frame leaves to the next one of the same renderer: how it was seen, and where everything was.
/// Temporal effects find by it where the previous frame shows a point of this one.
///   In      the scene and the main view of a frame, once it is drawn.
///   Limits  of one scene and one view, by the size of what it shows: beside others, frames know none before them
///           (isFollowedBy(), which prepareFrame() asks first).
///           Parameters of materials are not remembered: a vertex block that the app moves by one shows no motion.
///   Memory  places only if asked for: 72 B for each renderable that moved or was added lately (in the last two passes
///           of scene::RestingBlocks), a quarter of a byte for others, 48 B a bone, 4 B a morph target; levels of
///           detail likewise, 12 B a renderable; kept and reused. Where others rested until they moved, the scene
///           knows (scene::RestPlaces): a renderer that did not draw it in two passes finds no places.
///   Thread  the app thread between frames; read-only while a frame is prepared.
///   Fails   std::bad_alloc; there was no last frame then.
#pragma once

#include "filament_core/prepare/ChooseLevels.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewConstants.h"
#include "filament_core/scene/SceneData.h"

#include <optional>
#include <span>
#include <vector>

namespace filament_core::prepare {

class LastFrame {
public:
    /// `view`: without jitter. What the next frame may ask for decides what is kept.
    void keep(scene::SceneData const& scene, ViewInput const& view, FramePacket const& packet);
    void forget() { *this = {}; }

    /// Whether such a frame continues with what the last one left: it shows the same scene in the same size.
    bool isFollowedBy(scene::SceneData const& scene, FrameSettings const& settings) const;

    /// As this frame sees the last one; itself, if there was none.
    LastView seenFrom(ViewSpace const& space, ViewInput const& view, float4 const& time) const;
    /// Of a frame that is accumulated: another place in the pixels for each.
    float2 jitterPixels(scene::SceneData const& scene, FrameSettings const& settings) const;
    /// The mean of all frames since something changed.
    Accumulation accumulation(scene::SceneData const& scene, ViewInput const& view, FramePacket const& packet) const;
    /// Of the light in volumetric fog.
    FogAccumulation fogAccumulation(scene::SceneData const& scene, ViewInput const& view,
                                    FrameSettings const& settings) const;

    /// The levels of detail that it drew; none if they were not asked for.
    std::span<const DrawnLevel> levels() const { return mLevels; }
    /// Whether the renderable at position `at` was in the last frame's scene, and its place there.
    scene::Placement const* placement(scene::SceneData const& scene, uint32_t at) const;
    size_t keptPlaces() const { return mPlacements.size(); }
    /// Of a slot of Deformations; none: it was not there, or had another skin.
    std::optional<LastDeformation> deformation(scene::SceneData const& scene, uint32_t slot) const;

private:
    struct Seen {
        ViewInput view;
        FrameSettings settings;
        uint64_t scene; ///< SceneData::serial
        float4x4 clipFromWorld;
        double3 cameraWorld;
        float3 forward;
        float4 time;
    };
    struct Recent {
        uint64_t bits = 0;  ///< bit i: the place of position 64 * index + i is kept
        uint32_t first = 0; ///< into mPlacements
    };
    struct Deformed {
        Renderable renderable{};
        Skin skin{};
        std::vector<float> weights{};
    };

    void keepPlaces(scene::SceneData const& scene);
    void keepPlacements(scene::Renderables const& renderables);
    bool isAccumulatedBy(scene::SceneData const& scene, FrameSettings const& settings) const;
    bool isFixed(ViewInput const& view, FramePacket const& packet) const;
    bool hasFogOf(scene::SceneData const& scene, FrameSettings const& settings) const;

    std::optional<Seen> mSeen;
    uint32_t mJitters = 0;                             ///< frames in a row that were accumulated
    float mAccumulated = 0;                            ///< accumulated frames
    uint32_t mFogFrames = 0;                           ///< frames in a row whose fog was accumulated
    bool mIsExposed = false;                           ///< by AutoExposure
    bool mIsReflected = false;                         ///< its scene colour was kept for reflections
    std::vector<DrawnLevel> mLevels;                   // by position
    uint64_t mScene = 0;                               ///< SceneData::serial; 0: no places are known
    uint64_t mPass = 0;                                // of RestingBlocks
    std::vector<Recent> mRecent;                       // by position / 64
    std::vector<Renderable> mRenderables;              // parallel to mPlacements
    std::vector<scene::Placement> mPlacements;         // of what moved lately, by position
    std::vector<Deformed> mDeformed;                   // by slot of Deformations
    std::vector<std::vector<shader::BoneData>> mBones; // by Skin::index()
};

} // namespace filament_core::prepare
