// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/FrameResourceCache.h"

#include "filament_core/passes/DebugDrawPass.h"
#include "filament_core/passes/SplatPass.h"
#include "filament_core/prepare/DebugViews.h"

#include <filament_core/DebugDraw.h>

namespace filament_core::engine {
namespace {

using passes::FrameResources;

constexpr backend::SamplerDesc kTrilinear{ Filter::Linear, Filter::Linear, MipFilter::Linear };
constexpr backend::SamplerDesc kBilinear{ Filter::Linear, Filter::Linear, MipFilter::None };
constexpr backend::SamplerDesc kNearest{};
constexpr backend::SamplerDesc kBilinearOfLevels{ Filter::Linear, Filter::Linear, MipFilter::Nearest };
constexpr backend::SamplerDesc kNearestOfLevels{ Filter::Nearest, Filter::Nearest, MipFilter::Nearest };

uint32_t toneTableSize(ToneMapping mapping) {
    return mapping == ToneMapping::Table16 ? 16 : mapping == ToneMapping::Table32 ? 32 : 64;
}

/// Without fields that change no colour, so that equal tables are shared.
DisplayTransform keyOf(DisplayTransform const& display) {
    constexpr ToneCurve kCurve{};
    DisplayTransform key = clamped(display);
    key.dither = false;
    if (key.toneMapper != ToneMapper::Agx) key.agxLook = AgxLook::Base;
    if (key.toneMapper != ToneMapper::Generic) key.toneCurve = kCurve;
    if (key.outputSpace != OutputSpace::Rec2020Pq) key.whiteNits = DisplayTransform{}.whiteNits;
    return key;
}

} // namespace

FrameResources FrameResourceCache::find(View const& view, prepare::FramePacket const& packet,
                                        passes::PipelineSource pipelines, bool isToneMapped) {
    prepare::EnvironmentPacket const& environment = packet.environment;
    FrameResources resources;
    resources.pipelines = pipelines;
    resources.lighting = lighting(view, environment);
    resources.samplers = samplers();
    resources.effects = &mEffects;
    resources.dispatches = &mEngine.dispatches;
    resources.noFogCells = mEngine.defaults.noFogCells;
    resources.white = mEngine.textureHandle(mEngine.unsetTexture({ .type = ParameterType::Sampler2D }));
    resources.instanceIds = mEngine.defaults.instanceIds;
    if (packet.settings.cutsSlabs || (packet.shadows.keepsAtlas && packet.shadows.drawn > 0))
        resources.farDepth = farDepth();
    if (packet.demand.needs(prepare::Effect::Motion)) resources.motion = mEngine.motionInstance();
    if (packet.mainView().counts.fadingLevels > 0)
        resources.levelFade = { mEngine.levelFadeInstance(false), mEngine.levelFadeInstance(true) };
    if (view.debugDraw && !view.debugDraw->empty()) {
        resources.debugTested = mEngine.debugDrawInstance(true);
        resources.debugThrough = mEngine.debugDrawInstance(false);
        resources.debugLayout = mEngine.layouts.intern(passes::debugDrawLayout());
    }
    if (packet.demand.needs(prepare::Effect::Splats)) {
        resources.splats = &mEngine.instances.get(mEngine.splatInstance());
        resources.splatLayout = mEngine.layouts.intern(passes::splatLayout());
    }
    if (prepare::showsEdges(view.debugView) || prepare::numbersTriangles(view.debugView)) resources.edges = edges();
    if (environment.sky) resources.skybox = skybox(environment.skyIsRgbm, environment.skyHasGround);
    if (!packet.discs.empty()) resources.sunDisc = sunDisc();
    const bool isDebugView = packet.demand.needs(prepare::Effect::DebugView);
    if (isDebugView && !prepare::isOfEffectPass(view.debugView))
        resources.debugView = debugView(view.debugView, isToneMapped);
    else if (isToneMapped && (!isDebugView || view.debugView == DebugView::Numerics))
        resources.toneTable = toneTable(view, packet);
    resources.dirt = dirt(packet);
    resources.hasHalfFloats = mEngine.stream->info().features.halfFloatShaders;
    return resources;
}

passes::FrameSamplers FrameResourceCache::samplers() {
    return { .nearest = mEngine.samplers.get(kNearest, mEngine.pending),
             .bilinear = mEngine.samplers.get(kBilinear, mEngine.pending),
             .nearestOfLevels = mEngine.samplers.get(kNearestOfLevels, mEngine.pending),
             .bilinearOfLevels = mEngine.samplers.get(kBilinearOfLevels, mEngine.pending),
             .trilinear = mEngine.samplers.get(kTrilinear, mEngine.pending) };
}

passes::LightingTextures FrameResourceCache::lighting(View const& view, prepare::EnvironmentPacket const& environment) {
    const auto orBlack = [&](backend::TextureHandle cube) {
        return cube ? cube : mEngine.textureHandle(mEngine.defaults.blackCube);
    };
    return { .specular = orBlack(environment.specular),
             .dfg = mEngine.textureHandle(mEngine.dfgTable(view.quality.dfgTableSize)),
             .irradiance = orBlack(environment.irradiance) };
}

scene::Material const* FrameResourceCache::skybox(bool isRgbm, bool hasGround) {
    scene::Material const*& known = mSkyboxes[isRgbm + 2 * hasGround];
    if (!known) {
        known = &mEngine.materials.get(
                mEngine.engineMaterial("skybox", { { "isRgbm", isRgbm }, { "hasGround", hasGround } }));
    }
    return known;
}

scene::Material const* FrameResourceCache::farDepth() {
    if (!mFarDepth) mFarDepth = &mEngine.materials.get(mEngine.engineMaterial("far_depth", {}));
    return mFarDepth;
}

scene::Material const* FrameResourceCache::edges() {
    if (!mEngine.stream->info().features.primitiveIds) return nullptr;
    if (!mEdges) mEdges = &mEngine.materials.get(mEngine.engineMaterial("debug_edges", {}));
    return mEdges;
}

scene::Material const* FrameResourceCache::sunDisc() {
    if (!mSunDisc) mSunDisc = &mEngine.materials.get(mEngine.engineMaterial("sun_disc", {}));
    return mSunDisc;
}

scene::Material const* FrameResourceCache::debugView(DebugView debugView, bool isEncoded) {
    scene::Material const*& known = mDebugViews[static_cast<size_t>(debugView) * 2 + (isEncoded ? 1 : 0)];
    if (!known) {
        known = &mEngine.materials.get(mEngine.engineMaterial(
                "debug_view", { { "view", static_cast<int32_t>(debugView) }, { "isEncoded", isEncoded } }));
    }
    return known;
}

passes::DirtTexture FrameResourceCache::dirt(prepare::FramePacket const& packet) {
    Bloom const& bloom = packet.settings.effects.bloom;
    if (!packet.demand.needs(prepare::Effect::Bloom) || !bloom.dirt || bloom.dirtStrength == 0) return {};
    TextureState const& state = mEngine.textures.get(bloom.dirt);
    backend::DeviceTextureDesc const& desc = state.desc;
    FILAMENT_ASSERT(desc.type == backend::TextureKind::Texture2D &&
                            backend::formatInfo(desc.format).kind == backend::FormatKind::Color,
                    "the dirt of bloom is a 2D texture of colours");
    FILAMENT_ASSERT(desc.levels == backend::fullMipCount(desc.width, desc.height),
                    "the dirt of bloom has all of its mip levels: the last one is its mean");
    return { state.handle, { desc.width, desc.height }, desc.levels };
}

/// None: the view computes its tones.
backend::TextureHandle FrameResourceCache::toneTable(View const& view, prepare::FramePacket const& packet) {
    const ToneMapping mapping = view.quality.toneMapping;
    const bool hasFormula = view.display.toneMapper != ToneMapper::AcesReference && !view.display.look;
    if (mapping == ToneMapping::Analytic && hasFormula) return {};
    const bool isGraded = packet.demand.needs(prepare::Effect::ColorGrading);
    return mEngine.textureHandle(mEngine.toneTable(
            { .display = keyOf(view.display),
              .size = toneTableSize(mapping),
              .grading = isGraded ? std::optional(packet.settings.effects.colorGrading) : std::nullopt }));
}

} // namespace filament_core::engine
