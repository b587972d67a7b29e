// SPDX-License-Identifier: Apache-2.0
/// LevelChoice: which level of detail a view draws of each renderable.
///   In      the levels of drawables (scene::Drawables) with their errors in metres; a view and the most pixels that an
///           error may take there; which levels the last frame drew.
///   Rule    the coarsest level whose error is within the limit, wherever in the box of the renderable and however it
///           points. A level coarser than the last frame's must be within kSteady of the limit: a camera that trembles
///           does not switch levels. One that is too coarse is replaced at once.
///   Pixels  an error e at z metres in front of a perspective camera takes at most e f sqrt(1 + r^2) / z of them: f is
///           the focal length in pixels, r the tangent of the angle between the corner of the image and its axis. The
///           root is the largest factor by which a lens stretches what is beside its axis. Parallel projections: e f.
///   Scale   errors grow with the largest scale of the transform, and of the bones.
///   Fade    where frames are accumulated, a level that was drawn vanishes over kFadeFrames frames while the one chosen
///           instead appears: each pixel shows one of them, by a pattern (level_fade.mat). The choice stays until then.
///           Opaque surfaces whose material leaves their shape alone fade.
///   Shadows a map draws no finer level than the main view: surfaces below those of the map would shadow themselves.
///   Thread  read-only, any.   Memory: none.   Fails: never.
#pragma once

#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewConstants.h"
#include "filament_core/scene/SceneData.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace filament_core::prepare {

/// The level that a frame drew of the renderable at a position of the scene: 0 is the finest.
struct DrawnLevel {
    Renderable renderable{}; ///< none: it was not drawn
    uint16_t level = 0;      ///< that was chosen
    uint16_t vanishing = 0;  ///< the level that fades into it
    uint8_t fade = 0;        ///< frames that this has lasted, below kFadeFrames; 0: none fades

    bool isFading() const { return fade > 0 && vanishing != level; }
    uint32_t coarsest() const { return isFading() ? std::max(level, vanishing) : level; }
};

/// One for each renderable of the scene: writes what the view draws, and leaves the others.
void writeDrawnLevels(scene::SceneData const& scene, ViewPacket const& view, std::span<DrawnLevel> levels);

class LevelChoice {
public:
    static constexpr float kSteady = 0.75f;

    LevelChoice() = default; ///< always the finest
    /// `last`: by position; renderables beyond it, or of other handles, were not drawn.
    LevelChoice(scene::SceneData const& scene, ViewInput const& view, std::span<const DrawnLevel> last = {},
                bool fades = false);
    /// Of a shadow map. `main`: what the main view draws.
    static LevelChoice ofShadowMap(scene::SceneData const& scene, ViewInput const& map,
                                   std::span<const DrawnLevel> main);

    bool isOn() const { return mPixels > 0; }
    /// The drawable of the level to draw of the renderable at position `at`, which has the drawable `finest`.
    /// `center`: of its box, relative to the camera.
    uint32_t choose(uint32_t at, uint32_t finest, float3 center, float3 halfExtent) const;

    /// A level that is drawn besides the one that was chosen.
    struct Vanishing {
        uint32_t drawable = scene::kNoLevel; ///< none
        LevelFade fade = 0;                  ///< of the chosen level, > 0
    };
    /// `chosen`: by choose().
    Vanishing vanishing(uint32_t at, uint32_t finest, uint32_t chosen) const;

private:
    float pixelsPerMeter(float3 center, float3 halfExtent) const;
    float scaleOf(uint32_t at) const;

    scene::SceneData const* mScene = nullptr;
    std::span<const DrawnLevel> mLast, mFinest;
    float3 mForward{ 0 };
    float mPixels = 0;   ///< 0: off
    float mPerMeter = 0; ///< pixels of a metre at a distance of 1 m
    bool mIsParallel = false, mFades = false;
};

/// The largest factor by which a linear map stretches a vector, or somewhat more: exact if its columns are
/// perpendicular. By the largest sum of a row of the product with its transpose (Gershgorin 1931).
float largestStretch(float3 row0, float3 row1, float3 row2);

/// How many levels coarser than `finest` the drawable is, which is one of its levels.
uint32_t levelOf(scene::Drawables const& drawables, uint32_t finest, uint32_t drawable);

} // namespace filament_core::prepare
