// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/Frame.h"

#include "filament_core/passes/AmbientOcclusionPass.h"
#include "filament_core/passes/AppPass.h"
#include "filament_core/passes/BloomPass.h"
#include "filament_core/passes/ColorPass.h"
#include "filament_core/passes/DebugDrawPass.h"
#include "filament_core/passes/DebugEffectPass.h"
#include "filament_core/passes/DebugSurfacePass.h"
#include "filament_core/passes/DebugViewPass.h"
#include "filament_core/passes/DepthOfFieldPass.h"
#include "filament_core/passes/DepthPass.h"
#include "filament_core/passes/ExposurePass.h"
#include "filament_core/passes/FlarePass.h"
#include "filament_core/passes/FogLightPass.h"
#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/MotionBlurPass.h"
#include "filament_core/passes/MotionPass.h"
#include "filament_core/passes/PostProcessPass.h"
#include "filament_core/passes/ReconstructionPass.h"
#include "filament_core/passes/SceneColorCopyPass.h"
#include "filament_core/passes/ShadowPass.h"
#include "filament_core/passes/TargetMips.h"
#include "filament_core/passes/TemporalPass.h"
#include "filament_core/passes/ViewportBlitPass.h"
#include "filament_core/prepare/DebugViews.h"

namespace filament_core::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;
using framegraph::TextureId;

uint8_t probeTermsOf(prepare::FramePacket const& packet) {
    if (!packet.demand.needs(prepare::Effect::ReflectionProbes)) return 0;
    const bool isAlone = !packet.probes.addsEnvironment;
    switch (packet.probes.used) {
    case 1:
        return isAlone ? shader::kOneProbeAlone : shader::kOneProbe;
    case 2:
        return isAlone ? shader::kTwoProbesAlone : shader::kTwoProbes;
    case 3:
        return shader::kThreeProbes;
    case 4:
        return shader::kFourProbes;
    default:
        return shader::kAllProbes;
    }
}

ShadedLights lightsOf(prepare::FramePacket const& packet) {
    return { .hasAreas = packet.mainView().hasAreaLights,
             .hasProfiles = !packet.mainView().profiles.empty(),
             .imageTerms = packet.mainView().images.terms,
             .hasColoredShadows = packet.demand.needs(prepare::Effect::ColoredShadows),
             .hasAreaShadows = packet.demand.needs(prepare::Effect::AreaShadows),
             .hasContactShadows = packet.demand.needs(prepare::Effect::ContactShadows),
             .probeTerms = probeTermsOf(packet) };
}

/// What there is to compute: the colour of an environment, and light of a sun, if there is one.
uint8_t fogTermsOf(prepare::FramePacket const& packet) {
    Fog const& fog = packet.settings.effects.fog;
    if (!packet.demand.needs(prepare::Effect::Fog)) return 0;
    uint32_t terms = shader::kFogOn;
    if (fog.colorFromEnvironment && packet.environment.specular) {
        terms |= shader::kFogFromEnvironment;
        if (packet.environment.storage.isRgbm) terms |= shader::kFogFromRgbm;
    }
    const bool hasSun = packet.mainView().counts.suns > 0;
    if (fog.inScatteringSize > 0 && hasSun && !fog.volumetric) terms |= shader::kFogSun;
    if (packet.demand.needs(prepare::Effect::VolumetricFog))
        terms |= shader::kFogScattering | (fog.noiseAmplitude > 0 ? shader::kFogVaries : shader::kFogCells);
    if (fog.volumetric && hasSun) terms |= shader::kFogScattering;
    return static_cast<uint8_t>(terms);
}

ShadedScreen screenOf(prepare::FramePacket const& packet) {
    prepare::SceneDemand const& demand = packet.demand;
    const bool hasOcclusion = demand.needs(prepare::Effect::AmbientOcclusion);
    return { .hasOcclusion = hasOcclusion,
             .hasBentNormals = hasOcclusion && packet.settings.effects.ambientOcclusion.bentNormals,
             .hasRefraction = demand.needs(prepare::Effect::Refraction),
             .hasReflections = demand.needs(prepare::Effect::Reflections),
             .showsLevels = packet.settings.debugView == DebugView::Refraction,
             .showsHits = packet.settings.debugView == DebugView::Reflections,
             .fogTerms = fogTermsOf(packet),
             .hasMipBias = demand.needs(prepare::Effect::MipBias) };
}

bool showsDecisions(FrameContext const& context) { return context.packet.demand.needs(prepare::Effect::DebugView); }

FrameTargets beginFrame(FrameGraph& graph, FrameContext const& context, FrameOutput const& output) {
    const uint2 size = context.settings().size;
    FrameTargets targets;
    beginViewportBlit(graph, context, output, targets);
    // What half floats do not hold is to be seen, or given.
    const DebugView shown = context.settings().debugView;
    const bool isFull =
            shown == DebugView::Numerics || prepare::numbersObjects(shown) || context.settings().givesNumbers;
    const bool isFinished = output.isSceneLinear() && !showsDecisions(context) &&
                            !context.packet.demand.changesColor() && context.appPasses.empty();
    targets.color = isFinished ? targets.output
                               : graph.createTexture({ .width = size.x,
                                                       .height = size.y,
                                                       .format = isFull ? Format::RGBA32F : Format::RGBA16F,
                                                       .name = "color" });
    return targets;
}

