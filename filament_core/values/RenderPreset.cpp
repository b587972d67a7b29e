// SPDX-License-Identifier: Apache-2.0
#include <filament_core/RenderPreset.h>

namespace filament_core {
namespace {

void applyFast(View& view) {
    view.quality = qualityPreset(QualityPreset::Low);
    view.quality.antiAliasing = AntiAliasing::Fxaa;
    view.effects.bloom.resolution = BloomResolution::Quarter;
}

void applyBalanced(View& view) {
    view.quality = qualityPreset(QualityPreset::Medium);
    view.quality.antiAliasing = AntiAliasing::Fxaa;
    view.effects.ambientOcclusion.enabled = true;
    view.effects.ambientOcclusion.method = AmbientOcclusionMethod::Sao;
    view.effects.bloom.enabled = true;
    view.effects.bloom.resolution = BloomResolution::Quarter;
}

void applyFine(View& view) {
    view.quality = qualityPreset(QualityPreset::High);
    view.quality.shadowCascades = 3;
    view.quality.antiAliasing = AntiAliasing::Taa;
    view.effects.ambientOcclusion.enabled = true;
    view.effects.screenSpaceReflections.enabled = true;
    view.effects.bloom.enabled = true;
}

void applyCinematic(View& view) {
    view.quality = qualityPreset(QualityPreset::Reference);
    view.quality.refractionLayers = 3;
    view.quality.antiAliasing = AntiAliasing::Taa;
    AmbientOcclusion& occlusion = view.effects.ambientOcclusion;
    occlusion.enabled = true;
    occlusion.slices = 3;
    occlusion.resolution = AmbientOcclusionResolution::Full;
    occlusion.bentNormals = true;
    view.effects.screenSpaceReflections.enabled = true;
    view.effects.screenSpaceReflections.steps = 128;
    view.effects.contactShadows.steps = 32;
    view.effects.bloom.enabled = true;
    view.effects.motionBlur.enabled = true;
}

/// Switch and exactness of the effects that presets set, as a new view has them.
void resetEffects(Effects& effects) {
    effects.ambientOcclusion = { .radiusMeters = effects.ambientOcclusion.radiusMeters,
                                 .intensity = effects.ambientOcclusion.intensity };
    effects.screenSpaceReflections.enabled = false;
    effects.screenSpaceReflections.steps = ScreenSpaceReflections{}.steps;
    effects.contactShadows.steps = ContactShadows{}.steps;
    effects.bloom.enabled = false;
    effects.bloom.resolution = Bloom{}.resolution;
    effects.motionBlur.enabled = false;
    effects.resolution.upscaling = Upscaling::Off;
}

} // namespace

void applyPreset(View& view, RenderPreset preset) {
    view.samples = 1;
    resetEffects(view.effects);
    switch (preset) {
    case RenderPreset::Fast:
        return applyFast(view);
    case RenderPreset::Balanced:
        return applyBalanced(view);
    case RenderPreset::Fine:
        return applyFine(view);
    case RenderPreset::Cinematic:
        return applyCinematic(view);
    }
}

} // namespace filament_core
