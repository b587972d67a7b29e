// SPDX-License-Identifier: Apache-2.0
// Size: tests of the demand for each effect.
// Demand as a pure function, and as what prepareFrame() finds in scenes: without a device.
#include "filament_core/prepare/SceneDemand.h"
#include "filament_core/prepare/GuardBand.h"
#include "filament_core/scene/SceneData.h"

#include <gtest/gtest.h>

#include <set>

namespace filament_core::prepare {
namespace {

/// What findDemand() reads, with the view as the user set it.
struct DemandCase {
    ViewCounts counts;
    ShadowCounts shadows{};
    bool hasIndirectLight = false, hasSky = false;
    uint32_t deformed = 0, copiedPixels = 0, moved = 0;
    bool cameraMoved = false;
    Quality quality{};
    Effects effects{};
    float blurRadius = 0;
    uint2 size{ 1, 1 }, shownSize{ 1, 1 };
    uint32_t band = 0;
    uint8_t samples = 1;
    DebugView debugView = DebugView::None;
    uint32_t cascades = 0, atlasSize = 0;
    uint32_t discsInView = 0, discsOutOfView = 0;
    uint32_t splats = 0, splatClouds = 0;

    FrameSettings settings() const {
        return resolve({ .size = size + 2u * band,
                         .shownSize = shownSize,
                         .band = band,
                         .samples = samples,
                         .quality = quality,
                         .effects = effects,
                         .debugView = debugView });
    }
};

SceneDemand demandFor(DemandCase const& of) {
    return findDemand({ .counts = of.counts,
                        .shadows = of.shadows,
                        .hasIndirectLight = of.hasIndirectLight,
                        .hasSky = of.hasSky,
                        .deformed = of.deformed,
                        .copiedPixels = of.copiedPixels,
                        .moved = of.moved,
                        .cameraMoved = of.cameraMoved,
                        .blurRadius = of.blurRadius,
                        .settings = of.settings(),
                        .cascades = of.cascades,
                        .atlasSize = of.atlasSize,
                        .discsInView = of.discsInView,
                        .discsOutOfView = of.discsOutOfView,
                        .splats = of.splats,
                        .splatClouds = of.splatClouds });
}

/// The pixels that a view of `size` draws.
uint2 drawnSize(uint2 size, Resolution const& resolution, Quality const& quality, DebugView debugView) {
    Effects effects;
    effects.resolution = resolution;
    return viewInput({ .size = size, .quality = quality, .debugView = debugView }, effects, 0).size;
}

SceneDemand demandOf(ViewCounts const& counts) { return demandFor({ .counts = counts }); }

TEST(SceneDemand, OfAnEmptySceneIsNothing) {
    const SceneDemand demand = demandFor({});
    for (EffectDemand const& effect : demand.effects) {
        EXPECT_FALSE(effect.isNeeded);
    }
    for (const Effect option : { Effect::Shadows, Effect::ColoredShadows, Effect::AmbientOcclusion, Effect::Fog })
        EXPECT_EQ(demand.of(option).reason, DemandReason::SwitchedOff) << nameOf(option);
    for (const Effect asked : { Effect::Refraction, Effect::Reflections, Effect::ContactShadows })
        EXPECT_EQ(demand.of(asked).reason, DemandReason::Unrequested) << nameOf(asked);
    for (const Effect there : { Effect::Sun, Effect::LightList, Effect::IndirectLight, Effect::Sky })
        EXPECT_EQ(demand.of(there).reason, DemandReason::NotInScene) << nameOf(there);
    for (const Effect there : { Effect::Blending, Effect::Deformation })
        EXPECT_EQ(demand.of(there).reason, DemandReason::NotInView) << nameOf(there);
}

TEST(SceneDemand, NeedsColoursOfShadowsOnlyWhereACasterTransmitsLight) {
    ShadowCounts shadows{ .isOn = true, .lights = 1, .receivers = 1, .maps = 3 };
    const auto demand = [&] { return demandFor({ .shadows = shadows }).of(Effect::ColoredShadows); };
    EXPECT_EQ(describe(Effect::ColoredShadows, demand()), "switched off: coloredShadows=off");
    shadows.isColorOn = true;
    EXPECT_FALSE(demand().isNeeded);
    EXPECT_EQ(describe(Effect::ColoredShadows, demand()), "no light passes through what casts (3 maps)");
    shadows.coloredMaps = 2;
    EXPECT_TRUE(demand().isNeeded);
    EXPECT_EQ(describe(Effect::ColoredShadows, demand()), "light passes through casters in 2 of 3 maps");
    shadows.isOn = false;
    EXPECT_FALSE(demand().isNeeded);
}

TEST(SceneDemand, NeedsShadowsOfShapesOnlyWhereAMapIsThatOfAnAreaAndHoldsDepths) {
    ShadowCounts shadows{ .isOn = true, .lights = 1, .receivers = 1, .maps = 3 };
    const auto demand = [&] { return demandFor({ .shadows = shadows }).of(Effect::AreaShadows); };
    EXPECT_EQ(describe(Effect::AreaShadows, demand()), "switched off: areaShadows=center");
    shadows.isShapeOn = true;
    EXPECT_FALSE(demand().isNeeded);
    EXPECT_EQ(describe(Effect::AreaShadows, demand()), "none of 3 maps is that of an area");
    shadows.areaMaps = 2;
    EXPECT_TRUE(demand().isNeeded);
    EXPECT_EQ(describe(Effect::AreaShadows, demand()), "2 of 3 maps are read in the shape of their light");
    shadows.hasDepths = false;
    EXPECT_FALSE(demand().isNeeded);
    EXPECT_EQ(describe(Effect::AreaShadows, demand()), "maps of vsm and evsm hold no depths");
    shadows.isOn = false;
    EXPECT_FALSE(demand().isNeeded);
}

TEST(SceneDemand, NeedsFogOnlyWhereItHidesSomething) {
    Fog fog{ .enabled = true };
    const auto demand = [&] { return demandFor({ .effects = { .fog = fog } }).of(Effect::Fog); };
    EXPECT_TRUE(demand().isNeeded);
    EXPECT_EQ(describe(Effect::Fog, demand()), "lies between the camera and what is visible");
    fog.maximumOpacity = 0;
    EXPECT_FALSE(demand().isNeeded);
    EXPECT_EQ(describe(Effect::Fog, demand()), "its density or opacity is 0");
    fog = { .enabled = true, .density = 0 };
    EXPECT_FALSE(demand().isNeeded);
    EXPECT_EQ(describe(Effect::Fog, demand()), "its density or opacity is 0");
    fog = {};
    EXPECT_FALSE(demand().isNeeded);
    EXPECT_EQ(describe(Effect::Fog, demand()), "switched off: fog=off");
}

TEST(SceneDemand, NeedsCellsOfFogForWhatHasNoClosedForm) {
    Fog fog{ .enabled = true, .volumetric = true };
    ViewCounts counts{ .suns = 1 };
    const auto demand = [&] {
        return demandFor({ .counts = counts, .effects = { .fog = fog } }).of(Effect::VolumetricFog);
    };
    EXPECT_FALSE(demand().isNeeded);
    fog.attenuatesLight = true;
    EXPECT_TRUE(demand().isNeeded);
    EXPECT_EQ(describe(Effect::VolumetricFog, demand()), "it weakens the sun's light on its way");
    counts.suns = 0;
    EXPECT_FALSE(demand().isNeeded);
    fog.noiseAmplitude = 0.1f;
    EXPECT_EQ(describe(Effect::VolumetricFog, demand()), "its density varies");
    fog.volumetric = false;
    EXPECT_EQ(describe(Effect::VolumetricFog, demand()), "switched off: fog.volumetric=off");
    fog = { .enabled = true, .volumetric = true, .volumetricFrames = 8 };
    counts.suns = 1;
    EXPECT_FALSE(demand().isNeeded) << "a closed form needs no mean over frames";
}

TEST(SceneDemand, NeedsContactShadowsOnlyForLightsThatAskOverSurfacesThatReceive) {
    ViewCounts counts{ .litDraws = 1, .opaqueDraws = 1, .contactLights = 2 };
    const auto demand = [&](Effect effect) { return demandOf(counts).of(effect); };
    EXPECT_TRUE(demand(Effect::ContactShadows).isNeeded);
    EXPECT_EQ(describe(Effect::ContactShadows, demand(Effect::ContactShadows)), "2 lights ask for them");
    EXPECT_TRUE(demand(Effect::DepthPrepass).isNeeded) << "they read depths";
    counts.opaqueDraws = 0;
    EXPECT_FALSE(demand(Effect::ContactShadows).isNeeded);
    EXPECT_EQ(demand(Effect::ContactShadows).reason, DemandReason::NoOpaqueSurface);
    counts = { .opaqueDraws = 1, .contactLights = 2 };
    EXPECT_FALSE(demand(Effect::ContactShadows).isNeeded);
    EXPECT_EQ(demand(Effect::ContactShadows).reason, DemandReason::NoLitSurface);
    counts = { .litDraws = 1, .opaqueDraws = 1 };
    EXPECT_FALSE(demand(Effect::ContactShadows).isNeeded);
    EXPECT_EQ(demand(Effect::ContactShadows).reason, DemandReason::Unrequested);
    EXPECT_FALSE(demand(Effect::DepthPrepass).isNeeded);
}

TEST(SceneDemand, NeedsAmbientOcclusionOnlyWhereIndirectLightMeetsWhatIsOpaque) {
    DemandCase input{ .counts = { .litDraws = 3, .opaqueDraws = 2, .opaqueLitDraws = 2 }, .hasIndirectLight = true };
    const auto described = [&] {
        const SceneDemand demand = demandFor(input);
        EXPECT_EQ(demand.needs(Effect::DepthPrepass), demand.needs(Effect::AmbientOcclusion));
        return describe(Effect::AmbientOcclusion, demand.of(Effect::AmbientOcclusion));
    };
    EXPECT_EQ(described(), "switched off: ambientOcclusion=off");
    input.effects.ambientOcclusion.enabled = true;
    input.effects.ambientOcclusion.method = AmbientOcclusionMethod::Sao;
    EXPECT_EQ(described(), "darkens indirect light of 2 draws");
    EXPECT_TRUE(demandFor(input).needs(Effect::AmbientOcclusion));
    input.effects.ambientOcclusion.intensity = 0;
    EXPECT_EQ(described(), "its intensity is 0");
    input.effects.ambientOcclusion.intensity = 1;
    input.hasIndirectLight = false;
    EXPECT_EQ(described(), "no indirect light is seen");
    input.hasIndirectLight = true;
    input.counts.opaqueLitDraws = 0; // what is lit blends
    EXPECT_EQ(described(), "no indirect light is seen");
    EXPECT_FALSE(demandFor(input).needs(Effect::AmbientOcclusion));
    input.counts.opaqueDraws = 0;
    EXPECT_EQ(described(), "nothing opaque is visible");
}

TEST(SceneDemand, NeedsLightOnlyWhereItMeetsALitSurface) {
    ViewCounts counts{ .lights = 2, .suns = 1, .litDraws = 1 };
    const Effect lights[] = { Effect::Sun, Effect::LightList, Effect::IndirectLight };
    SceneDemand demand = demandFor({ .counts = counts, .hasIndirectLight = true });
    for (const Effect effect : lights) EXPECT_TRUE(demand.needs(effect)) << nameOf(effect);
    counts.litDraws = 0;
    demand = demandFor({ .counts = counts, .hasIndirectLight = true });
    for (const Effect effect : lights) {
        EXPECT_FALSE(demand.needs(effect)) << nameOf(effect);
        EXPECT_EQ(demand.of(effect).reason, DemandReason::NoLitSurface) << nameOf(effect);
    }
}

TEST(SceneDemand, TellsLightsOutOfViewFromNone) {
    EXPECT_EQ(demandOf({ .litDraws = 1 }).of(Effect::LightList).reason, DemandReason::NotInScene);
    const SceneDemand demand = demandOf({ .lightsOutOfView = 3, .litDraws = 1 });
    EXPECT_EQ(demand.of(Effect::LightList), (EffectDemand{ false, DemandReason::LightsOutOfView, 0, 3 }));
    EXPECT_EQ(describe(Effect::LightList, demand.of(Effect::LightList)), "none of 3 reaches into the view");
}

TEST(SceneDemand, CountsWhatIsLeftOut) {
    const SceneDemand demand =
            demandOf({ .lights = 4, .lightsOutOfView = 1, .lightsOverLimit = 2, .suns = 3, .litDraws = 1 });
    EXPECT_EQ(describe(Effect::LightList, demand.of(Effect::LightList)), "4 of 7 shine on what is visible");
    EXPECT_EQ(describe(Effect::Sun, demand.of(Effect::Sun)), "the brightest of 3; the others are in the light list");
}

TEST(SceneDemand, SaysWhichProfilesDoNotFit) {
    const SceneDemand demand = demandOf({ .lights = 9, .profiledLights = 5, .profilesOverLimit = 2, .litDraws = 1 });
    EXPECT_EQ(describe(Effect::LightProfiles, demand.of(Effect::LightProfiles)),
              "5 in view; 2 of them are dark: their profiles take more than 16 MiB");
}

TEST(SceneDemand, OfEachEffectChangesWithItsOwnCauseAlone) {
    const DemandCase nothing{ .counts = { .litDraws = 1 } };
    const auto changed = [&](DemandCase const& input) {
        std::vector<Effect> effects;
        for (size_t i = 0; i < kEffects; ++i) {
            const auto effect = static_cast<Effect>(i);
            if (demandFor(input).of(effect) != demandFor(nothing).of(effect)) effects.push_back(effect);
        }
        return effects;
    };
    EXPECT_EQ(changed({ .counts = { .suns = 1, .litDraws = 1 } }), std::vector{ Effect::Sun });
    EXPECT_EQ(changed({ .counts = { .lights = 1, .litDraws = 1 } }), std::vector{ Effect::LightList });
    EXPECT_EQ(changed({ .counts = { .lights = 1, .areaLights = 1, .litDraws = 1 } }),
              (std::vector{ Effect::LightList, Effect::AreaLights }));
    EXPECT_EQ(changed({ .counts = { .lights = 1, .profiledLights = 1, .litDraws = 1 } }),
              (std::vector{ Effect::LightList, Effect::LightProfiles }));
    EXPECT_EQ(changed({ .counts = { .litDraws = 1 }, .hasIndirectLight = true }), std::vector{ Effect::IndirectLight });
    EXPECT_EQ(changed({ .counts = { .litDraws = 1 }, .hasSky = true }), std::vector{ Effect::Sky });
    EXPECT_EQ(changed({ .counts = { .litDraws = 1 }, .discsInView = 1 }), std::vector{ Effect::SunDisc });
    for (const auto view : { DebugView::Cascades, DebugView::Atlas, DebugView::Froxels, DebugView::Lights })
        EXPECT_EQ(changed({ .counts = { .litDraws = 1 }, .debugView = view }), std::vector{ Effect::DebugView });
    EXPECT_EQ(changed({ .counts = { .litDraws = 1, .blendedDraws = 1 } }), std::vector{ Effect::Blending });
    EXPECT_EQ(changed({ .counts = { .litDraws = 1 }, .deformed = 1 }), std::vector{ Effect::Deformation });
}

std::string words(Effect effect, DemandCase const& input) { return describe(effect, demandFor(input).of(effect)); }

TEST(SceneDemand, NeedsAntiAliasingOnlyWhereThereIsSomethingToSmooth) {
    DemandCase input{ .counts = { .visible = 3, .opaqueDraws = 1 } };
    EXPECT_EQ(words(Effect::Taa, input), "switched off: antiAliasing");
    input.quality.antiAliasing = AntiAliasing::Taa;
    EXPECT_EQ(words(Effect::Taa, input), "smooths the edges of what is visible");
    EXPECT_FALSE(demandFor(input).needs(Effect::Fxaa));
    EXPECT_FALSE(demandFor(input).needs(Effect::DepthPrepass)) << "of a still camera";
    input.cameraMoved = true;
    EXPECT_TRUE(demandFor(input).needs(Effect::DepthPrepass));
    input.debugView = DebugView::Lights;
    EXPECT_EQ(words(Effect::Taa, input), "a debug view is shown");
    input = { .counts = {}, .hasSky = true };
    input.quality.antiAliasing = AntiAliasing::Fxaa;
    EXPECT_EQ(words(Effect::Fxaa, input), "no surface is visible");
    input.quality.antiAliasing = AntiAliasing::Taa;
    EXPECT_TRUE(demandFor(input).needs(Effect::Taa)) << "a sky has details";
    input.hasSky = false;
    EXPECT_EQ(words(Effect::Taa, input), "nothing is visible, not even a sky");
    input = { .counts = { .visible = 3, .opaqueDraws = 1 }, .quality = { .antiAliasing = AntiAliasing::Sraa } };
    EXPECT_TRUE(demandFor(input).needs(Effect::Sraa) && demandFor(input).needs(Effect::DepthPrepass));
}

TEST(SceneDemand, NeedsWhatFinishesThePictureUnlessItChangesNothing) {
    DemandCase input;
    EXPECT_EQ(words(Effect::ColorGrading, input), "switched off: colorGrading=off");
    EXPECT_EQ(words(Effect::Vignette, input), "switched off: vignette=off");
    EXPECT_EQ(words(Effect::Grain, input), "switched off: grain=off");
    EXPECT_EQ(words(Effect::ChromaticAberration, input), "switched off: chromaticAberration=off");
    input.effects.colorGrading.enabled = input.effects.vignette.enabled = true;
    input.effects.grain.enabled = input.effects.chromaticAberration.enabled = true;
    EXPECT_EQ(words(Effect::ColorGrading, input), "its values change nothing");
    input.effects.colorGrading.midPoint = float3(0.5f);
    EXPECT_EQ(words(Effect::ColorGrading, input), "its values change nothing") << "without a gamma or a scale";
    input.effects.colorGrading.contrast = 1.1f;
    for (const Effect effect : { Effect::ColorGrading, Effect::Vignette, Effect::Grain, Effect::ChromaticAberration })
        EXPECT_EQ(words(effect, input), "changes the whole picture") << nameOf(effect);
    input.effects.vignette.color = float3(1);
    input.effects.grain.strength = input.effects.chromaticAberration.strength = 0;
    EXPECT_EQ(words(Effect::Vignette, input), "its values change nothing");
    EXPECT_EQ(words(Effect::Grain, input), "its intensity is 0");
    EXPECT_EQ(words(Effect::ChromaticAberration, input), "its intensity is 0");
    input.debugView = DebugView::Lights;
    EXPECT_EQ(words(Effect::ColorGrading, input), "a debug view is shown");
}

TEST(SceneDemand, NeedsALensFlareOnlyOfSomethingThatShines) {
    DemandCase input{ .counts = { .visible = 1 } };
    EXPECT_EQ(words(Effect::LensFlare, input), "switched off: lensFlare=off");
    LensFlare& flare = input.effects.lensFlare;
    flare.enabled = true;
    EXPECT_EQ(words(Effect::LensFlare, input), "5 ghosts and a halo of what is bright");
    input.counts.visible = 0;
    EXPECT_EQ(words(Effect::LensFlare, input), "nothing is visible, not even a sky");
    input.hasSky = true;
    flare.haloStrength = 0, flare.ghostCount = 1;
    EXPECT_EQ(words(Effect::LensFlare, input), "1 ghost of what is bright");
    input.debugView = DebugView::Lights;
    EXPECT_EQ(words(Effect::LensFlare, input), "a debug view is shown");
    input.debugView = DebugView::None;
    for (const bool hasStrength : { false, true }) { // no ghosts by number, or by strength
        flare.ghostStrength = hasStrength ? 1.0f : 0.0f, flare.ghostCount = hasStrength ? uint8_t{ 0 } : uint8_t{ 8 };
        EXPECT_EQ(words(Effect::LensFlare, input), "its intensity is 0");
    }
    flare.haloStrength = 0.1f;
    EXPECT_EQ(words(Effect::LensFlare, input), "a halo of what is bright");
}

TEST(SceneDemand, SaysWhenDirtScattersLight) {
    DemandCase input{ .counts = { .visible = 1 } };
    input.effects.bloom.enabled = true;
    EXPECT_EQ(words(Effect::Bloom, input), "spreads light of what is visible");
    input.effects.bloom.dirt.bits = 1;
    EXPECT_EQ(words(Effect::Bloom, input), "spreads light of what is visible, by dirt on the lens");
    input.effects.bloom.dirtStrength = 0;
    EXPECT_EQ(words(Effect::Bloom, input), "spreads light of what is visible");
}

TEST(SceneDemand, NeedsUpscalingOnlyOfFewerPixels) {
    DemandCase input{ .size = { 200, 150 }, .shownSize = { 400, 300 } };
    EXPECT_EQ(words(Effect::Upscaling, input), "switched off: resolution.upscaling=off");
    for (const bool isGathered : { false, true }) {
        input.quality = {};
        if (isGathered) input.quality.antiAliasing = AntiAliasing::Taa;
        if (!isGathered) input.effects.resolution.upscaling = Upscaling::Bilinear;
        EXPECT_TRUE(demandFor(input).needs(Effect::Upscaling));
        EXPECT_EQ(words(Effect::Upscaling, input), "200 x 150 pixels are drawn");
        input.debugView = DebugView::Lights;
        EXPECT_EQ(words(Effect::Upscaling, input), "a debug view is shown");
        input.debugView = DebugView::None;
        std::swap(input.size, input.shownSize);
        input.shownSize = input.size;
        EXPECT_EQ(words(Effect::Upscaling, input), "its values change nothing");
        input.size = { 200, 150 };
    }
}

TEST(SceneDemand, NeedsSharpeningOnlyOfSomething) {
    DemandCase input;
    EXPECT_EQ(words(Effect::Sharpening, input), "switched off: sharpening=off");
    input.effects.sharpening.enabled = true;
    EXPECT_EQ(words(Effect::Sharpening, input), "nothing is visible, not even a sky");
    input.hasSky = true;
    EXPECT_EQ(words(Effect::Sharpening, input), "changes the whole picture");
    input.effects.sharpening.strength = 0;
    EXPECT_EQ(words(Effect::Sharpening, input), "its intensity is 0");
}

TEST(SceneDemand, ResolvesSamplesByWhatTheyDisplayOnlyWhereThereAreEdges) {
    DemandCase input{ .samples = 4 };
    EXPECT_EQ(words(Effect::MsaaResolve, input), "switched off: msaaResolve=average");
    input.quality.msaaResolve = MsaaResolve::ToneAware;
    EXPECT_EQ(words(Effect::MsaaResolve, input), "no surface is visible");
    input.counts.visible = 1;
    EXPECT_EQ(words(Effect::MsaaResolve, input), "4 samples a pixel, weighted by what they display");
    EXPECT_TRUE(demandFor(input).needs(Effect::MsaaResolve));
    input.samples = 1;
    EXPECT_EQ(words(Effect::MsaaResolve, input), "pixels have one sample");
}

TEST(SceneDemand, SharpensTexturesByTheShareOfPixelsThatFramesHave) {
    DemandCase input{ .size = { 200, 150 }, .shownSize = { 400, 300 } };
    const auto bias = [&](uint2 size, DebugView debugView) {
        return resolve({ .size = size, .shownSize = { 400, 300 }, .quality = input.quality, .debugView = debugView })
                .mipBias;
    };
    EXPECT_EQ(words(Effect::MipBias, input), "no frames are accumulated into more pixels than they have");
    input.quality.antiAliasing = AntiAliasing::Taa;
    EXPECT_EQ(words(Effect::MipBias, input), "textures are read 1.00 mip levels sharper");
    EXPECT_EQ(bias(input.size, DebugView::None), -1);
    EXPECT_EQ(bias({ 400, 150 }, DebugView::None), -0.5f) << "of the area";
    EXPECT_EQ(bias({ 400, 300 }, DebugView::None), 0);
    EXPECT_EQ(bias({ 200, 150 }, DebugView::Motion), 0);
    input.quality.mipBias = MipBias::Sharp;
    EXPECT_EQ(bias({ 400, 300 }, DebugView::None), -1);
    EXPECT_EQ(words(Effect::MipBias, input), "textures are read 2.00 mip levels sharper");
    input.quality.mipBias = MipBias::Off;
    EXPECT_EQ(words(Effect::MipBias, input), "switched off: mipBias=off");
}

TEST(SceneDemand, DrawsAGuardBandOnlyWhereItIsCutOff) {
    Effects effects;
    Quality quality;
    const auto band = [&](DebugView debugView = DebugView::None) {
        const View view{ .size = { 200, 105 }, .quality = quality, .debugView = debugView };
        return viewInput(view, effects, 0).band;
    };
    EXPECT_EQ(band(), 0u);
    effects.guardBand.enabled = true;
    EXPECT_EQ(band(), 11u) << "a tenth of the height, rounded up";
    EXPECT_EQ(band(DebugView::Fog), 0u);
    quality.antiAliasing = AntiAliasing::Taa;
    EXPECT_EQ(band(), 11u);
    effects.resolution.scale = float2(0.5f);
    EXPECT_EQ(band(), 0u) << "gathering enlarges";
    effects.resolution.upscaling = Upscaling::Bilinear;
    EXPECT_EQ(band(), 6u);

    DemandCase input;
    EXPECT_EQ(words(Effect::GuardBand, input), "switched off: guardBand=off");
    input.effects = effects;
    EXPECT_EQ(words(Effect::GuardBand, input), "nothing looks beside the picture, a debug view is shown, the target "
                                               "has depth, or accumulation enlarges the "
                                               "picture");
    input.band = 11;
    EXPECT_EQ(words(Effect::GuardBand, input), "11 pixels on each side are drawn and cut off");
    input.effects.guardBand.width = 0;
    EXPECT_EQ(words(Effect::GuardBand, input), "its width is 0");
}

TEST(SceneDemand, DrawsAGuardBandOnlyForWhatLooksBesideThePicture) {
    scene::SceneData scene;
    EXPECT_FALSE(looksBesidePicture(scene, {}, {}));
    const auto looks = [&](auto const& change) {
        Quality quality;
        Effects effects;
        change(quality, effects);
        return looksBesidePicture(scene, quality, effects);
    };
    EXPECT_TRUE(looks([](Quality&, Effects& effects) { effects.ambientOcclusion.enabled = true; }));
    EXPECT_TRUE(looks([](Quality&, Effects& effects) { effects.screenSpaceReflections.enabled = true; }));
    EXPECT_TRUE(looks([](Quality& quality, Effects&) { quality.antiAliasing = AntiAliasing::Taa; }));
    EXPECT_TRUE(looks([](Quality&, Effects& effects) { effects.bloom.enabled = true; }));
    EXPECT_TRUE(looks([](Quality&, Effects& effects) { effects.lensFlare.enabled = true; }));
    EXPECT_TRUE(looks([](Quality&, Effects& effects) { effects.depthOfField.enabled = true; }));
    EXPECT_TRUE(looks([](Quality&, Effects& effects) { effects.motionBlur.enabled = true; }));
    EXPECT_FALSE(looks([](Quality& quality, Effects& effects) {
        quality.antiAliasing = AntiAliasing::Fxaa;
        effects.resolution.upscaling = Upscaling::EdgeAdaptive;
        effects.vignette.enabled = effects.grain.enabled = effects.colorGrading.enabled = effects.autoExposure.enabled =
                true;
        effects.chromaticAberration.enabled = effects.sharpening.enabled = effects.fog.enabled = true;
    })) << "these come after the cut, or look at their own pixel alone";
    scene::addLight(scene, { .contactShadows = false });
    EXPECT_FALSE(looksBesidePicture(scene, {}, {}));
    scene::addLight(scene, { .contactShadows = true });
    EXPECT_TRUE(looksBesidePicture(scene, {}, {}));
}

TEST(SceneDemand, DrawsAShareOfThePixelsOnlyWhereSomethingEnlargesThem) {
    const uint2 size(101, 3);
    Quality quality;
    Resolution half{ .scale = float2(0.5f) };
    EXPECT_EQ(drawnSize(size, half, quality, DebugView::None), size);
    half.upscaling = Upscaling::CatmullRom;
    const auto drawn = [&](uint2 of, float2 scale) {
        return drawnSize(of, { .upscaling = Upscaling::CatmullRom, .scale = scale }, quality, DebugView::None);
    };
    EXPECT_EQ(drawn(size, float2(0.5f)), uint2(51, 2)) << "rounded";
    EXPECT_EQ(drawn(size, float2(1, 0.5f)), uint2(101, 2));
    EXPECT_EQ(drawn(size, float2(1)), size);
    EXPECT_EQ(drawn({ 1, 1 }, float2(0.5f)), uint2(1)) << "one pixel at least";
    EXPECT_EQ(drawn({ 16384, 1 }, float2(0.99999f)), uint2(16384, 1));
    EXPECT_EQ(drawnSize(size, half, quality, DebugView::Fog), size);
    half.upscaling = Upscaling::Off;
    quality = { .antiAliasing = AntiAliasing::Taa };
    EXPECT_EQ(drawnSize(size, half, quality, DebugView::None), uint2(51, 2));
}

TEST(SceneDemand, NeedsThePictureOnlyWhereItIsRefracted) {
    DemandCase input{ .counts = { .litDraws = 2 } };
    EXPECT_EQ(words(Effect::Refraction, input), "nothing in view refracts the picture");
    input.counts.refractiveDraws = 2;
    input.copiedPixels = 4096;
    EXPECT_EQ(words(Effect::Refraction, input), "2 in view see the picture, of which 4096 pixels are copied");
    EXPECT_TRUE(demandFor(input).needs(Effect::Refraction));
    input.quality.refraction = RefractionSource::Environment;
    EXPECT_EQ(words(Effect::Refraction, input), "switched off: refraction=environment");
    EXPECT_FALSE(demandFor(input).needs(Effect::Refraction));
}

TEST(SceneDemand, SplatsNeedACloudInViewAndCountAsVisible) {
    DemandCase input;
    EXPECT_EQ(words(Effect::Splats, input), "none in the scene");
    input.splatClouds = 2;
    EXPECT_EQ(words(Effect::Splats, input), "none in view");
    input.effects.bloom.enabled = true;
    EXPECT_FALSE(demandFor(input).needs(Effect::Bloom));
    input.splats = 7;
    EXPECT_EQ(words(Effect::Splats, input), "7 in view");
    EXPECT_TRUE(demandFor(input).needs(Effect::Bloom)) << "they are something visible";
    input.debugView = DebugView::Fog;
    EXPECT_EQ(words(Effect::Splats, input), "a debug view is shown");
}

TEST(SceneDemand, ComposesInAnyOrderOnlyWhatMayOverlap) {
    DemandCase input{ .counts = { .blendedDraws = 3, .anyOrderObjects = 2 } };
    const auto needs = [&] { return demandFor(input).needs(Effect::Transparency); };
    EXPECT_EQ(words(Effect::Transparency, input), "switched off: transparency=sorted");
    input.quality.transparency = TransparencyOrder::Weighted;
    EXPECT_EQ(words(Effect::Transparency, input), "2 in view may overlap");
    EXPECT_TRUE(needs());
    input.quality.transparency = TransparencyOrder::Peeled;
    EXPECT_EQ(words(Effect::Transparency, input), "2 in view may overlap; 4 layers");
    EXPECT_TRUE(needs());
    input.quality.transparencyLayers = 1;
    EXPECT_EQ(words(Effect::Transparency, input), "switched off: transparency=sorted") << "one layer is that";
    EXPECT_FALSE(needs());
    input.quality.transparencyLayers = 8;
    input.debugView = DebugView::Fog;
    EXPECT_EQ(words(Effect::Transparency, input), "a debug view is shown");
    EXPECT_FALSE(needs());
    input.debugView = DebugView::None;
    for (const uint32_t objects : { 0u, 1u }) {
        input.counts.anyOrderObjects = objects;
        EXPECT_EQ(words(Effect::Transparency, input),
                  fmt::format("{} in view that may be composed in any order", objects));
        EXPECT_FALSE(needs());
    }
}

TEST(SceneDemand, SaysWhatDebugViewsShow) {
    const ViewCounts lists{ .lights = 40, .froxels = 4096, .longestFroxel = 7, .litDraws = 1 };
    DemandCase input{ .counts = lists, .debugView = DebugView::Cascades, .cascades = 3 };
    EXPECT_EQ(words(Effect::DebugView, input), "debugView=cascades: 3 of the sun");
    input.cascades = 0;
    EXPECT_EQ(words(Effect::DebugView, input), "debugView=cascades: none, the sun has no shadow map");
    input.debugView = DebugView::Atlas;
    EXPECT_EQ(words(Effect::DebugView, input), "debugView=atlas: black, there is no atlas ('shadows' says why)");
    input.shadows = { .isOn = true, .maps = 5 };
    input.atlasSize = 2048;
    EXPECT_EQ(words(Effect::DebugView, input), "debugView=atlas: 5 maps in 2048 x 2048 texels");
    input.debugView = DebugView::Froxels;
    EXPECT_EQ(words(Effect::DebugView, input), "debugView=froxels: at most 7 lights");
    input.counts.froxels = 0;
    EXPECT_EQ(words(Effect::DebugView, input), "debugView=froxels: no grid, 40 lights everywhere");
    input.debugView = DebugView::Lights;
    EXPECT_EQ(words(Effect::DebugView, input), "debugView=lights: at most 40");
    input.counts.litDraws = 0;
    EXPECT_EQ(words(Effect::DebugView, input), "debugView=lights: at most 0");
}

TEST(SceneDemand, RunsTheEffectThatADebugViewShows) {
    DemandCase input{ .counts = { .visible = 1, .opaqueDraws = 1 }, .blurRadius = 3 };
    input.quality.antiAliasing = AntiAliasing::Taa;
    input.effects.depthOfField.enabled = input.effects.autoExposure.enabled = input.effects.bloom.enabled = true;
    const std::array shown{ std::pair(DebugView::CircleOfConfusion, Effect::DepthOfField),
                            std::pair(DebugView::HistoryWeight, Effect::Taa),
                            std::pair(DebugView::Histogram, Effect::AutoExposure) };
    const Resolution half{ .upscaling = Upscaling::Bilinear, .scale = float2(0.5f) };
    for (auto const& [view, ofView] : shown) {
        input.debugView = view;
        const SceneDemand demand = demandFor(input);
        for (auto const& [other, effect] : shown) EXPECT_EQ(demand.needs(effect), effect == ofView) << nameOf(effect);
        EXPECT_FALSE(demand.needs(Effect::Bloom));
        EXPECT_EQ(words(Effect::DebugView, input), std::string("debugView=") + toString(view));
        EXPECT_EQ(drawnSize({ 100, 60 }, half, input.quality, view), uint2(100, 60)) << toString(view);
    }
    input = { .debugView = DebugView::Histogram };
    EXPECT_EQ(words(Effect::DebugView, input), "debugView=histogram: its effect does not run (its line says why)");
}

TEST(SceneDemand, LightsNothingWhereADebugViewShowsMaterials) {
    DemandCase input{ .counts = { .visible = 4,
                                  .lights = 3,
                                  .suns = 1,
                                  .litDraws = 4,
                                  .opaqueDraws = 4,
                                  .opaqueLitDraws = 4,
                                  .refractiveDraws = 1,
                                  .reflectiveDraws = 1 },
                      .shadows = { .isOn = true, .maps = 2 },
                      .hasIndirectLight = true,
                      .hasSky = true,
                      .moved = 1,
                      .discsInView = 1 };
    input.effects.ambientOcclusion.enabled = true;
    input.quality.refraction = RefractionSource::Screen;
    input.effects.screenSpaceReflections.enabled = true;
    input.effects.fog.enabled = true;
    const std::array lit{ Effect::Sun,        Effect::LightList,   Effect::Shadows, Effect::IndirectLight,
                          Effect::Sky,        Effect::SunDisc,     Effect::Fog,     Effect::AmbientOcclusion,
                          Effect::Refraction, Effect::Reflections, Effect::Motion };
    for (size_t i = 0; i < kDebugViewCount; ++i) {
        input.debugView = static_cast<DebugView>(i);
        const SceneDemand demand = demandFor(input);
        const bool isLit = input.debugView < DebugView::BaseColor || input.debugView == DebugView::Wireframe ||
                           input.debugView == DebugView::Probes;
        for (const Effect effect : lit) {
            EXPECT_EQ(demand.needs(effect), isLit) << toString(input.debugView) << ": " << nameOf(effect);
            EXPECT_EQ(words(effect, input) == "a debug view shows no light", !isLit) << nameOf(effect);
        }
        EXPECT_EQ(demand.needs(Effect::DebugView), i > 0);
        EXPECT_EQ(demand.needs(Effect::DepthPrepass), isLit) << "nothing else reads depths";
        const Quality drawn = resolve({ .quality = input.quality, .debugView = input.debugView }).quality;
        EXPECT_EQ(drawn == input.quality, isLit) << toString(input.debugView);
        EXPECT_TRUE(isLit || drawn.shadows == ShadowFilter::Off);
        EXPECT_EQ(resolve({ .effects = input.effects, .debugView = input.debugView }).effects == input.effects, isLit)
                << toString(input.debugView);
    }
    input.debugView = DebugView::Overdraw;
    EXPECT_EQ(words(Effect::DebugView, input), "debugView=overdraw");
    input.quality.depthPrepass = DepthPrepass::On;
    EXPECT_TRUE(demandFor(input).needs(Effect::DepthPrepass)) << "so that it can be seen what it saves";
}

TEST(SceneDemand, CountsTheDiscsOfSuns) {
    EXPECT_EQ(words(Effect::SunDisc, {}), "none in the scene");
    EXPECT_EQ(words(Effect::SunDisc, { .discsOutOfView = 2 }), "none of 2 is in view");
    EXPECT_EQ(words(Effect::SunDisc, { .discsInView = 1, .discsOutOfView = 2 }), "1 of 3 in view");
}

TEST(SceneDemand, HasWordsForEveryReason) {
    for (size_t i = 0; i < static_cast<size_t>(DemandReason::Count); ++i) {
        for (const uint32_t count : { 0u, 1u, 2u }) {
            const EffectDemand demand{
                .reason = static_cast<DemandReason>(i), .count = count, .others = count, .leftOut = count
            };
            const std::string text = describe(Effect::MipBias, demand); // has all words of its own
            EXPECT_FALSE(text.empty()) << i;
            EXPECT_EQ(text.find_first_of("{}"), std::string::npos) << text;
        }
    }
}

TEST(SceneDemand, NamesEveryEffectOnce) {
    std::set<std::string> names;
    for (size_t i = 0; i < kEffects; ++i) EXPECT_TRUE(names.insert(nameOf(static_cast<Effect>(i))).second);
    EXPECT_EQ(names.count(""), 0u);
}

} // namespace
} // namespace filament_core::prepare
