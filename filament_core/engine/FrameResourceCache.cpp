// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/FrameResourceCache.h"

#include "base/Assert.h"
#include "filament_core/passes/ToneMapPass.h"

namespace filament::engine {
namespace {

using passes::FrameResources;

constexpr Sampler kTrilinear{ Filter::Linear, Filter::Linear, MipFilter::Linear };
constexpr Sampler kBilinear{ Filter::Linear, Filter::Linear, MipFilter::None };
constexpr Sampler kNearest{};

uint32_t toneTableSize(ToneMapping mapping) {
    return mapping == ToneMapping::Table16 ? 16 : mapping == ToneMapping::Table32 ? 32 : 64;
}

} // namespace

FrameResources FrameResourceCache::find(View const& view, prepare::EnvironmentPacket const& environment,
                                        passes::PipelineSource pipelines, bool isToneMapped) {
    FrameResources resources;
    resources.pipelines = pipelines;
    resources.lighting = lighting(view, environment);
    resources.nearestSampler = mEngine.samplers.get(kNearest, mEngine.pending);
    resources.instanceIds = mEngine.defaults.instanceIds;
    if (environment.sky) resources.skybox = skybox(environment.skyIsRgbm);
    if (isToneMapped) resources.toneMap = toneMap(view.colorGrading, view.quality.toneMapping);
    resources.hasHalfFloats = mEngine.stream->info().features.halfFloatShaders;
    return resources;
}

passes::LightingTextures FrameResourceCache::lighting(View const& view, prepare::EnvironmentPacket const& environment) {
    const auto orBlack = [&](backend::TextureHandle cube) {
        return cube ? cube : mEngine.textureHandle(mEngine.defaults.blackCube);
    };
    return { .specular = orBlack(environment.specular),
             .dfg = mEngine.textureHandle(mEngine.dfgTable(view.quality.dfgTableSize)),
             .irradiance = orBlack(environment.irradiance),
             .trilinear = mEngine.samplers.get(kTrilinear, mEngine.pending),
             .bilinear = mEngine.samplers.get(kBilinear, mEngine.pending) };
}

scene::Material const* FrameResourceCache::skybox(bool isRgbm) {
    scene::Material const*& known = mSkyboxes[isRgbm];
    if (!known) known = &mEngine.materials.get(mEngine.engineMaterial("skybox", { { "isRgbm", isRgbm } }));
    return known;
}

passes::ToneMap FrameResourceCache::toneMap(ColorGrading const& grading, ToneMapping mapping) {
    const bool hasTable = mapping != ToneMapping::Analytic;
    const auto mapper = static_cast<size_t>(grading.toneMapper);
    FILAMENT_ASSERT(mapper < kToneMappers, "a tone mapper is one of its enumerators");
    scene::Material const*& known = mToneMaps[mapper][grading.dither][hasTable];
    if (!known) {
        std::vector<MaterialConstant> constants{ { "dither", grading.dither }, { "fromTable", hasTable } };
        if (!hasTable) constants.push_back({ "toneMapper", static_cast<int32_t>(grading.toneMapper) });
        known = &mEngine.fullScreenMaterial("tonemap", std::move(constants), passes::kToneMapInterface);
    }
    const Texture table = hasTable ? mEngine.toneTable(grading.toneMapper, toneTableSize(mapping))
                                   : mEngine.unsetTexture(*known->package.findParameter("table"));
    return { known, mEngine.textureHandle(table) };
}

} // namespace filament::engine
