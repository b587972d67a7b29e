// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DemandReason.h"

#include <algorithm>
#include <array>

namespace filament_core::prepare {
namespace {

using R = DemandReason;

constexpr std::array kReasons{
    ReasonRow{ R::LightsVisible, "{count} of {all} shine on what is visible" },
    ReasonRow{ R::OnlyLight, "shines on what is visible" },
    ReasonRow{ R::BrightestSun, "the brightest of {count}; the others are in the light list" },
    ReasonRow{ R::ProfilesOverBudget,
               "{count} in view; {leftOut} of them are dark: their profiles take more than 16 MiB" },
    ReasonRow{ R::ImagesOverBudget,
               "{count} in view; {leftOut} of them are dark: images of more than 1024 lights or 16 MiB" },
    ReasonRow{ R::EnvironmentLights, "the environment lights what is visible" },
    ReasonRow{ .reason = R::ProbesInView,
               .text = "{count} light surfaces in view",
               .one = "1 lights surfaces in view",
               .others = "; {others} reach none",
               .leftOut = "; {leftOut} reach some and are not used" },
    ReasonRow{ R::InView, "{count} in view" },
    ReasonRow{ R::BackgroundVisible, "fills what nothing covers" },
    ReasonRow{ .reason = R::ShadowsVisible,
               .text = "{count} maps, {others} of them drawn in this frame",
               .one = "1 map, {others} of them drawn in this frame",
               .leftOut = "; {leftOut} do not fit: shadowAtlasMegabytes" },
    ReasonRow{ R::ShadowsColored, "light passes through casters in {count} of {all} maps" },
    ReasonRow{ R::ShadowsOfShapes, "{count} of {all} maps are read in the shape of their light" },
    ReasonRow{ R::DiscsInView, "{count} of {all} in view" },
    ReasonRow{ .reason = R::DepthRead, .text = "{count} effects read the depths", .one = "an effect reads the depths" },
    ReasonRow{ R::PrepassEnabled, "depthPrepass=on" },
    ReasonRow{ R::OccludesIndirect, "darkens indirect light of {count} draws" },
    ReasonRow{ .reason = R::SamplesSceneColor,
               .text = "{count} in view see the picture",
               .one = "1 in view sees the picture",
               .others = ", of which {others} pixels are copied" },
    ReasonRow{ .reason = R::RequestedByLights, .text = "{count} lights ask for them", .one = "1 light asks for them" },
    ReasonRow{ R::FogLights, "lit by {count} lights of the list; {others} cascades of the sun" },
    ReasonRow{ R::FogVaries, "its density varies" },
    ReasonRow{ R::FogWeakensSun, "it weakens the sun's light on its way" },
    ReasonRow{ R::CameraInFog, "lies between the camera and what is visible" },
    ReasonRow{ R::ObjectsMove, "{count} in view moved" },
    ReasonRow{ R::CameraMoves, "the camera moves" },
    ReasonRow{ R::ScattersLight, "spreads light of what is visible" },
    ReasonRow{ R::ScattersLightByDirt, "spreads light of what is visible, by dirt on the lens" },
    ReasonRow{
            .reason = R::LensGhosts, .text = "{count} ghosts of what is bright", .one = "1 ghost of what is bright" },
    ReasonRow{ R::LensHalo, "a halo of what is bright" },
    ReasonRow{ .reason = R::LensGhostsAndHalo,
               .text = "{count} ghosts and a halo of what is bright",
               .one = "1 ghost and a halo of what is bright" },
    ReasonRow{ R::SmoothsEdges, "smooths the edges of what is visible" },
    ReasonRow{ R::ChangesImage, "changes the whole picture" },
    ReasonRow{ .reason = R::OutOfFocus,
               .text = "something visible is out of focus, by at most {count} pixels",
               .one = "something visible is out of focus, by at most 1 pixel" },
    ReasonRow{ R::MeasuresLuminance, "measures how bright the picture is" },
    ReasonRow{ R::UpscalesImage, "{count} x {others} pixels are drawn" },
    ReasonRow{ .reason = R::MayOverlap, .text = "{count} in view may overlap", .others = "; {others} layers" },
    ReasonRow{ R::ResolvesSamples, "{count} samples a pixel, weighted by what they display" },
    ReasonRow{ R::SharpensTextures, "textures are read {hundredths:.2f} mip levels sharper" },
    ReasonRow{ R::GuardsImage, "{count} pixels on each side are drawn and cut off" },
    ReasonRow{ R::DebugCascades, "debugView=cascades: {count} of the sun" },
    ReasonRow{ R::DebugNoCascades, "debugView=cascades: none, the sun has no shadow map" },
    ReasonRow{ R::DebugAtlas, "debugView=atlas: {count} maps in {others} x {others} texels" },
    ReasonRow{ R::DebugNoAtlas, "debugView=atlas: black, there is no atlas ('shadows' says why)" },
    ReasonRow{ R::DebugFroxels, "debugView=froxels: at most {count} lights" },
    ReasonRow{ R::DebugNoFroxels, "debugView=froxels: no grid, {count} lights everywhere" },
    ReasonRow{ R::DebugLights, "debugView=lights: at most {count}" },
    ReasonRow{ R::DebugViewShown, "debugView={debugView}" },
    ReasonRow{ R::DebugEffectIdle, "debugView={debugView}: its effect does not run (its line says why)" },
    ReasonRow{ R::NotInScene, "none in the scene" },
    ReasonRow{ R::NotInView, "none in view" },
    ReasonRow{ R::NoLightCasts, "no light that reaches what is visible casts shadows" },
    ReasonRow{ R::OtherChannels, "none of {others} is on a channel of what is visible" },
    ReasonRow{ R::LightsOutOfView, "none of {others} reaches into the view" },
    ReasonRow{ R::ProbesOutOfReach, "none of {others} reaches a lit surface in view" },
    ReasonRow{ R::ProbesUnusable, "{leftOut} reach surfaces in view, and none of them can be used" },
    ReasonRow{ R::DiscsOutOfView, "none of {others} is in view" },
    ReasonRow{ R::NoLitSurface, "no lit surface is visible" },
    ReasonRow{ R::SwitchedOff, "switched off: {setting}" },
    ReasonRow{ R::NoReceiver, "no surface in view receives shadows" },
    ReasonRow{ R::NoCaster, "nothing that casts lies in the way of the light ({count} maps tried)" },
    ReasonRow{ R::NoTransmission, "no light passes through what casts ({count} maps)" },
    ReasonRow{ R::NoDepths, "maps of vsm and evsm hold no depths" },
    ReasonRow{ R::NoAreaCasts, "none of {others} maps is that of an area" },
    ReasonRow{ R::DepthUnread, "no effect reads depths" },
    ReasonRow{ R::NoIndirectLight, "no indirect light is seen" },
    ReasonRow{ R::NoOpaqueSurface, "nothing opaque is visible" },
    ReasonRow{ R::FogUnshadowed, "no lamp reaches into the view, and nothing shadows the sun" },
    ReasonRow{ R::Unrequested, "{unrequested}" },
    ReasonRow{ R::HiddenByDebugView, "a debug view is shown" },
    ReasonRow{ R::UnlitDebugView, "a debug view shows no light" },
    ReasonRow{ R::ZeroDensity, "its density or opacity is 0" },
    ReasonRow{ R::ZeroIntensity, "its intensity is 0" },
    ReasonRow{ R::ZeroWidth, "its width is 0" },
    ReasonRow{ R::Neutral, "its values change nothing" },
    ReasonRow{ R::NothingMoves, "nothing in view moves by itself" },
    ReasonRow{ R::NothingVisible, "nothing is visible, not even a sky" },
    ReasonRow{ R::NoSurface, "no surface is visible" },
    ReasonRow{ R::HasSamples, "{count} samples a pixel smooth edges already" },
    ReasonRow{ R::TooLarge, "the view is too large for {count} depths a pixel on this device" },
    ReasonRow{ R::InFocus, "everything visible is in focus" },
    ReasonRow{ R::NoOverlap, "{count} in view that may be composed in any order" },
};

static_assert(kReasons.size() == static_cast<size_t>(DemandReason::Count) &&
                      std::ranges::all_of(kReasons,
                                          [](ReasonRow const& row) {
                                              return &row - kReasons.data() == static_cast<std::ptrdiff_t>(row.reason);
                                          }),
              "every reason has a row, in the order of the enumerators");

} // namespace

ReasonRow const& rowOf(DemandReason reason) { return kReasons[static_cast<size_t>(reason)]; }

} // namespace filament_core::prepare
