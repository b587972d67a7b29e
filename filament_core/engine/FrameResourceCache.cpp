// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/FrameResourceCache.h"

#include "base/Assert.h"

namespace filament::engine {
namespace {

using passes::FrameResources;
using passes::ToneMapMaterials;

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

ToneMapMaterials FrameResourceCache::toneMap(ColorGrading const& grading, ToneMapping mapping) {
    const bool hasTable = mapping != ToneMapping::Analytic;
    const auto mapper = static_cast<size_t>(grading.toneMapper);
    FILAMENT_ASSERT(mapper < kToneMappers, "a tone mapper is one of its enumerators");
    ToneMapMaterials& known = mToneMaps[mapper][grading.dither][hasTable];
    if (!known.merged || !known.sampled) {
        std::vector<MaterialConstant> constants{ { "dither", grading.dither } };
        if (!hasTable) constants.push_back({ "toneMapper", static_cast<int32_t>(grading.toneMapper) });
        const auto material = [&](const char* package) {
            return &mEngine.materials.get(mEngine.engineMaterial(package, constants));
        };
        known.merged = material(hasTable ? "tonemap_table" : "tonemap");
        known.sampled = material(hasTable ? "tonemap_table_sampled" : "tonemap_sampled");
    }
    ToneMapMaterials found = known;
    if (hasTable) found.table = mEngine.textureHandle(mEngine.toneTable(grading.toneMapper, toneTableSize(mapping)));
    return found;
}

} // namespace filament::engine
