// SPDX-License-Identifier: Apache-2.0
/// SceneDemand: which effects a frame needs, and why. What is visible decides, not what the scene contains: lights
/// that reach no lit surface of the view are neither uploaded nor part of any shader (PrepareView.cpp applies the same
/// counts to each view). The colour pass draws the sky by it. Every effect has a row in EffectTable.cpp, which says how
/// its demand follows.
///   In      what preparing the frame has found out.   Out: a plain value.
///   Thread  any; pure.   Memory: none; the words of describe() are on the heap.   Fails: never.
#pragma once

#include "filament_core/prepare/DemandReason.h"
#include "filament_core/prepare/FrameSettings.h"
#include "filament_core/prepare/ShadowCounts.h"
#include "filament_core/prepare/ViewCounts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace filament_core::prepare {

enum class Effect : uint8_t {
    Sun,            ///< the brightest
    LightList,      ///< points, spots, areas and all other suns
    AreaLights,     ///< those of the list that are rectangles, discs or tubes
    LightProfiles,  ///< those of the list whose light a file distributes
    LightImages,    ///< those that project or show an image; the brightest sun may be one
    Shadows,        ///< of suns, points, spots and areas
    ColoredShadows, ///< of what transmits light
    AreaShadows,    ///< of the shape of areas, not of their centre
    IndirectLight,
    ReflectionProbes, ///< boxes of light, in place of the environment
    IrradianceGrids,  ///< diffuse light by the place of renderables, in place of the environment's
    Sky,
    SunDisc, ///< discs of suns, and their halos
    Blending,
    Transparency, ///< order-independent
    Splats,       ///< 3D Gaussians
    Deformation,
    Stencil,      ///< stencil values beside the depths
    DepthPrepass, ///< of opaque objects, before anything is shaded
    AmbientOcclusion,
    Refraction,  ///< of the scene colour
    Reflections, ///< of the scene colour
    Motion,      ///< motion vectors of dynamic objects, for temporal effects
    ContactShadows,
    Fog,
    VolumetricFog, ///< light of lamps and of the shadowed sun in it
    Taa,           ///< temporal anti-aliasing
    DepthOfField,
    MotionBlur,
    AutoExposure,
    Bloom,
    ChromaticAberration,
    Vignette,
    ColorGrading,
    Grain,
    Fxaa,
    Upscaling, ///< by a filter, or by temporal accumulation
    Sharpening,
    LensFlare,
    MsaaResolve, ///< by what is displayed
    Sraa,        ///< subpixel reconstruction of edges, from depths
    MipBias,     ///< of materials' textures
    GuardBand,   ///< pixels around the image
    DebugView,   ///< instead of the image
    Count,       ///< no effect: how many there are
};
inline constexpr size_t kEffects = static_cast<size_t>(Effect::Count);

struct EffectDemand {
    bool isNeeded = false;
    DemandReason reason = DemandReason::NotInScene;
    uint32_t count = 0, others = 0; ///< see DemandReason
    uint32_t leftOut = 0;           ///< needed as well, but beyond a limit
    friend bool operator==(EffectDemand const&, EffectDemand const&) = default;
};

struct SceneDemand {
    std::array<EffectDemand, kEffects> effects{};

    EffectDemand const& of(Effect effect) const { return effects[static_cast<size_t>(effect)]; }
    bool needs(Effect effect) const { return of(effect).isNeeded; }
    /// Whether an effect takes the image of the colour pass and makes another one of it.
    bool changesColor() const;
    friend bool operator==(SceneDemand const&, SceneDemand const&) = default;
};

/// Reflection probes or irradiance grids; those that are left out are in view.
struct ProbeCounts {
    uint32_t inScene = 0, used = 0, outOfReach = 0, leftOut = 0;
};

/// What findDemand() reads of a frame.
struct DemandInput {
    ViewCounts counts; ///< of the main view
    ShadowCounts shadows{};
    bool hasIndirectLight = false, hasSky = false;
    uint32_t deformed = 0;     ///< objects in view that skins or morph targets move
    uint32_t copiedPixels = 0; ///< of the scene colour, for refractive objects
    uint32_t moved = 0;        ///< opaque objects in view that do not stay where they are
    bool cameraMoved = false;
    float blurRadius = 0; ///< in pixels: the largest of what is visible, of the lens
    FrameSettings settings{};
    uint32_t cascades = 0, atlasSize = 0;         ///< of the shadows
    uint32_t discsInView = 0, discsOutOfView = 0; ///< of suns that show theirs
    uint32_t splats = 0, splatClouds = 0;         ///< in view; in the scene
    ProbeCounts probes{}, grids{};
};

SceneDemand findDemand(DemandInput const& input);

/// Whether so many objects need an order.
constexpr bool overlaps(uint32_t objects) { return objects > 1; }

/// "light list". One name in explain(), reports and documents.
const char* nameOf(Effect effect);
/// The reason in words: "3 of 8 reach the view".
std::string describe(Effect effect, EffectDemand const& demand);

} // namespace filament_core::prepare
