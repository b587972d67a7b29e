// SPDX-License-Identifier: Apache-2.0
/// DemandReason: why a frame needs an effect, or why it does not, with the words for it.
///   Thread  any; constant data.   Memory: none.   Fails: never.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace filament_core::prepare {

/// `count`, `others`, `leftOut`: of EffectDemand.
enum class DemandReason : uint8_t {
    // The effect is needed:
    LightsVisible,       ///< `count` lights shine on lit surfaces in view; `others` do not
    OnlyLight,           ///< the only one in the scene does
    BrightestSun,        ///< of `count`
    ProfilesOverBudget,  ///< `count` lights do; the profiles of `leftOut` others exceed a limit
    ImagesOverBudget,    ///< `count` lights do; the images of `leftOut` others exceed a limit
    EnvironmentLights,   ///< the environment lights surfaces in view
    ProbesInView,        ///< `count` boxes reach lit surfaces, `others` do not; `leftOut` do and are not used
    InView,              ///< `count` draws are in view
    BackgroundVisible,   ///< a sky is there
    ShadowsVisible,      ///< `count` maps are read; `others` of them are drawn in this frame; `leftOut` do not fit
    ShadowsColored,      ///< in `count` maps something transmits light, in `others` nothing does
    ShadowsOfShapes,     ///< `count` maps are read in the shape of their light, `others` are not
    DiscsInView,         ///< `count` discs or halos of suns are in view, `others` are not
    DepthRead,           ///< by `count` effects
    PrepassEnabled,      ///< by Quality
    OccludesIndirect,    ///< light on `count` lit draws
    SamplesSceneColor,   ///< `count` draws do; `others` pixels of it are copied
    RequestedByLights,   ///< by `count` of them
    FogLights,           ///< fog is lit by `count` lights of the list, and shadows of `others` cascades lie in it
    FogVaries,           ///< the density of fog varies from place to place
    FogWeakensSun,       ///< fog weakens the sun's light on its way
    CameraInFog,         ///< fog lies between the camera and what is visible
    ObjectsMove,         ///< `count` opaque objects in view do
    CameraMoves,         ///< and nothing else
    ScattersLight,       ///< of what is visible
    ScattersLightByDirt, ///< and dirt on the lens does, too
    LensGhosts,          ///< `count` of them
    LensHalo,            ///< one
    LensGhostsAndHalo,   ///< `count` ghosts, and a halo
    SmoothsEdges,        ///< of what is visible
    ChangesImage,        ///< as a whole
    OutOfFocus,          ///< something visible is, by `count` pixels at most
    MeasuresLuminance,   ///< of the image
    UpscalesImage,       ///< of `count` by `others` pixels
    MayOverlap,          ///< `count` transparent objects do; `others`: layers that are peeled, 0: none are
    ResolvesSamples,     ///< `count` a pixel
    SharpensTextures,    ///< by `count` hundredths of a mip level
    GuardsImage,         ///< by `count` pixels on each side
    DebugCascades,       ///< `count` cascades of the sun
    DebugNoCascades,     ///< the sun has no maps
    DebugAtlas,          ///< `count` maps in `others` texels a side
    DebugNoAtlas,        ///< there is none
    DebugFroxels,        ///< the longest list of one has `count` lights
    DebugNoFroxels,      ///< there is one list of `count` lights
    DebugLights,         ///< `count` are in the list
    DebugViewShown,      ///< `others`, a DebugView
    DebugEffectIdle,     ///< `others`, a DebugView, whose effect does not run
    // The effect is not needed:
    NotInScene,
    NotInView,
    NoLightCasts,      ///< none that reaches what is visible casts shadows
    OtherChannels,     ///< none of `others` lights is on a channel of a lit surface in view
    LightsOutOfView,   ///< none of `others` lights reaches into the view
    ProbesOutOfReach,  ///< none of `others` boxes reaches a lit surface in view
    ProbesUnusable,    ///< `leftOut` in view differ from the environment, or the device lacks arrays of cubes
    DiscsOutOfView,    ///< none of `others` discs is in it
    NoLitSurface,      ///< there is such light, but no lit surface in view
    SwitchedOff,       ///< by the view: EffectRow::setting
    NoReceiver,        ///< there is such light, but no surface in view on which shadows fall
    NoCaster,          ///< nothing that casts lies in any of `count` maps
    NoTransmission,    ///< no light passes through what lies in any of `count` maps
    NoDepths,          ///< maps hold moments instead
    NoAreaCasts,       ///< none of `others` maps is that of an area
    DepthUnread,       ///< no effect needs it
    NoIndirectLight,   ///< none is seen
    NoOpaqueSurface,   ///< in view
    FogUnshadowed,     ///< no lamp reaches into the view and nothing shadows the sun
    Unrequested,       ///< nothing in view requests it: EffectRow::unrequested
    HiddenByDebugView, ///< a debug view is shown instead of the image
    UnlitDebugView,    ///< a debug view lights nothing
    ZeroDensity,       ///< or opacity
    ZeroIntensity,
    ZeroWidth,
    Neutral,        ///< its values change nothing
    NothingMoves,   ///< by itself, in view
    NothingVisible, ///< not even a sky
    NoSurface,      ///< in view
    HasSamples,     ///< `count` a pixel, which smooth edges as well
    TooLarge,       ///< the view, for a texture of `count` texels for each of its pixels
    InFocus,        ///< everything visible is
    NoOverlap,      ///< `count` objects, 0 or 1, need no order
    Count,          ///< no reason: how many there are
};

/// Texts for fmt. Arguments: {count}, {others}, {leftOut}, {all}: count + others, {hundredths}: 0.01 count,
/// {debugView}: the name of `others`, {setting} and {unrequested}: of the effect's row.
struct ReasonRow {
    DemandReason reason = DemandReason::Count;
    std::string_view text;      ///< of the reason
    std::string_view one{};     ///< instead of it, where `count` is 1
    std::string_view others{};  ///< follows where `others` is not 0
    std::string_view leftOut{}; ///< follows where `leftOut` is not 0
};

ReasonRow const& rowOf(DemandReason reason);

} // namespace filament_core::prepare
