// SPDX-License-Identifier: Apache-2.0
// The words of a demand: what explain(), reports and documents say.
#include "base/Result.h"
#include "filament_core/prepare/SceneDemand.h"

namespace filament::prepare {
namespace {

std::string describeDebugView(EffectDemand const& demand) {
    switch (demand.reason) {
    case DemandReason::ShowsCascades:
        return demand.count ? fmt::format("debugView=cascades: {} of the sun", demand.count)
                            : "debugView=cascades: none, the sun has no shadow map";
    case DemandReason::ShowsAtlas:
        return demand.count ? fmt::format("debugView=atlas: {} maps in {} x {} texels", demand.count, demand.others,
                                          demand.others)
                            : "debugView=atlas: black, there is no atlas ('shadows' says why)";
    case DemandReason::ShowsFroxels:
        return demand.others ? fmt::format("debugView=froxels: at most {} lights", demand.count)
                             : fmt::format("debugView=froxels: no grid, {} lights everywhere", demand.count);
    case DemandReason::ShowsEffect:
        return fmt::format("debugView={}{}", toString(static_cast<DebugView>(demand.others)),
                           demand.count ? "" : ": its effect does not run (its line says why)");
    default:
        return fmt::format("debugView=lights: at most {}", demand.count);
    }
}

std::string describeShining(Effect effect, EffectDemand const& demand) {
    if (effect == Effect::IndirectLight) return "the environment lights what is visible";
    if (effect == Effect::Sun && demand.count > 1)
        return fmt::format("the brightest of {}; the others are in the light list", demand.count);
    if (demand.leftOut)
        return fmt::format("{} in view; {} of them are dark: their profiles take more than 16 MiB", demand.count,
                           demand.leftOut);
    if (demand.count + demand.others == 1) return "shines on what is visible";
    return fmt::format("{} of {} shine on what is visible", demand.count, demand.count + demand.others);
}

const char* describeSwitch(Effect effect) {
    switch (effect) {
    case Effect::ColoredShadows:
        return "switched off: coloredShadows=off";
    case Effect::AmbientOcclusion:
        return "switched off: ambientOcclusion=off";
    case Effect::Refraction:
        return "switched off: refraction=environment";
    case Effect::Reflections:
        return "switched off: screenSpaceReflections=off";
    case Effect::Transparency:
        return "switched off: transparency=sorted";
    case Effect::Fog:
        return "switched off: fog=off";
    case Effect::Taa:
    case Effect::Fxaa:
        return "switched off: antiAliasing";
    case Effect::DepthOfField:
        return "switched off: depthOfField=off";
    case Effect::MotionBlur:
        return "switched off: motionBlur=off";
    case Effect::AutoExposure:
        return "switched off: autoExposure=off";
    case Effect::Bloom:
        return "switched off: bloom=off";
    case Effect::LensFlare:
        return "switched off: lensFlare=off";
    case Effect::ChromaticAberration:
        return "switched off: chromaticAberration=off";
    case Effect::Vignette:
        return "switched off: vignette=off";
    case Effect::Grading:
        return "switched off: grading=off";
    case Effect::Grain:
        return "switched off: grain=off";
    case Effect::Upscaling:
        return "switched off: resolution.upscaling=off";
    case Effect::Sharpening:
        return "switched off: sharpening=off";
    case Effect::MsaaResolve:
        return "switched off: msaaResolve=average";
    case Effect::MipBias:
        return "switched off: mipBias=off";
    case Effect::GuardBand:
        return "switched off: guardBand=off";
    default:
        return "switched off: shadows=off";
    }
}

const char* describeNobody(Effect effect) {
    switch (effect) {
    case Effect::Refraction:
        return "nothing in view refracts the picture";
    case Effect::Reflections:
        return "nothing in view reflects the picture";
    case Effect::Transparency:
    case Effect::Taa:
    case Effect::DepthOfField:
    case Effect::MotionBlur:
    case Effect::AutoExposure:
    case Effect::Bloom:
    case Effect::LensFlare:
    case Effect::ChromaticAberration:
    case Effect::Vignette:
    case Effect::Grading:
    case Effect::Grain:
    case Effect::Fxaa:
    case Effect::Upscaling:
    case Effect::Sharpening:
        return "a debug view is shown";
    case Effect::Motion:
        return "no effect looks at the last picture";
    case Effect::Stencil:
        return "nothing in view has a stencil state";
    case Effect::MsaaResolve:
        return "pixels have one sample";
    case Effect::MipBias:
        return "no frames are gathered into more pixels than they have";
    case Effect::GuardBand:
        return "nothing looks beside the picture, a debug view is shown, the target has depth, or gathering "
               "enlarges the picture";
    default:
        return "no light in view asks for them";
    }
}

std::string describeFlare(EffectDemand const& demand) {
    const std::string ghosts =
            demand.count ? fmt::format("{} ghost{}", demand.count, demand.count == 1 ? "" : "s") : std::string();
    const char* const halo = demand.others == 0 ? "" : demand.count ? " and a halo" : "a halo";
    return fmt::format("{}{} of what is bright", ghosts, halo);
}

std::string describeNeed(Effect effect, EffectDemand const& demand) {
    switch (demand.reason) {
    case DemandReason::ReachesLitSurfaces:
        return describeShining(effect, demand);
    case DemandReason::IsVisible:
        return fmt::format("{} in view", demand.count);
    case DemandReason::FillsBackground:
        return "fills what nothing covers";
    case DemandReason::DarkensWhatIsVisible:
        return fmt::format("{} map{}, {} of them drawn in this frame{}", demand.count, demand.count == 1 ? "" : "s",
                           demand.others,
                           demand.leftOut ? fmt::format("; {} do not fit: shadowAtlasMegabytes", demand.leftOut) : "");
    case DemandReason::TintsShadows:
        return fmt::format("light passes through casters in {} of {} maps", demand.count, demand.count + demand.others);
    case DemandReason::ShowsInSky:
        return fmt::format("{} of {} in view", demand.count, demand.count + demand.others);
    case DemandReason::ShowsCascades:
    case DemandReason::ShowsAtlas:
    case DemandReason::ShowsFroxels:
    case DemandReason::ShowsLights:
    case DemandReason::ShowsEffect:
        return describeDebugView(demand);
    case DemandReason::DepthIsRead:
        return demand.count == 1 ? "an effect reads the depths"
                                 : fmt::format("{} effects read the depths", demand.count);
    case DemandReason::SwitchedOn:
        return "depthPrepass=on";
    case DemandReason::DarkensIndirectLight:
        return fmt::format("darkens indirect light of {} draws", demand.count);
    case DemandReason::SeesPicture:
        return fmt::format("{} in view see{} the picture{}", demand.count, demand.count == 1 ? "s" : "",
                           demand.others ? fmt::format(", of which {} pixels are copied", demand.others) : "");
    case DemandReason::LightsAskForIt:
        return fmt::format("{} light{} for them", demand.count, demand.count == 1 ? " asks" : "s ask");
    case DemandReason::LiesInBetween:
        return "lies between the camera and what is visible";
    case DemandReason::CameraMoves:
        return "the camera moves";
    case DemandReason::MovesInView:
        return fmt::format("{} in view moved", demand.count);
    case DemandReason::SpreadsLight:
        return demand.count ? "spreads light of what is visible, by dirt on the lens"
                            : "spreads light of what is visible";
    case DemandReason::ReflectsLight:
        return describeFlare(demand);
    case DemandReason::SmoothsEdges:
        return "smooths the edges of what is visible";
    case DemandReason::ChangesPicture:
        return "changes the whole picture";
    case DemandReason::IsOutOfFocus:
        return fmt::format("something visible is out of focus, by at most {} pixel{}", demand.count,
                           demand.count == 1 ? "" : "s");
    case DemandReason::MeasuresPicture:
        return "measures how bright the picture is";
    case DemandReason::MayOverlap:
        return demand.others ? fmt::format("{} in view may overlap; {} layers", demand.count, demand.others)
                             : fmt::format("{} in view may overlap", demand.count);
    case DemandReason::EnlargesPicture:
        return fmt::format("{} x {} pixels are drawn", demand.count, demand.others);
    case DemandReason::ResolvesSamples:
        return fmt::format("{} samples a pixel, weighted by what they display", demand.count);
    case DemandReason::SurroundsPicture:
        return fmt::format("{} pixels on each side are drawn and cut off", demand.count);
    case DemandReason::SharpensTextures:
        return fmt::format("textures are read {:.2f} mip levels sharper", demand.count * 0.01);
    default:
        return {};
    }
}

std::string describeLack(Effect effect, EffectDemand const& demand) {
    switch (demand.reason) {
    case DemandReason::NothingTransmits:
        return fmt::format("no light passes through what casts ({} maps)", demand.count);
    case DemandReason::NothingOverlaps:
        return fmt::format("{} in view that may be composed in any order", demand.count);
    case DemandReason::NothingIsLit:
        return "a debug view shows no light";
    case DemandReason::IsInFocus:
        return "everything visible is in focus";
    case DemandReason::IsNeutral:
        return "its values change nothing";
    case DemandReason::NothingHasEdges:
        return "no surface is visible";
    case DemandReason::NothingShines:
        return "nothing is visible, not even a sky";
    case DemandReason::NothingMoves:
        return "nothing in view moves by itself";
    case DemandReason::DepthIsUnread:
        return "no effect reads depths";
    case DemandReason::NothingIndirect:
        return "no indirect light is seen";
    case DemandReason::NothingOpaque:
        return "nothing opaque is visible";
    case DemandReason::NothingAsks:
        return describeNobody(effect);
    case DemandReason::HasNoDensity:
        return "its density or opacity is 0";
    case DemandReason::HasNoIntensity:
        return effect == Effect::GuardBand ? "its width is 0" : "its intensity is 0";
    case DemandReason::SwitchedOff:
        return describeSwitch(effect);
    case DemandReason::NothingReceives:
        return "no surface in view receives shadows";
    case DemandReason::NothingCasts:
        return fmt::format("nothing that casts lies in the way of the light ({} maps tried)", demand.count);
    case DemandReason::NotInScene:
        if (effect == Effect::Shadows) return "no light that reaches what is visible casts shadows";
        return effect == Effect::Blending || effect == Effect::Deformation ? "none in view" : "none in the scene";
    case DemandReason::OtherChannels:
        return fmt::format("none of {} is on a channel of what is visible", demand.others);
    case DemandReason::OutOfView:
        if (effect == Effect::SunDisc) return fmt::format("none of {} is in view", demand.others);
        return fmt::format("none of {} reaches into the view", demand.others);
    case DemandReason::NothingLitVisible:
        return "no lit surface is visible";
    default:
        return {};
    }
}

} // namespace

const char* nameOf(Effect effect) {
    static constexpr std::array<const char*, kEffects> kNames{ "sun",
                                                               "light list",
                                                               "area lights",
                                                               "light profiles",
                                                               "shadows",
                                                               "coloured shadows",
                                                               "indirect light",
                                                               "sky",
                                                               "sun disc",
                                                               "blending",
                                                               "transparency",
                                                               "deformation",
                                                               "stencil",
                                                               "depth prepass",
                                                               "ambient occlusion",
                                                               "refraction",
                                                               "reflections",
                                                               "motion",
                                                               "contact shadows",
                                                               "fog",
                                                               "taa",
                                                               "depth of field",
                                                               "motion blur",
                                                               "auto exposure",
                                                               "bloom",
                                                               "fringes",
                                                               "vignette",
                                                               "grading",
                                                               "grain",
                                                               "fxaa",
                                                               "upscaling",
                                                               "sharpening",
                                                               "lens flare",
                                                               "msaa resolve",
                                                               "mip bias",
                                                               "guard band",
                                                               "debug view" };
    return kNames[static_cast<size_t>(effect)];
}

std::string describe(Effect effect, EffectDemand const& demand) {
    const std::string need = describeNeed(effect, demand);
    return need.empty() ? describeLack(effect, demand) : need;
}

} // namespace filament::prepare