/// What is seen of the scene, lit or not.
void addSurfacePasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    const DebugView shown = context.settings().debugView;
    // What the colour pass samples comes before it: shadow maps, then depths, which the passes after them read.
    addShadowPass(graph, context, targets);
    addDepthPass(graph, context, targets);
    if (prepare::showsMaterials(shown)) return addDebugSurfacePass(graph, context, targets);
    const bool givesNumbers = context.settings().givesNumbers;
    if (prepare::givesMotion(shown, givesNumbers)) {
        addDebugSurfacePass(graph, context, targets);
        targets.prepassDepth = targets.depth;
        return addMotionPass(graph, context, targets);
    }
    if (prepare::showsLight(shown, givesNumbers)) {
        addFogLightPass(graph, context, targets);
        addMotionPass(graph, context, targets);
        addAmbientOcclusionPass(graph, context, targets);
        addReflectedSceneColor(graph, context, targets);
        addColorPass(graph, context, targets);
        addReconstructionPasses(graph, context, targets);
    }
    if (prepare::showsEdges(shown)) addTrianglePass(graph, context, targets);
}

} // namespace

FrameContext* makeFrameContext(Arena& arena, prepare::FramePacket const& packet, FrameResources const& resources) {
    FrameContext* context = arena.make<FrameContext>();
    context->packet = packet;
    context->resources = resources;
    Quality const& quality = packet.settings.quality;
    scene::EnvironmentStorage const& storage =
            packet.probes.empty() ? packet.environment.storage : packet.probes.storage;
    context->shading = shadingKey(quality, storage, lightsOf(packet), screenOf(packet));
    if (resources.hasHalfFloats) context->precision = quality.shadingPrecision;
    context->arena = &arena;
    return context;
}

void describeAppPass(FrameGraph& graph, FrameContext const& context, FrameOutput const& output,
                     std::span<const FrameOutput> others) {
    AppPass const& pass = context.appPasses.front();
    const bool blends = pass.material->package.blending != shader::Blending::Opaque;
    const TextureId target = importOutput(graph, output, blends && output.hasContents);
    const std::span<TextureId> more = context.arena->array<TextureId>(others.size());
    size_t count = 0;
    for (FrameOutput const& other : others)
        if (other.texture) more[count++] = importOutput(graph, other, blends && other.hasContents);
    addFullScreenPass(graph, context,
                      { .name = pass.name,
                        .material = *pass.material,
                        .inputs = pass.images,
                        .block = pass.parameters,
                        .target = target,
                        .level = output.part.level,
                        .layer = output.part.layer,
                        .others = more.first(count),
                        .clears = blends && !output.hasContents });
}

FrameTargets describeFrame(FrameGraph& graph, FrameContext const& context, FrameOutput const& output) {
    FrameTargets targets = beginFrame(graph, context, output);
    addSurfacePasses(graph, context, targets);
    // Temporal accumulation comes before the blur of the lens: the history is clamped by colours of sharp neighbours.
    // Depth of field and motion blur look pixels up in the depths, so accumulation that upscales comes after them.
    const bool isEnlarged = isUpscaledOverFrames(context);
    if (!isEnlarged) addTemporalPass(graph, context, targets);
    const framegraph::TextureId light = targets.color; // surfaces reflect the scene, not what the lens makes of it
    addDepthOfFieldPasses(graph, context, targets);
    addMotionBlurPasses(graph, context, targets);
    if (isEnlarged) addTemporalPass(graph, context, targets);
    // The guard band is there for what reads pixels beside the image; the last of it is bloom. What measures or shapes
    // the image as a whole (exposure, flare, vignette) must not see the band.
    if (context.settings().band > 0) {
        addBloomPasses(graph, context, targets);
        addGuardBandCutPass(graph, context, targets);
    }
    targets.color = addAppPasses(graph, context, targets, PassPlace::BeforeToneMapping, targets.color);
    addExposurePasses(graph, context, targets);
    if (context.settings().band == 0) addBloomPasses(graph, context, targets);
    addFlarePasses(graph, context, targets);
    // Light becomes display values here. Lines and text of the app come after it, so that no exposure dims them, and
    // before the blit, which knows the view's place in the target.
    const DebugView shown = context.settings().debugView;
    const bool isOfEffectPass =
            prepare::isOfEffectPass(shown) || prepare::givesMotion(shown, context.settings().givesNumbers);
    if (showsDecisions(context) && isOfEffectPass)
        addDebugEffectPass(graph, context, targets, output.isSceneLinear());
    else if (showsDecisions(context))
        addDebugViewPass(graph, context, targets);
    else
        addPostProcessPasses(graph, context, targets, output.isSceneLinear());
    addDebugDrawPass(graph, context, targets);
    addViewportBlitPass(graph, context, output, targets);
    addTargetMips(graph, context, output, targets);
    addTargetDepth(graph, context, output, targets);
    // Last: between the colour pass and the tone mapper it would keep them from being merged.
    keepSceneColor(graph, context, targets, light);
    return targets;
}

} // namespace filament_core::passes
